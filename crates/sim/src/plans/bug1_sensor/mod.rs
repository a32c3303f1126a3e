//! Bug1 by its range sensor: a disc that knows where it is, and sees walls by a sensor that is exact or noisy.

mod planner;
mod round;
mod rover;
#[cfg(test)]
mod tests;
mod walk;

pub use planner::Bug1Sensor;
pub use walk::{Bug1Walk, WalkEnd};
