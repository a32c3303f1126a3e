//! Sensors: what a robot can find out about the world.

mod beam;
mod bearings;
mod circle;
mod fan;
mod groups;
mod instructions;
mod kernel;
mod raise;
mod range;
mod ready;
mod scanner;
#[cfg(test)]
mod tests;
mod walk;

pub use crate::worlds::{BeamError, BeamModel};
pub use instructions::Instructions;
pub use range::{RangeSensor, SensorError};
pub use scanner::Scanner;
