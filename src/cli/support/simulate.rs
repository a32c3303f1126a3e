//! Starting, repeating and showing runs, for several commands.

use std::path::Path;

use motion_lab::configuration::RobotKind;
use motion_lab::random::Seed;
use motion_lab::recording::{DigestVerification, Recorder, Run, RunError, Verification};
use motion_lab::run::{DigestLog, Frame, Log, RunDigest, Script};
use motion_lab::simulation::SpawnError;
use motion_lab::tour::TourConfig;

use super::log_kind::{AnyComparison, AnyLog};
use super::progress::Progress;
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

fn refused(error: &RunError) -> Failure {
    Failure::input(error, advice(error))
}

/// A run at tick 0, which only goes ahead.
pub fn begin(seed: Seed, config: &TourConfig, script: &Script) -> Result<Recorder, Failure> {
    let run = Recorder::new(config.clone(), (seed, script.clone())).map_err(|error| refused(&error))?;
    Ok(run.without_keyframes())
}

/// Simulates a log's run again and compares it: see [`motion_lab::recording::verify`].
pub fn verify(log: &Log, on_tick: impl FnMut(&Recorder)) -> Result<Verification, Failure> {
    motion_lab::recording::verify(log, on_tick).map_err(|error| refused(&error))
}

/// Simulates the run of a digest log again and compares it: see [`motion_lab::recording::verify_digests`].
pub fn verify_digests(log: &DigestLog, on_tick: impl FnMut(&Recorder)) -> Result<DigestVerification, Failure> {
    motion_lab::recording::verify_digests(log, on_tick).map_err(|error| refused(&error))
}

/// Calls `see` with every frame of a log, from tick 0 on, and shows how far it has come. The frames of a digest log are
/// made by simulating its run again; what then differs from its digests is returned, in words.
pub fn each_frame(log: &AnyLog, mut see: impl FnMut(&Frame)) -> Result<Option<String>, Failure> {
    let (seed, config, script) = log.parts();
    let progress = Progress::of(log.recorded(), "ticks");
    let mut see = |frame: &Frame| {
        see(frame);
        progress.at(frame.tick);
    };
    if let AnyLog::Full(log) = log {
        std::iter::once(&log.initial).chain(&log.frames).for_each(see);
        return Ok(None);
    }
    let mut run = begin(seed, config, script)?;
    let mut digest = RunDigest::new(seed, config, script, run.frame());
    let mut comparison = AnyComparison::with(log);
    comparison.frame(run.frame(), &digest);
    see(run.frame());
    for _ in 0..log.recorded() {
        let frame = run.step();
        digest.tick(frame);
        comparison.frame(frame, &digest);
        see(frame);
    }
    Ok(comparison.difference(config))
}

/// The reason to stop showing a run.
enum Stop {
    Run(RunError),
    Own(Failure),
}

impl From<RunError> for Stop {
    fn from(error: RunError) -> Self {
        Stop::Run(error)
    }
}

/// Calls `watch` with the run of the log in `file`, in the state of each of its frames: see [`Run::show`].
pub fn show(
    file: &Path,
    log: &Log,
    mut watch: impl FnMut(&Recorder, &Frame) -> Result<(), Failure>,
) -> Result<(), Failure> {
    Run::show(log, |run| watch(run, run.frame()).map_err(Stop::Own)).map_err(|stop| match stop {
        Stop::Own(failure) => failure,
        Stop::Run(error) => not_shown(file, &error),
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
