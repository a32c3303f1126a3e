//! The problems of a study's problem file: what they change in a run, and what a row says of them.

use motion_lab_core::configuration::{Configuration as _, RobotKind, WrittenCoordinate};
use motion_lab_sim::plans::Task;

use crate::batch::axis::CheckedAxis;
use crate::batch::parameter::{Parameter, RobotParameter};
use crate::batch::row::RowValue;
use crate::batch::study_text::GoalText;
use crate::batch::values::{AxisValue, FiledProblem};

/// The problem among a row's values, if there is one of a problem file. The error says why there is none of its number.
pub fn task_of(values: &[AxisValue]) -> Result<Option<Task>, String> {
    let filed = values.iter().find_map(|value| match value {
        AxisValue::Filed(problem) => Some(problem),
        _ => None,
    });
    filed.map(|problem| problem.made().task).transpose()
}

/// The goal with the configuration of a problem's.
pub fn goal_at(goal: &GoalText, task: &Task) -> Result<GoalText, String> {
    let at: Vec<_> = task.goal.coordinates().iter().copied().map(WrittenCoordinate::number).collect();
    if at.len() != goal.within.len() {
        return Err(format!("the problem's goal has {} coordinates, and {} tolerances", at.len(), goal.within.len()));
    }
    Ok(GoalText { at, ..goal.clone() })
}

/// What a row says of its problem: number, set, what is known of a path by a robot of the problem's own sizes, bucket
/// and shortest length of a scenario's, and both ends; of what its making tells nothing where there is none.
pub fn cells(problem: &FiledProblem, kind: &RobotKind, has_own_sizes: bool) -> Vec<RowValue> {
    let made = problem.made();
    let mut cells = Vec::new();
    if let Some(known) = made.known {
        cells.extend([RowValue::Whole(known.number), RowValue::text(&known.set)]);
        cells.push(known.path_in_words().filter(|_| has_own_sizes).map_or(RowValue::Empty, RowValue::text));
        cells.extend([known.bucket.map_or(RowValue::Empty, RowValue::Whole), RowValue::finite(known.optimal)]);
    }
    let task = made.task.ok();
    for end in [task.as_ref().map(|task| task.start), task.as_ref().map(|task| task.goal)] {
        let coordinates = end.map(|q| q.coordinates());
        let at = |i: usize| coordinates.as_ref().and_then(|q| q.get(i).copied());
        cells.extend((0..kind.coordinates.len()).map(|i| RowValue::finite(at(i))));
    }
    cells
}

/// Whether a size of the goal's robot is varied.
pub fn varies_sizes(goal: Option<&GoalText>, axes: &[CheckedAxis]) -> bool {
    axes.iter().any(|axis| match &axis.parameter {
        Parameter::Robot { robot, of: RobotParameter::Size(_), .. } => goal.is_some_and(|goal| goal.robot == *robot),
        _ => false,
    })
}
