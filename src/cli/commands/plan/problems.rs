//! The problems that a command line names: its own ends, those of a problem file, or those of a scenario.

use std::path::Path;

use motion_lab_sim::plans::Task;

use super::args::PlanArgs;
use super::task;
use crate::batch::{ProblemSet, SetProblem};
use crate::cli::Failure;
use crate::cli::commands::query::Chosen;
use crate::cli::support::input::shown;
use crate::cli::support::world_source::{find_world, of_robot, read_problems, read_scenario};

/// All problems of a command line.
pub fn all(args: &PlanArgs) -> Result<ProblemSet, Failure> {
    let mut problems = match &args.problems {
        Some(file) => of_file(args, file)?,
        None => ProblemSet::of_task(own(args)?),
    };
    (problems.tube, problems.clearance, problems.checker) = (args.tube, args.clearance, args.checker);
    Ok(problems)
}

/// The problem of a command line: its own ends, or the one whose number is given.
pub fn one(args: &PlanArgs) -> Result<Task, Failure> {
    let task = match (&args.problems, args.problem) {
        (Some(file), Some(number)) => {
            let problems = of_file(args, file)?;
            let SetProblem { task, .. } = problems.numbered(number).ok_or_else(|| {
                let reason = format!("{}: no problem has the number {number}", shown(file));
                Failure::usage(reason, "Change --problem; `motion-lab problems` lists them.")
            })?;
            let reason = |reason: String| Failure::input(format!("{}: {reason}", shown(file)), "Take another problem.");
            Task { tube: args.tube, ..task.map_err(reason)? }
        }
        (Some(_), None) => {
            let next = "Give --problem for one of them, or --compare for all.";
            return Err(Failure::usage("--problems: there are several", next));
        }
        (None, _) => own(args)?,
    };
    Ok(Task { checker: args.checker, clearance: args.clearance, ..task })
}

/// The problem between the command line's own ends.
fn own(args: &PlanArgs) -> Result<Task, Failure> {
    let missing = |reason: &str, next: &str| Failure::usage(reason, next);
    let robot = args.robot.as_deref().ok_or_else(|| missing("no robot", "Give --robot."))?;
    let to = args.to.as_ref().ok_or_else(|| missing("no goal", "Give --to, or --problems."))?;
    task::find(robot, args.world.as_deref(), args.from.as_ref(), to, args.tube)
}

/// The problems of a file: one of problems, which ends in `.ron`, or a scenario.
fn of_file(args: &PlanArgs, file: &Path) -> Result<ProblemSet, Failure> {
    if file.extension().is_some_and(|extension| extension == "ron") {
        if args.world.is_some() {
            let next = "Leave out --world: each problem says its own.";
            return Err(Failure::usage("--world: a problem file names its worlds", next));
        }
        return of_robot(read_problems(file)?, args.robot.as_deref(), file);
    }
    let next = "Give --robot: a scenario says only where it goes. A problem file, which says more, ends in .ron.";
    let robot = args.robot.as_deref().ok_or_else(|| Failure::usage("no robot", next))?;
    let world = find_world(args.world.as_deref().unwrap_or_else(|| Chosen::home(robot)))?;
    let chosen = Chosen::find(robot, &world)?;
    if !chosen.goes_places() {
        let reason = format!("--problems: a {} does not go from place to place", chosen.kind_name());
        return Err(Failure::usage(reason, "Plan for a rover or a car: rusty, hitch."));
    }
    let scenario = read_scenario(file)?;
    let next = "Give the world of its map by --world; `motion-lab world import` makes it.";
    ProblemSet::of_scenario(&shown(file), scenario, robot, &world).map_err(|reason| Failure::input(reason, next))
}
