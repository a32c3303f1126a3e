//! Plan: a planner at work, in the workspace and in the configuration space.

mod blockers;
pub(super) mod controls;
mod exchange;
mod paces;
mod panel;
mod race;
mod racer;
mod state;
#[cfg(test)]
mod tests;
pub(super) mod view;
mod work;

pub use racer::PlanStage;
pub use state::PlanState;
