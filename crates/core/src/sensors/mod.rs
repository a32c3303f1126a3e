//! Sensors: what a robot can find out about the world.

mod beam;
mod cast_discs;
mod cast_segments;
mod grid_cast;
mod kernel;
mod open_rays;
mod range;
mod rays;
mod scanner;
mod sectors;
mod simd;
#[cfg(test)]
mod tests;
mod view;
mod wedges;

pub use crate::worlds::{
    BeamError, BeamModel, FanSensor, MAX_RANGE, MAX_RAYS, MIN_FIELD_OF_VIEW, MIN_RANGE, RangeSensor, SensorError,
};
pub use scanner::Scanner;
pub use simd::Instructions;
