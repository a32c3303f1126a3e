//! Hybrid A* for the car, with a trailer or without.

mod car_move;
mod planner;
mod remaining;
mod settings;
mod shots;
#[cfg(test)]
mod tests;

pub use car_move::CarMove;
pub use planner::HybridAStar;
pub use settings::{HybridSettings, NearGoal};
