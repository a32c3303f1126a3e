//! `PlanCase`, a problem that planners are compared by, as a row tells it.

use crate::batch::problem_set::KnownProblem;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_sim::plans::Task;

/// What a row says of its problem.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanCase {
    /// What is known of it; `None` for one that stands in no file.
    pub known: Option<KnownProblem>,
    /// The names of robot and world, and where the path begins and ends; `None` where there is no problem of the
    /// number.
    pub asked: Option<AskedPath>,
}

/// The path that a problem asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedPath {
    /// The robot's name.
    pub robot: String,
    /// The world's name.
    pub world: String,
    /// The start and the goal.
    pub ends: [AnyConfiguration; 2],
}

impl AskedPath {
    /// What a task asks for.
    pub fn of(task: &Task) -> Self {
        AskedPath { robot: task.name.clone(), world: task.world.name.clone(), ends: [task.start, task.goal] }
    }
}

impl PlanCase {
    /// A path's length as a share of the shortest one that a scenario says; `None` where none says one, or 0.
    pub fn of_optimal(&self, length: f64) -> Option<f64> {
        self.known.as_ref()?.of_optimal(length)
    }
}
