//! What is kept of a run's past: keyframes to go back to, and the trails that a history holds.

pub(super) mod keyframes;
pub(super) mod trail;
