//! Playing a path: its script, and the log of the run that it drives.

use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::plans::{PlanAttempt, Task};
use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::simulation::{PlayError, PlayedPath};
use motion_lab_sim::tour::TourConfig;

use super::answer::PlanAnswer;
use crate::cli::commands::record::{Ended, StopRule, write_run};
use crate::cli::support::output::write_file;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure};

/// The ticks that a run goes on for after the path's end.
const AFTER: u64 = 20;

/// A path that can be played, and where.
pub struct Played {
    /// The world with the robot alone.
    world: World,
    seed: Seed,
    played: PlayedPath,
}

/// The script of the path that an attempt has found, or why it can't be played.
pub fn play(task: &Task, attempt: &dyn PlanAttempt, seed: Seed) -> Result<Result<Played, PlayError>, Failure> {
    if task.name == "choset" {
        let reason = "an arm without thickness lives in no world, so it can't play its path";
        return Err(Failure::usage(reason, "Plan for --robot reach."));
    }
    let (world, played) = task.played(attempt, seed);
    match played {
        Some(Ok(played)) => Ok(Ok(Played { world, seed, played })),
        Some(Err(reason)) => Ok(Err(reason)),
        None => Err(Failure::internal(anyhow::anyhow!("no path is to be played"))),
    }
}

/// What to do about a path that can't be played.
pub fn next(reason: &PlayError) -> &'static str {
    match reason {
        PlayError::LeavesTube { .. } | PlayError::NotFree { .. } | PlayError::Held { .. } => {
            "Try another --seed or a wider --tube."
        }
        _ => "Leave out --script and --record to have the path alone.",
    }
}

impl Played {
    /// Writes the script and the log, and puts what they are into the answer.
    pub fn write(
        &self,
        script: Option<Target>,
        log: Option<Target>,
        answer: &mut PlanAnswer,
        data: &mut Data,
    ) -> Result<(), Failure> {
        let Played { world, seed, played } = self;
        (answer.ticks, answer.strayed) = (Some(played.ticks), Some(JsonNumber(played.strayed)));
        if let Some(target) = script {
            write_file(&target, played.script.to_ron().as_bytes())?;
            target.finish(data)?;
        }
        if let Some(target) = log {
            let config = TourConfig { worlds: vec![world.clone()], ticks: played.ticks + AFTER, sensor: None };
            let recipe = Recipe::new(config, (*seed, played.script.clone()));
            let stop = StopRule { at_refusal: true, ..StopRule::default() };
            match write_run(&recipe, LogKind::Frames, None, stop, &target)? {
                Ended::Whole { digest, last, .. } => {
                    let contacts: u32 = last.robots.iter().map(|robot| robot.contacts).sum();
                    (answer.contacts, answer.digest) = (Some(contacts), Some(digest.to_string()));
                    target.wrote();
                }
                Ended::Stopped(_) | Ended::Differs(_) => {}
            }
        }
        Ok(())
    }
}
