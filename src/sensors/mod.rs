//! Sensors: what a robot can find out about the world.

mod beam;
mod circle;
mod instructions;
mod kernel;
mod range;
mod scanner;
#[cfg(test)]
mod tests;
mod walk;

pub use crate::worlds::{BeamError, BeamModel};
pub use instructions::Instructions;
pub use range::{RangeSensor, SensorError};
pub use scanner::Scanner;
