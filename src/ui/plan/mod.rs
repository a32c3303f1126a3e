//! Plan: a planner at work, in the workspace and in the configuration space.

mod controls;
mod panel;
mod state;
pub(super) mod view;

pub use state::PlanState;
