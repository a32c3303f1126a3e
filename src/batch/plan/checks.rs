//! What is checked when a plan is made: its robots, its goal, its planner and its axes.

use crate::batch::axis::Axis;
use crate::batch::columns::{MAX_ROBOT_COLUMNS, RobotColumns};
use crate::batch::error::SweepProblem;
use crate::batch::parameter::{Parameter, RobotParameter, Sources};
use crate::batch::plan_text::{GoalText, Item, PlanText};
use crate::batch::values::Over;
use motion_lab_core::configuration::{RobotKind, Sizes};
use motion_lab_core::worlds::{BeamModel, Resident, World, WorldProblem};

/// What is wrong with a robot's sizes or noise, when all axes have their values.
pub fn check(kind: &str, sizes: Option<&Sizes>, noise: Option<BeamModel>) -> Option<String> {
    let sizes = sizes.and_then(|sizes| sizes.check_for(kind).err()).map(|error| error.to_string());
    sizes.or_else(|| noise.and_then(|noise| noise.try_new().err()).map(|error| error.to_string()))
}

/// Checks the robots and the goal.
pub fn check_robots(plan: &PlanText, worlds: &[&World]) -> Result<(), (Item, SweepProblem)> {
    let find = |name: &str| worlds.iter().flat_map(|w| &w.robots).find(|r| r.name == name);
    let unknown = |robot: &str| {
        let names: Vec<&str> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str()).take(20).collect();
        let there = if names.is_empty() { "none".into() } else { names.join(", ") };
        SweepProblem::Robot { robot: robot.to_owned(), there }
    };
    if let Some(robot) = plan.robots.iter().find(|name| find(name).is_none()) {
        return Err((Item::Robots, unknown(robot)));
    }
    let Some(GoalText { robot, at, within }) = &plan.goal else { return Ok(()) };
    let Some(resident) = find(robot).filter(|_| plan.keeps(robot)) else { return Err((Item::Goal, unknown(robot))) };
    let (coordinates, tolerances, expected) = (at.len(), within.len(), resident.start.len());
    if coordinates != expected || tolerances != expected {
        return Err((Item::Goal, SweepProblem::Goal { coordinates, tolerances, expected }));
    }
    if let Some(wrong) = at.iter().chain(within).find(|x| !x.is_finite()) {
        return Err((Item::Goal, SweepProblem::NotFinite(*wrong)));
    }
    match within.iter().find(|tolerance| **tolerance < 0.0) {
        Some(wrong) => Err((Item::Goal, SweepProblem::Tolerance(*wrong))),
        None => Ok(()),
    }
}

/// Checks that a plan with a planner says who goes where, and nothing else that drives its robot.
pub fn check_planner(plan: &PlanText) -> Result<(), (Item, SweepProblem)> {
    let refused = |reason| Err((Item::Planner, SweepProblem::Planner(reason)));
    match &plan.planner {
        Some(_) if plan.script.is_some() => refused("the plan has a script too, and its robot follows one of them"),
        Some(_) if plan.goal.is_none() => refused("it needs a goal, which says what robot goes where"),
        _ => Ok(()),
    }
}

/// The unit of planned paths: radians where the goal's robot is an arm. `None` without a planner.
pub fn planned_unit(plan: &PlanText, worlds: &[&World]) -> Option<&'static str> {
    let (_, GoalText { robot, .. }) = plan.planner.as_ref().zip(plan.goal.as_ref())?;
    let resident = worlds.iter().flat_map(|world| &world.robots).find(|resident| resident.name == *robot)?;
    RobotKind::of(&resident.kind).map(|kind| kind.unit_of(0))
}

/// The axes, each of which varies something.
pub fn make_axes(plan: &PlanText, worlds: &[&World]) -> Result<Vec<Axis>, (Item, SweepProblem)> {
    let mut axes: Vec<Axis> = Vec::with_capacity(plan.axes.len());
    let robots: Vec<&Resident> =
        worlds.iter().flat_map(|world| &world.robots).filter(|robot| plan.keeps(&robot.name)).collect();
    let there =
        Sources { sensor: !plan.no_sensor, warehouse: plan.warehouse.is_some(), planner: plan.planner.is_some() };
    for (i, text) in plan.axes.iter().enumerate() {
        let refused = |problem| (Item::Axis(i), problem);
        let parameter =
            Parameter::named(&text.vary, worlds).map_err(|there| refused(SweepProblem::Parameter(there)))?;
        if let Some(before) = axes.iter().position(|axis| axis.parameter.overlaps(&parameter)) {
            return Err(refused(SweepProblem::Twice(before)));
        }
        let axis = Axis::try_new(parameter, text.over.clone()).map_err(refused)?;
        if let Some(reason) = axis.parameter.idle(&robots, there) {
            return Err(refused(SweepProblem::Idle(reason)));
        }
        if let (Parameter::Robot { robot, of: RobotParameter::Start, .. }, Over::Starts(starts)) =
            (&axis.parameter, &text.over)
        {
            check_starts(starts, &robots, robot).map_err(refused)?;
        }
        axes.push(axis);
    }
    Ok(axes)
}

/// Checks that each start has the number of coordinates of some robot of this name.
fn check_starts(starts: &[Vec<f64>], robots: &[&Resident], robot: &str) -> Result<(), SweepProblem> {
    for (index, start) in starts.iter().enumerate() {
        let reason = |known: &&Resident| match Resident::try_new(robot, known.kind.clone(), start.clone(), None) {
            Err(problem @ WorldProblem::Start { .. }) => Some(problem.to_string()),
            // a start elsewhere, as beyond the lab, is for the row to say
            _ => None,
        };
        let reasons: Option<Vec<String>> = robots.iter().filter(|known| known.name == robot).map(reason).collect();
        if let Some(reason) = reasons.and_then(|reasons| reasons.into_iter().next()) {
            return Err(SweepProblem::Start { index, reason });
        }
    }
    Ok(())
}

/// The robots with columns of their own: all that are kept, of all worlds, unless they are many.
pub fn robot_columns(plan: &PlanText, worlds: &[&World]) -> Vec<RobotColumns> {
    let mut robots: Vec<RobotColumns> = Vec::new();
    for resident in worlds.iter().flat_map(|w| &w.robots) {
        if plan.keeps(&resident.name) && !robots.iter().any(|known| known.name == resident.name) {
            if robots.len() == MAX_ROBOT_COLUMNS {
                return Vec::new();
            }
            robots.push(RobotColumns { name: resident.name.clone(), kind: resident.kind.clone() });
        }
    }
    robots
}
