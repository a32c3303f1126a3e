//! What is checked when a study is made: its robots, its goal, its planner and its axes.

use std::sync::Arc;

use super::problems::unsuited;
use crate::batch::axis::{CheckedAxis, ProblemFiles};
use crate::batch::columns::{MAX_ROBOT_COLUMNS, RobotColumns};
use crate::batch::error::SweepProblem;
use crate::batch::parameter::{Parameter, RobotParameter, RunParameter, Sources};
use crate::batch::problem_set::ProblemSet;
use crate::batch::study_text::{GoalText, NamedLength, StudyItem, StudyText, TicksText};
use crate::batch::values::Over;
use motion_lab_core::configuration::{RobotKind, Sizes, WrittenCoordinate};
use motion_lab_core::names::{hint, nearest};
use motion_lab_core::worlds::{BeamModel, OutsideError, Resident, World, WorldProblem};

/// What is wrong with a robot's sizes or noise, when all axes have their values.
pub fn check(kind: &str, sizes: Option<&Sizes>, noise: Option<BeamModel>) -> Option<String> {
    let sizes = sizes.and_then(|sizes| sizes.check_for(kind).err()).map(|error| error.to_string());
    sizes.or_else(|| noise.and_then(|noise| noise.try_new().err()).map(|error| error.to_string()))
}

/// Checks the robots and the goal.
pub fn check_robots(study: &StudyText, worlds: &[&World]) -> Result<(), (StudyItem, SweepProblem)> {
    let find = |name: &str| worlds.iter().flat_map(|w| &w.robots).find(|r| r.name == name);
    let unknown = |robot: &str| {
        let names: Vec<&str> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str()).take(20).collect();
        let there = if names.is_empty() { "none".into() } else { names.join(", ") };
        let all = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str());
        SweepProblem::Robot { robot: robot.to_owned(), there: there + &hint(nearest(robot, all)) }
    };
    if let Some(robot) = study.robots.iter().find(|name| find(name).is_none()) {
        return Err((StudyItem::Robots, unknown(robot)));
    }
    let Some(goal @ GoalText { robot, .. }) = &study.goal else { return Ok(()) };
    let (at, within) = (&goal.at(), &goal.within());
    let Some(resident) = find(robot).filter(|_| study.keeps(robot)) else {
        return Err((StudyItem::Goal, unknown(robot)));
    };
    let (coordinates, tolerances, expected) = (at.len(), within.len(), resident.start.len());
    if coordinates != expected || tolerances != expected {
        return Err((StudyItem::Goal, SweepProblem::Goal { coordinates, tolerances, expected }));
    }
    let lengths = RobotKind::of(&resident.kind).map_or(0, |known| known.lengths);
    for written in [&goal.at, &goal.within] {
        WrittenCoordinate::values(written, lengths)
            .map_err(|reason| (StudyItem::Goal, SweepProblem::Length(reason)))?;
    }
    if let Some(wrong) = at.iter().chain(within).find(|x| !x.is_finite()) {
        return Err((StudyItem::Goal, SweepProblem::NotFinite(*wrong)));
    }
    if let Some(wrong) = within.iter().find(|tolerance| **tolerance < 0.0) {
        return Err((StudyItem::Goal, SweepProblem::Tolerance(*wrong)));
    }
    if study.axes.iter().any(|axis| matches!(*axis.over, Over::Problems(_) | Over::Goals(_))) {
        // each row has a goal of its own
        return Ok(());
    }
    check_goal_somewhere(robot, at, worlds).map_err(|problem| (StudyItem::Goal, problem))
}

/// Whether the goal lies within a world of its robot, for each of these worlds that has the robot.
pub fn goal_checks<'a>(
    robot: &'a str,
    at: &'a [f64],
    worlds: impl IntoIterator<Item = &'a World>,
) -> impl Iterator<Item = Result<(), OutsideError>> {
    let residents = worlds.into_iter().flat_map(|world| world.robots.iter().map(move |resident| (world, resident)));
    let own = residents.filter(move |(_, resident)| resident.name == robot);
    own.map(move |(world, resident)| world.check_position(&resident.kind, "goal", at))
}

