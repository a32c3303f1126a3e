//! The task that the command line names.

use motion_lab_core::planning::NoPath;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::plans::{PlanAttempt, PlannerName, Task};

use crate::cli::Failure;
use crate::cli::commands::query::Chosen;
use crate::cli::support::choices::NumberList;

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
    fits(name, &task.robot)?;
    Ok(task.attempt(name, seed))
}

/// Refuses a planner of straight lines for a car, and one of cars for another robot.
pub fn fits(name: PlannerName, robot: &AnyRobot) -> Result<(), Failure> {
    let is_car = matches!(robot, AnyRobot::Hitch(_));
    let is_cars = name.plans_for_cars_alone();
    if let (true, Err(reason)) = (is_car != is_cars, name.suits(robot)) {
        let instead = PlannerName::default_for(robot).id();
        return Err(Failure::usage(format!("{}: {reason}", name.id()), format!("Use --planner {instead}.")));
    }
    Ok(())
}
