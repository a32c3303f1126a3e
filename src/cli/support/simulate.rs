//! Starting, repeating and showing runs, for several commands.

use std::path::Path;

use motion_lab_core::configuration::RobotKind;
use motion_lab_sim::recording::{Recorder, Run, RunError, Verification};
use motion_lab_sim::run::{Comparison, Difference, Frame, Log, Recipe, Recorded};
use motion_lab_sim::simulation::SpawnError;

use super::progress::CommandProgress;
use super::words::unfit;
use crate::cli::Failure;

/// Advice about a run that can't start.
fn advice(error: &RunError) -> String {
    match error {
        RunError::Spawn(SpawnError::UnknownKind { .. }) => unknown_kind(),
        _ => "Change the world file, the script or --robot.".into(),
    }
}

/// What to do about a kind of robot that the lab does not have.
pub fn unknown_kind() -> String {
    let own: Vec<&str> = RobotKind::ALL.iter().map(|kind| kind.name).collect();
    format!(
        "The lab's kinds are {}. A program adds any other by a `RobotPlugin`: record, verify, replay and draw with the \
         program that made it, as examples/custom_robot.rs and the guide's chapter `bevy_app` show.",
        own.join(", ")
    )
}

/// The failure of a run that cannot start.
pub fn refused(error: &RunError) -> Failure {
    Failure::input(error, advice(error))
}

/// The failure of a recipe's run that cannot start; where its script does not fit, with the robots that there are.
pub fn unstarted(error: RunError, recipe: &Recipe) -> Failure {
    match error {
        RunError::Spawn(SpawnError::Script(problem)) => unfit(problem, &recipe.config),
        error => refused(&error),
    }
}

/// The run of a recipe at tick 0, which only goes ahead.
pub fn begin(recipe: &Recipe) -> Result<Recorder, Failure> {
    Ok(Recorder::of(recipe).map_err(|error| unstarted(error, recipe))?.without_keyframes())
}

/// Simulates a log's run again and compares it: see [`motion_lab_sim::recording::verify`].
pub fn verify(log: &Log, on_tick: impl FnMut(&Recorder)) -> Result<Verification, Failure> {
    motion_lab_sim::recording::verify(log, on_tick).map_err(|error| refused(&error))
}

/// Calls `see` with every frame of a log, from tick 0 on, and shows how far it has come. The frames of a log of digests
/// are made by simulating its run again; what then differs from its digests is returned.
pub fn each_frame(log: &Log, mut see: impl FnMut(&Frame)) -> Result<Option<Difference>, Failure> {
    let progress = CommandProgress::of(log.ticks(), "ticks");
    let mut see = |frame: &Frame| {
        see(frame);
        progress.at(frame.tick);
    };
    if let Recorded::Frames { initial, frames } = &log.recorded {
        std::iter::once(initial).chain(frames).for_each(see);
        return Ok(None);
    }
    let mut run = begin(&log.recipe)?;
    let mut comparison = Comparison::begin(log, run.frame());
    see(run.frame());
    for _ in 0..log.ticks() {
        let frame = run.step();
        comparison.tick(frame);
        see(frame);
    }
    Ok(comparison.difference().cloned())
}

/// The reason to stop showing a run.
enum StopReason {
    Run(RunError),
    Own(Failure),
}

impl From<RunError> for StopReason {
    fn from(error: RunError) -> Self {
        StopReason::Run(error)
    }
}

/// Calls `watch` with the run of the log in `file`, in the state of each of its frames: see [`Run::show`].
pub fn show(
    file: &Path,
    log: &Log,
    mut watch: impl FnMut(&Recorder, &Frame) -> Result<(), Failure>,
) -> Result<(), Failure> {
    Run::show(log, |run| watch(run, run.frame()).map_err(StopReason::Own)).map_err(|stop| match stop {
        StopReason::Own(failure) => failure,
        StopReason::Run(error) => not_shown(file, &error),
    })
}

/// The failure of a run that can't be shown.
pub fn not_shown(file: &Path, error: &RunError) -> Failure {
    match error {
        RunError::Restore(_) => Failure::input(
            format!("{}: {error}", file.display()),
            "The log holds what no run gives; `motion-lab verify` says where it differs.",
        ),
        error => refused(error),
    }
}
