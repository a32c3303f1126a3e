//! `Work`, a planner at work.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use motion_lab_sim::plans::Attempt;

/// A planner at work, shared by copies of the state.
#[derive(Clone)]
pub struct Work(Arc<Mutex<Box<dyn Attempt>>>);

impl fmt::Debug for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Work")
    }
}

impl Work {
    /// A planner that has not begun.
    pub fn new(attempt: Box<dyn Attempt>) -> Self {
        Work(Arc::new(Mutex::new(attempt)))
    }

    /// Asks it, or lets it work.
    pub fn with<T>(&self, ask: impl FnOnce(&mut dyn Attempt) -> T) -> T {
        ask(self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut())
    }
}
