//! `GeneratedProblem`, a problem that was made.

use crate::plans::Task;

/// A problem that was made.
#[derive(Clone, Debug)]
pub struct GeneratedProblem {
    /// The problem: its robot is alone in its world, where it lives at the start, and has the kind's name in the book.
    /// Start and goal have a clearance of more than 5 cm.
    pub task: Task,
    /// Whether the robot, as it is, has a path; `None` where its making does not tell.
    pub has_path: Option<bool>,
}
