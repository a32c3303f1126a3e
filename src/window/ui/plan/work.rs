//! `PlannerWork`, a planner at work.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::plans::{NoRemoval, PlanAttempt, Removal, Task};

/// The most vertices of a world in which a bound is looked for: some milliseconds' work.
const MAX_VERTICES: usize = 1000;

/// The most sets of things that are planned without, of a robot whose space is a plane: some tens of milliseconds each.
const MAX_SETS: usize = 30;

/// The same of any other, each of which may take a second.
const MAX_SETS_IN_SPACE: usize = 5;

/// Whether the configurations of a task's robot are a plane.
fn is_plane(task: &Task) -> bool {
    matches!(task.robot, AnyRobot::Rusty(_) | AnyRobot::Reach(_))
}

/// A planner at work, shared by copies of the state.
#[derive(Clone)]
pub struct PlannerWork {
    attempt: Arc<Mutex<Box<dyn PlanAttempt>>>,
    bound: Arc<OnceLock<Option<f64>>>,
    removal: Arc<OnceLock<Result<Removal, NoRemoval>>>,
}

impl fmt::Debug for PlannerWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Work")
    }
}

impl PlannerWork {
    /// A planner that has not begun.
    pub fn new(attempt: Box<dyn PlanAttempt>) -> Self {
        PlannerWork { attempt: Arc::new(Mutex::new(attempt)), bound: Arc::default(), removal: Arc::default() }
    }

    /// A length that no path of its task undercuts: [`Task::length_bound`], computed once, in a world that is not
    /// large, of a robot whose space is a plane.
    pub fn length_bound(&self, task: &Task) -> Option<f64> {
        let vertices: usize = task.scene.pieces().map(|(_, piece)| piece.core().len()).sum();
        let is_known = is_plane(task) && vertices <= MAX_VERTICES && task.checker.proves();
        *self.bound.get_or_init(|| if is_known { task.length_bound() } else { None })
    }

    /// What to move for a path to appear, if it has been looked for.
    pub fn removal(&self) -> Option<&Result<Removal, NoRemoval>> {
        self.removal.get()
    }

    /// Looks for what to move, among few enough sets that nobody waits for long.
    pub fn find_removal(&self, task: &Task) {
        let sets = if is_plane(task) { MAX_SETS } else { MAX_SETS_IN_SPACE };
        self.removal.get_or_init(|| task.what_blocks_within(sets));
    }

    /// Asks it, or lets it work.
    pub fn with<T>(&self, ask: impl FnOnce(&mut dyn PlanAttempt) -> T) -> T {
        ask(self.attempt.lock().unwrap_or_else(PoisonError::into_inner).as_mut())
    }
}
