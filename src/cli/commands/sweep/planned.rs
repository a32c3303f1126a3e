//! A run whose inputs are made: by its script, or by a planner's path that is planned and played.

use crate::batch::{FailureKind, PlannedPath, Planning, PlanningResult, RunFailure, RunInputs, RunLength, RunSetup};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{PathLengths, PlannerName, Task};
use motion_lab_sim::run::{Recipe, seconds};
use motion_lab_sim::simulation::PlayedPath;
use motion_lab_sim::tour::TourConfig;

use crate::cli::commands::plan::planners::planners;
use crate::cli::commands::plan::solve;

/// What became of a run's inputs.
pub enum PlannedInputs {
    /// They are there; with what came of planning, where a planner made them.
    Run(Box<Recipe>, Option<PlanningResult>),
    /// There is a path, which no run plays.
    Path(PlanningResult),
    /// There are none, for this reason.
    None(RunFailure, PlanningResult),
    /// Somebody asked to stop.
    Stopped,
}

/// Why there is no script.
enum Why {
    /// There is no path, or none that can be played, for this reason.
    NoPath(RunFailure),
    /// Somebody asked to stop.
    Stopped,
}

impl From<String> for Why {
    fn from(reason: String) -> Self {
        Why::NoPath(RunFailure::new(FailureKind::Setup, reason))
    }
}

impl From<NoPath> for Why {
    fn from(reason: NoPath) -> Self {
        Why::NoPath(reason.into())
    }
}

/// The run of a row.
pub fn made(setup: RunSetup) -> PlannedInputs {
    let RunSetup { seed, mut config, length, inputs } = setup;
    let (script, planned) = match inputs {
        RunInputs::Script(script) => (script, None),
        RunInputs::Planner(planning) => {
            let mut planned = PlanningResult::default();
            match planned_script((&config, length), seed, &planning, &mut planned) {
                Ok(Some(played)) => {
                    config.ticks = length.ticks().unwrap_or(played.ticks);
                    (played.script, Some(planned))
                }
                Ok(None) => return PlannedInputs::Path(planned),
                Err(Why::NoPath(reason)) => return PlannedInputs::None(reason, planned),
                Err(Why::Stopped) => return PlannedInputs::Stopped,
            }
        }
    };
    PlannedInputs::Run(Box::new(Recipe::new(config, (seed, script))), planned)
}

/// The script that plays the path of the run's only robot; `None` where no run plays it. What comes of planning goes to
/// `planned`, as far as it gets.
fn planned_script(
    (config, run): (&TourConfig, RunLength),
    seed: Seed,
    planning: &Planning,
    planned: &mut PlanningResult,
) -> Result<Option<PlayedPath>, Why> {
    let world = config.worlds.iter().find(|world| !world.robots.is_empty());
    let world = world.ok_or_else(|| "no robot takes part in this run".to_owned())?;
    let (task, name) = task(world, planning)?;
    let mut attempt = task.attempt(name, seed)?;
    let solved = solve(attempt.as_mut(), name, planning.iterations, |_| {});
    let Effort { iterations, edges, .. } = attempt.effort();
    *planned = PlanningResult { iterations, edges, path: None };
    solved.ok_or(Why::Stopped)??;
    let PathLengths { length, clearance } = attempt.lengths();
    let path = PlannedPath { length, clearance, time: None };
    planned.path = Some(path);
    if run == RunLength::Unsimulated {
        return Ok(None);
    }
    let (_, played) = task.played(attempt.as_ref(), seed);
    let unplayable = |reason: String| Why::NoPath(RunFailure::new(FailureKind::Unplayable, reason));
    let played = played.ok_or_else(|| unplayable("there is no path to play".to_owned()))?;
    let played = played.map_err(|reason| unplayable(format!("the path can't be played: {reason}")))?;
    planned.path = Some(PlannedPath { time: Some(seconds(played.ticks)), ..path });
    Ok(Some(played))
}

/// The task of a world's only robot, and its planner; else the reason against it.
fn task(world: &World, planning: &Planning) -> Result<(Task, PlannerName), String> {
    let resident = &world.robots[0];
    let at = |q: &[f64]| {
        let placed = AnyRobot::sized(&resident.kind, q, resident.sizes.as_ref());
        placed.ok_or_else(|| {
            let has = RobotKind::of(&resident.kind).map_or(String::new(), |kind| format!(", which has {}", kind.start));
            format!("{q:?} is no configuration of {}, a {}{has}", resident.name, resident.kind)
        })
    };
    let ((robot, start), (other, goal)) = (at(&resident.start)?, at(&planning.goal)?);
    if other != robot {
        return Err("one of start and goal has a trailer's heading, the other has none".into());
    }
    let name = match &planning.planner {
        Some(name) => planners().named(name).map_err(|unknown| unknown.to_string())?,
        None => PlannerName::default_for(&robot),
    };
    let task = Task::new(resident.name.as_str(), robot, world.clone(), [start, goal]);
    // whoever walks by its sensor reads what the resident's sensor reads
    let noise = resident.sensor;
    Ok((Task { tube: planning.tube, clearance: planning.clearance, noise, ..task }, name))
}
