//! One run, tick by tick.

use std::io;
use std::path::{Path, PathBuf};

use motion_lab::random::Seed;
use motion_lab::run::{DT, Digest, Frame, LogError, RunDigest, Script};
use motion_lab::simulation::Refusals;
use motion_lab::tour::TourConfig;

use crate::cli::support::interrupt;
use crate::cli::support::log_kind::{AnyComparison, AnyLog, AnyWriter, LogKind};
use crate::cli::support::output::PendingFile;
use crate::cli::support::progress::Progress;
use crate::cli::support::simulate::begin;
use crate::cli::support::summary::RunSummary;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Number of ticks in a second of simulated time.
const SECOND: u64 = (1.0 / DT) as u64;

/// A run to be recorded.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The seed.
    pub seed: Seed,
    /// The configuration.
    pub config: TourConfig,
    /// The script.
    pub script: Script,
    /// What its log keeps.
    pub kind: LogKind,
}

/// When to stop early.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stop {
    /// After this tick.
    pub after: Option<u64>,
    /// Whether somebody else says how far the run has come.
    pub unwatched: bool,
    /// With a failure at the first input that is refused.
    pub at_refusal: bool,
}

impl Stop {
    /// The progress of a run of this number of ticks.
    fn progress(self, ticks: u64) -> Progress {
        if self.unwatched { Progress::none() } else { Progress::of(ticks, "ticks") }
    }

    fn now(self, tick: u64) -> bool {
        self.after.is_some_and(|after| tick >= after) || interrupt::asked_to_stop()
    }
}

/// How a run ended.
pub enum Ended {
    /// After its last tick.
    Whole {
        /// The last frame.
        last: Frame,
        /// The run's digest.
        digest: Digest,
        /// The inputs that were refused.
        refusals: Refusals,
    },
    /// Early, after this tick.
    Stopped(u64),
    /// At the first value or second that differs from the expected one, in words.
    Differs(String),
}

/// Runs `plan` and hands every frame to `sink`, that of tick 0 first, with the run's digest up to it. Ends early when
/// `stop` says so, or at the first difference from `expected`.
pub fn run(
    plan: &Plan,
    expected: Option<&AnyLog>,
    stop: Stop,
    mut sink: impl FnMut(&Frame, &RunDigest) -> Result<(), Failure>,
) -> Result<Ended, Failure> {
    let Plan { seed, config, script, .. } = plan;
    let watched = stop.progress(config.ticks);
    let mut run = begin(*seed, config, script)?;
    let mut digest = RunDigest::new(*seed, config, script, run.frame());
    sink(run.frame(), &digest)?;
    let mut comparison = expected.map(AnyComparison::with);
    if let Some(difference) = differs(&mut comparison, config, run.frame(), &digest) {
        return Ok(Ended::Differs(difference));
    }
    while !run.is_complete() {
        let tick = run.frame().tick;
        if stop.now(tick) {
            return Ok(Ended::Stopped(tick));
        }
        run.step();
        if let Some(refused) = run.refusals().first().filter(|_| stop.at_refusal) {
            let next = "Its log was not written. Correct the script; `record` without --strict goes on.";
            return Err(Failure::input(format!("seed {seed}, {refused}"), next));
        }
        let frame = run.frame();
        digest.tick(frame);
        if let Some(difference) = differs(&mut comparison, config, frame, &digest) {
            return Ok(Ended::Differs(difference));
        }
        sink(frame, &digest)?;
        watched.at(frame.tick);
    }
    Ok(Ended::Whole { last: run.frame().clone(), digest: digest.digest(), refusals: run.refusals().clone() })
}

/// What differs of a frame from the expected one, in words.
fn differs(
    comparison: &mut Option<AnyComparison>,
    config: &TourConfig,
    frame: &Frame,
    digest: &RunDigest,
) -> Option<String> {
    let comparison = comparison.as_mut()?;
    if comparison.frame(frame, digest) { None } else { comparison.difference(config) }
}

/// As [`run`], and writes the log to `output`.
///
/// Where the run stops early or the disk takes no more, what was done is kept in the file that [`partial_name`] names,
/// unless all of it is in `expected` already.
pub fn write_run(plan: &Plan, expected: Option<&AnyLog>, stop: Stop, output: &Path) -> Result<Ended, Failure> {
    write_run_watched(plan, expected, stop, output, |_| {})
}