/// Checks that the goal lies within some world of its robot. Where an axis chooses another world, the row says so.
fn check_goal_somewhere(robot: &str, at: &[f64], worlds: &[&World]) -> Result<(), SweepProblem> {
    let mut checked = goal_checks(robot, at, worlds.iter().copied()).peekable();
    let first = checked.peek().cloned();
    if checked.any(|within| within.is_ok()) {
        return Ok(());
    }
    first.unwrap_or(Ok(())).map_err(SweepProblem::Outside)
}

/// Checks that the goal lies within every world of its robot.
pub fn check_goal_everywhere(goal: &GoalText, worlds: &[World]) -> Result<(), String> {
    let robot = &goal.robot;
    goal_checks(robot, &goal.at(), worlds).collect::<Result<(), _>>().map_err(|reason| format!("{robot}: {reason}"))
}

/// Checks that a study with a planner says who goes where, and nothing else that drives its robot.
pub fn check_planner(study: &StudyText) -> Result<(), (StudyItem, SweepProblem)> {
    let refused = |reason| Err((StudyItem::Planner, SweepProblem::Planner(reason)));
    let is_planned = study.ticks == Some(TicksText::Named(NamedLength::Planned));
    match &study.planner {
        None if is_planned => refused("there is none whose path could say the ticks"),
        Some(_) if study.script.is_some() => refused("the study has a script too, and its robot follows one of them"),
        Some(_) if study.goal.is_none() => refused("it needs a goal, which says what robot goes where"),
        _ => Ok(()),
    }
}

/// The unit of planned paths: radians where the goal's robot is an arm. `None` without a planner.
pub fn planned_unit(study: &StudyText, worlds: &[&World]) -> Option<&'static str> {
    let (_, GoalText { robot, .. }) = study.planner.as_ref().zip(study.goal.as_ref())?;
    let resident = worlds.iter().flat_map(|world| &world.robots).find(|resident| resident.name == *robot)?;
    RobotKind::of(&resident.kind).map(|kind| kind.unit_of(0))
}

/// The axes, each of which varies something.
pub fn make_axes(
    study: &StudyText,
    worlds: &[&World],
    files: &ProblemFiles,
) -> Result<Vec<CheckedAxis>, (StudyItem, SweepProblem)> {
    let mut axes: Vec<CheckedAxis> = Vec::with_capacity(study.axes.len());
    let robots: Vec<&Resident> =
        worlds.iter().flat_map(|world| &world.robots).filter(|robot| study.keeps(&robot.name)).collect();
    let there = Sources {
        sensor: !study.no_sensor,
        warehouse: study.warehouse.is_some(),
        planner: study.planner.is_some(),
        goal: study.goal.is_some(),
    };
    for (i, text) in study.axes.iter().enumerate() {
        let refused = |problem| (StudyItem::Axis(i), problem);
        let goal = study.goal.as_ref().map(|goal| goal.robot.as_str());
        let parameter = Parameter::named(&text.vary, worlds, goal).map_err(|there| {
            let meant = Parameter::meant(&text.vary, worlds);
            refused(SweepProblem::Parameter(there + &hint(meant.as_deref())))
        })?;
        let is_filed = |over: &Over| over.problem_file().is_some_and(|(_, is_filed)| is_filed);
        let varies_twice = |axis: &CheckedAxis| {
            overlap(study.goal.as_ref(), &axis.parameter, &parameter)
                || (axis.filed().is_some() && is_of_a_problem(study.goal.as_ref(), &parameter))
                || (is_filed(&text.over) && is_of_a_problem(study.goal.as_ref(), &axis.parameter))
        };
        if let Some(before) = axes.iter().position(varies_twice) {
            return Err(refused(SweepProblem::Twice(before)));
        }
        let axis = CheckedAxis::try_new(parameter, Arc::clone(&text.over), files).map_err(refused)?;
        let goals = robots.iter().find(|known| study.goal.as_ref().is_some_and(|goal| goal.robot == known.name));
        let is_problem = axis.parameter == Parameter::Run(RunParameter::Problem);
        let unsuited = goals.filter(|_| is_problem).and_then(|resident| match axis.filed() {
            Some(problems) => of_another_robot(problems, resident),
            None => unsuited(&resident.kind),
        });
        if axis.filed().is_some() && !(study.worlds.is_empty() && study.warehouse.is_none()) {
            let reason = "each problem of the file has its own world: leave out worlds and warehouse";
            return Err(refused(SweepProblem::Run(reason.into())));
        }
        if let Some(reason) = axis.parameter.idle(&robots, there).or(unsuited) {
            return Err(refused(SweepProblem::Idle(reason)));
        }
        if let (Parameter::Robot { robot, of: RobotParameter::Start, .. }, Over::Starts(starts)) =
            (&axis.parameter, &*text.over)
        {
            check_ends("start", starts, &robots, robot).map_err(refused)?;
        }
        if let (Parameter::Goal { .. }, Over::Goals(goals), Some(robot)) = (&axis.parameter, &*text.over, goal) {
            check_ends("goal", goals, &robots, robot).map_err(refused)?;
        }
        axes.push(axis);
    }
    Ok(axes)
}

