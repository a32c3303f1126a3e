//! `Cases`, what planners are compared by: the ends of one problem, or those of every problem of a scenario.

use std::path::Path;

use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_import::{MapCell, Scenario};
use motion_lab_sim::plans::Task;

use super::args::PlanArgs;
use super::task;
use crate::batch::{KnownProblem, PlanCase};
use crate::cli::Failure;
use crate::cli::commands::query::Chosen;
use crate::cli::support::choices::NumberList;
use crate::cli::support::world_source::read_scenario;

/// The task with its cases, at least one.
pub struct Cases {
    /// The robot in its world, with the ends of the first case.
    pub task: Task,
    pub all: Vec<PlanCase>,
}

impl Cases {
    /// The cases of a command line.
    pub fn of(args: &PlanArgs) -> Result<Self, Failure> {
        let world = args.world.as_deref();
        match (&args.problems, &args.to) {
            (Some(file), _) => Cases::of_scenario(&args.robot, world, file, args.tube),
            (None, Some(to)) => {
                let task = task::find(&args.robot, world, args.from.as_ref(), to, args.tube)?;
                let all = vec![PlanCase { ends: [task.start, task.goal], problem: None }];
                Ok(Cases { task, all })
            }
            (None, None) => Err(Failure::usage("no goal", "Give --to, or with --compare a scenario by --problems.")),
        }
    }

    fn of_scenario(name: &str, world: Option<&str>, file: &Path, tube: f64) -> Result<Self, Failure> {
        let (chosen, world) = Chosen::in_world(name, world)?;
        let kind = chosen.kind_name();
        if RobotKind::of(kind).is_none_or(|known| known.lengths < 2) {
            let reason = format!("--problems: a {kind} does not go from place to place");
            return Err(Failure::usage(reason, "Plan for a rover or a car: rusty, hitch."));
        }
        let scenario = read_scenario(file)?;
        let fitted = scenario.metres_per_cell(&file.display().to_string(), &world.bounds);
        let next = "Give the world of its map by --world; `motion-lab world import` makes it.";
        let scale = fitted.map_err(|error| Failure::input(error, next))?;
        // headings are those of the robot's own start
        let headings = chosen.start.as_deref().and_then(|start| start.get(2..)).unwrap_or(&[0.0]);
        let at = |scenario: &Scenario, cell: MapCell| {
            let middle = scenario.pose(cell, scale);
            let (x, y) = (world.bounds.min.x + middle.x, world.bounds.min.y + middle.y);
            let numbers = [x, y].into_iter().chain(headings.iter().copied()).map(WrittenCoordinate::number);
            chosen.written(Some(&NumberList(numbers.collect())), &world)
        };
        let see = "`motion-lab plan --help` says which numbers a robot has.";
        let mut all = Vec::with_capacity(scenario.problems.len());
        let mut robot = None;
        for (number, problem) in (1..).zip(&scenario.problems) {
            let usage = |reason: String| Failure::usage(format!("problem {number}: {reason}"), see);
            let (found, start) = at(&scenario, problem.start).map_err(usage)?;
            let (_, goal) = at(&scenario, problem.goal).map_err(usage)?;
            robot.get_or_insert(found);
            let problem = KnownProblem { number, bucket: problem.bucket, optimal: problem.length * scale };
            all.push(PlanCase { ends: [start, goal], problem: Some(problem) });
        }
        let (Some(robot), Some(first)) = (robot, all.first()) else {
            return Err(Failure::input(format!("{}: it has no problem", file.display()), next));
        };
        Ok(Cases { task: Task { tube, ..Task::new(name, robot, world, first.ends) }, all })
    }
}
