//! `PlannerWork`, a planner at work.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use motion_lab_sim::plans::PlanAttempt;

/// A planner at work, shared by copies of the state.
#[derive(Clone)]
pub struct PlannerWork(Arc<Mutex<Box<dyn PlanAttempt>>>);

impl fmt::Debug for PlannerWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Work")
    }
}

impl PlannerWork {
    /// A planner that has not begun.
    pub fn new(attempt: Box<dyn PlanAttempt>) -> Self {
        PlannerWork(Arc::new(Mutex::new(attempt)))
    }

    /// Asks it, or lets it work.
    pub fn with<T>(&self, ask: impl FnOnce(&mut dyn PlanAttempt) -> T) -> T {
        ask(self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut())
    }
}