/// Why the problems of a file are none for this robot; `None` where they are.
fn of_another_robot(problems: &ProblemSet, resident: &Resident) -> Option<String> {
    let (names, kinds) = (problems.robots(), problems.kinds());
    let is_own = names == [resident.name.as_str()] && matches!(kinds[..], [kind] if kind.name == resident.kind);
    let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
    let found = format!("{} ({})", names.join(", "), kinds.join(", "));
    (!is_own).then(|| {
        format!("its problems are for {found}, and the goal's robot is {}, a {}", resident.name, resident.kind)
    })
}

/// Whether two parameters vary the same, wholly or in part. A problem is also where the goal's robot starts, and goes.
fn overlap(goal: Option<&GoalText>, a: &Parameter, b: &Parameter) -> bool {
    use RobotParameter::{Coordinate, Start};
    let is_start = |of: &Parameter| match of {
        Parameter::Robot { robot, of: Start | Coordinate(0 | 1), .. } => goal.is_some_and(|goal| goal.robot == *robot),
        _ => false,
    };
    let is_problem = |of: &Parameter| *of == Parameter::Run(RunParameter::Problem);
    let is_end = |of: &Parameter| is_start(of) || matches!(of, Parameter::Goal { .. });
    a.overlaps(b) || (is_problem(a) && is_end(b)) || (is_end(a) && is_problem(b))
}

/// Whether a problem of a problem file says it: a world, or any coordinate of where the goal's robot starts.
fn is_of_a_problem(goal: Option<&GoalText>, of: &Parameter) -> bool {
    use RobotParameter::{Coordinate, Start};
    use RunParameter::{WarehouseRobots, WarehouseSeed, World};
    match of {
        Parameter::Run(World | WarehouseRobots | WarehouseSeed) => true,
        Parameter::Robot { robot, of: Start | Coordinate(_), .. } => goal.is_some_and(|goal| goal.robot == *robot),
        _ => false,
    }
}

/// Checks that each start or goal has the number of coordinates of some robot of this name.
fn check_ends(
    end: &'static str,
    all: &[Vec<WrittenCoordinate>],
    robots: &[&Resident],
    robot: &str,
) -> Result<(), SweepProblem> {
    for (index, written) in all.iter().enumerate() {
        let reason = |known: &&Resident| {
            let lengths = RobotKind::of(&known.kind).map_or(0, |kind| kind.lengths);
            let start = match WrittenCoordinate::values(written, lengths) {
                Ok(start) => start,
                Err(problem) => return Some(problem.to_string()),
            };
            match Resident::try_new(robot, known.kind.clone(), start, None) {
                Err(problem @ WorldProblem::Start { .. }) => Some(problem.to_string()),
                // a start elsewhere, as beyond the lab, is for the row to say
                _ => None,
            }
        };
        let reasons: Option<Vec<String>> = robots.iter().filter(|known| known.name == robot).map(reason).collect();
        if let Some(reason) = reasons.and_then(|reasons| reasons.into_iter().next()) {
            return Err(SweepProblem::End { end, index, reason });
        }
    }
    Ok(())
}

/// The robots with columns of their own: all that are kept, of all worlds, unless they are many.
pub fn robot_columns(study: &StudyText, worlds: &[&World]) -> Vec<RobotColumns> {
    let mut robots: Vec<RobotColumns> = Vec::new();
    for resident in worlds.iter().flat_map(|w| &w.robots) {
        if study.keeps(&resident.name) && !robots.iter().any(|known| known.name == resident.name) {
            if robots.len() == MAX_ROBOT_COLUMNS {
                return Vec::new();
            }
            robots.push(RobotColumns { name: resident.name.clone(), kind: resident.kind.clone() });
        }
    }
    robots
}
