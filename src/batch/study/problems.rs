//! The problems of a study's scenario: what they change in a run, and what a row says of them.

use crate::batch::axis::CheckedAxis;
use crate::batch::parameter::Parameter;
use crate::batch::row::RowValue;
use crate::batch::study_text::GoalText;
use crate::batch::values::{AxisValue, NumberedProblem, PlacedProblem};
use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_core::geometry::Point2;
use motion_lab_core::worlds::World;

/// The problem among a row's values, if there is one.
fn problem_of(values: &[AxisValue]) -> Option<&NumberedProblem> {
    values.iter().find_map(|value| match value {
        AxisValue::Problem(problem) => Some(problem),
        _ => None,
    })
}

/// The problem among a row's values, in the world of the goal's robot; `None` without either. The error says that the
/// scenario's map is not that of the world.
pub fn placed(goal: &GoalText, values: &[AxisValue], worlds: &[World]) -> Result<Option<PlacedProblem>, String> {
    let lives = |world: &&World| world.robots.iter().any(|resident| resident.name == goal.robot);
    let world = worlds.iter().find(lives);
    problem_of(values).zip(world).map(|(problem, world)| problem.placed(&world.bounds)).transpose()
}

/// The goal with the configuration that a row gives it.
pub fn varied(goal: &GoalText, axes: &[CheckedAxis], values: &[AxisValue]) -> GoalText {
    let mut goal = goal.clone();
    for (axis, value) in axes.iter().zip(values) {
        if let (Parameter::Goal { .. }, AxisValue::Configuration(at)) = (&axis.parameter, value) {
            goal.at = at.iter().copied().map(WrittenCoordinate::number).collect();
        }
    }
    goal
}

/// The goal with the place of a problem's. Its heading stays.
pub fn goal_at(goal: &GoalText, problem: Option<PlacedProblem>) -> GoalText {
    let mut goal = goal.clone();
    if let Some(PlacedProblem { goal: at, .. }) = problem {
        put(&mut goal.at, at, WrittenCoordinate::number);
    }
    goal
}

/// Lets the goal's robot start where a problem does. Its heading stays.
pub fn start_at(goal: &GoalText, problem: Option<PlacedProblem>, worlds: &mut [World]) {
    let own = worlds.iter_mut().flat_map(|world| &mut world.robots).find(|resident| resident.name == goal.robot);
    if let (Some(PlacedProblem { start, .. }), Some(resident)) = (problem, own) {
        put(&mut resident.start, start, |x| x);
    }
}

/// Writes a place over the first two coordinates.
fn put<T>(coordinates: &mut [T], at: Point2, written: fn(f64) -> T) {
    coordinates.iter_mut().zip([at.x, at.y]).for_each(|(coordinate, x)| *coordinate = written(x));
}

/// Why robots of a kind have no problems of a map; `None` for one that goes from place to place.
pub fn unsuited(kind: &str) -> Option<String> {
    let is_mobile = RobotKind::of(kind).is_some_and(|known| known.lengths >= 2);
    (!is_mobile).then(|| format!("a {kind} does not go from place to place"))
}

/// What a row says of its problem: the number, the bucket, start and goal, and the length that is the shortest by the
/// file; of the last five nothing where the goal's robot has no world that the map fills.
pub fn cells(problem: &NumberedProblem, goal: Option<&GoalText>, worlds: &[&World]) -> [RowValue; 7] {
    let robot = goal.map(|goal| goal.robot.as_str());
    let lives = |world: &&&World| world.robots.iter().any(|resident| Some(resident.name.as_str()) == robot);
    let placed = worlds.iter().find(lives).and_then(|world| problem.placed(&world.bounds).ok());
    let of = |number: fn(PlacedProblem) -> f64| RowValue::finite(placed.map(number));
    [
        RowValue::Whole(problem.number),
        RowValue::Whole(problem.problem.bucket),
        of(|p| p.start.x),
        of(|p| p.start.y),
        of(|p| p.goal.x),
        of(|p| p.goal.y),
        of(|p| p.optimal),
    ]
}
