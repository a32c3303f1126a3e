//! Sensors: what a robot can find out about the world.

mod beam;
mod range;

pub use crate::worlds::{BeamError, BeamModel};
pub use range::{RangeSensor, SensorError};
