//! The task that the command line names, and planners by their names.

use clap::builder::TypedValueParser;
use motion_lab::planning::NoPath;
use motion_lab::plans::{PlanAttempt, PlannerName, Task};
use motion_lab::random::Seed;
use motion_lab::robots::AnyRobot;

use crate::cli::Failure;
use crate::cli::commands::query::Chosen;
use crate::cli::support::choices::{NumberList, one_of};

/// The task of these arguments.
pub fn find(
    name: &str,
    world: Option<&str>,
    from: Option<&NumberList>,
    to: &NumberList,
    tube: f64,
) -> Result<Task, Failure> {
    let (chosen, world) = Chosen::in_world(name, world)?;
    let see = "`motion-lab plan --help` says which numbers a robot has.";
    let at = |option: &str, numbers: Option<&NumberList>| {
        chosen.written(numbers, &world).map_err(|reason| Failure::usage(format!("{option}: {reason}"), see))
    };
    let (robot, start) = at("--from", from)?;
    let (other, goal) = at("--to", Some(to))?;
    if other != robot {
        let reason = "one of --from and --to has a trailer's heading, the other has none";
        return Err(Failure::usage(reason, "Give both four numbers, or both three."));
    }
    Ok(Task { tube, ..Task::new(name, robot, world, [start, goal]) })
}

/// The planner of this name with the problem, ready to begin; or why there is no problem.
pub fn attempt(task: &Task, name: PlannerName, seed: Seed) -> Result<Result<Box<dyn PlanAttempt>, NoPath>, Failure> {
    let is_car = matches!(task.robot, AnyRobot::Hitch(_));
    let is_cars = name == PlannerName::HybridAStar;
    if let (true, Err(reason)) = (is_car != is_cars, name.suits(&task.robot)) {
        let instead = PlannerName::default_for(&task.robot).id();
        return Err(Failure::usage(format!("{}: {reason}", name.id()), format!("Use --planner {instead}.")));
    }
    Ok(task.attempt(name, seed))
}

/// Reads the name of a planner.
pub fn planner_name() -> impl TypedValueParser<Value = PlannerName> {
    one_of(PlannerName::ALL.map(|name| (name.id(), name, name.words())))
}
