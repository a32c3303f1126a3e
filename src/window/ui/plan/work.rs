//! `PlannerWork`, a planner at work.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use motion_lab_sim::plans::{PlanAttempt, Task};

/// The most vertices of a world in which a bound is looked for: some milliseconds' work.
const MAX_VERTICES: usize = 1000;

/// A planner at work, shared by copies of the state.
#[derive(Clone)]
pub struct PlannerWork {
    attempt: Arc<Mutex<Box<dyn PlanAttempt>>>,
    bound: Arc<OnceLock<Option<f64>>>,
}

impl fmt::Debug for PlannerWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Work")
    }
}

impl PlannerWork {
    /// A planner that has not begun.
    pub fn new(attempt: Box<dyn PlanAttempt>) -> Self {
        PlannerWork { attempt: Arc::new(Mutex::new(attempt)), bound: Arc::default() }
    }

    /// A length that no path of its task undercuts, metres: [`Task::length_bound`], computed once, in a world that is
    /// not large.
    pub fn length_bound(&self, task: &Task) -> Option<f64> {
        let vertices: usize = task.scene.pieces().map(|(_, piece)| piece.core().len()).sum();
        let is_known = vertices <= MAX_VERTICES && task.checker.proves();
        *self.bound.get_or_init(|| if is_known { task.length_bound() } else { None })
    }

    /// Asks it, or lets it work.
    pub fn with<T>(&self, ask: impl FnOnce(&mut dyn PlanAttempt) -> T) -> T {
        ask(self.attempt.lock().unwrap_or_else(PoisonError::into_inner).as_mut())
    }
}