/// As [`write_run`], and calls `see` with every frame, that of tick 0 first.
pub fn write_run_watched(
    plan: &Plan,
    expected: Option<&AnyLog>,
    stop: Stop,
    output: &Path,
    mut see: impl FnMut(&Frame),
) -> Result<Ended, Failure> {
    let failed = |error: LogError| match error {
        LogError::Io(error) => Failure::output(output, &error),
        error => Failure::internal(error),
    };
    let mut file = Some(PendingFile::create(output)?);
    let mut writer: Option<AnyWriter<PendingFile>> = None;
    let mut last = None;
    // the last tick that the operating system took
    let mut taken = 0;
    let ended = run(plan, expected, stop, |frame, digest| {
        see(frame);
        match &mut writer {
            Some(writer) => {
                writer.tick(frame, digest).map_err(failed)?;
                last = Some(digest.digest());
                // a killed process loses at most a second of the run
                if frame.tick % SECOND == 0 {
                    writer.flush().map_err(failed)?;
                    taken = frame.tick;
                }
                Ok(())
            }
            None => {
                let Some(file) = file.take() else { return Err(failed(io::Error::other("begun twice").into())) };
                let parts = (plan.seed, &plan.config, &plan.script);
                writer = Some(AnyWriter::new(file, plan.kind, parts, frame, digest).map_err(failed)?);
                last = Some(digest.digest());
                Ok(())
            }
        }
    });
    let (Some(mut writer), Some(last)) = (writer, last) else { return ended };
    let before = expected.map_or(0, AnyLog::recorded);
    let finished = match &ended {
        Ok(Ended::Whole { .. }) => writer.end(last).map_err(failed).map(|()| Some(output.to_owned())),
        Ok(Ended::Stopped(tick)) if *tick > before || before == 0 => {
            writer.stop(last).map_err(failed).map(|()| Some(partial_name(output)))
        }
        _ => Ok(None),
    };
    let mut file = writer.into_inner();
    let finished = finished.and_then(|name| match name {
        Some(name) => file.sync().map(|()| Some(name)).map_err(|error| failed(error.into())),
        None => Ok(None),
    });
    match (ended, finished) {
        (Ok(ended @ Ended::Whole { .. }), Ok(_)) => file.commit().map(|()| ended),
        (Ok(ended), Ok(Some(name))) => file.keep_as(&name).map(|()| ended),
        (Err(failure @ Failure::Output { .. }), _) | (Ok(_), Err(failure)) if taken > before => {
            Err(kept(file, output, failure))
        }
        (Ok(_), Err(failure)) => Err(failure),
        (ended, _) => ended,
    }
}

/// The failure of a write, after what the disk took before was kept.
fn kept(file: PendingFile, output: &Path, failure: Failure) -> Failure {
    let partial = partial_name(output);
    match (failure, file.keep_as(&partial)) {
        (Failure::Output { file, reason, next }, Ok(())) => {
            let next =
                format!("{next}\nWhat was done is kept; go on with: motion-lab record --resume {}", partial.display());
            Failure::Output { file, reason, next }
        }
        (Failure::Output { file, reason, next }, Err(Failure::Output { reason: further, .. })) => {
            Failure::Output { file, reason: format!("{reason}; {}: {further}", partial.display()), next }
        }
        (failure, _) => failure,
    }
}

/// The name of a recording that stopped early: the output's name with `.partial` behind it.
pub fn partial_name(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".partial");
    name.into()
}

/// `3 inputs of the script were refused, the first at tick 260: ...`.
pub fn refused_in_words(count: u64, first: &str) -> String {
    match count {
        1 => format!("1 input of the script was refused, at {first}"),
        _ => format!("{count} inputs of the script were refused, the first at {first}"),
    }
}

/// The form in which a run's end is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Printed {
    /// A table with names and units.
    Words,
    /// Configurations in Rust's spelling.
    Debug,
    /// A line of JSON.
    Json,
}

/// Records one run and says what came of it.
pub fn record(
    plan: &Plan,
    expected: Option<&AnyLog>,
    output: Option<&Path>,
    stop: Stop,
    form: Printed,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    let target = output.map(Target::file).transpose()?;
    let ended = match output {
        Some(output) => write_run(plan, expected, stop, output)?,
        None => run(plan, expected, stop, |_, _| Ok(()))?,
    };
    match ended {
        Ended::Whole { last, digest, refusals } => {
            let summary = RunSummary::new(plan.seed, &plan.config, &last, digest);
            if form == Printed::Json {
                data.json(&summary)?;
            } else {
                summary.print_robots(form == Printed::Debug, data)?;
                data.line(format!("digest {digest}"))?;
            }
            if let Some(target) = target {
                target.wrote();
            }
            if let Some(first) = refusals.first() {
                say(refused_in_words(refusals.count(), &first.to_string()));
            }
            Ok(Outcome::Done)
        }
        Ended::Stopped(tick) if expected.is_some_and(|log| tick <= log.recorded() && log.recorded() > 0) => {
            say(format!("stopped after tick {tick}, before the end of the existing recording, which is unchanged"));
            Ok(Outcome::Stopped)
        }
        Ended::Stopped(tick) => {
            let ticks = plan.config.ticks;
            match output.map(partial_name) {
                Some(kept) => say(format!(
                    "stopped after tick {tick} of {ticks}\nIt is kept; go on with: motion-lab record --resume {}",
                    kept.display()
                )),
                None => say(format!(
                    "stopped after tick {tick} of {ticks}\nNothing was saved, because -o FILE was not given. Start again."
                )),
            }
            Ok(Outcome::Stopped)
        }
        Ended::Differs(difference) => {
            say(format!(
                "the run does not repeat its recording: {difference}\nNothing was written. Was it recorded by another version?"
            ));
            Ok(Outcome::Differs)
        }
    }
}
