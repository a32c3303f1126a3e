//! Sensors: what a robot can find out about the world.

mod range;

pub use range::{RangeSensor, SensorError};
