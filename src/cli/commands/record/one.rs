//! One run, tick by tick.

use std::io;
use std::path::Path;

use motion_lab_sim::run::{Comparison, DT, Digest, Frame, Log, LogError, LogKind, LogWriter, Recipe, RunDigest};
use motion_lab_sim::simulation::Refusals;

use crate::cli::support::interrupt;
use crate::cli::support::output::ReportedFile;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::begin;
use crate::cli::support::summary::RunSummary;
use crate::cli::support::target::{Target, partial_name};
use crate::cli::{Data, Failure, Outcome, say};

/// Number of ticks in a second of simulated time.
const SECOND: u64 = (1.0 / DT) as u64;

/// When to stop early.
#[derive(Clone, Copy, Debug, Default)]
pub struct StopRule {
    /// After this tick.
    pub after: Option<u64>,
    /// Whether somebody else says how far the run has come.
    pub unwatched: bool,
    /// With a failure at the first input that is refused.
    pub at_refusal: bool,
}

impl StopRule {
    /// The progress of a run of this number of ticks.
    fn progress(self, ticks: u64) -> CommandProgress {
        if self.unwatched { CommandProgress::none() } else { CommandProgress::of(ticks, "ticks") }
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

/// What takes the frames of a run.
pub trait FrameSink {
    /// Takes the next frame, that of tick 0 first.
    fn take(&mut self, frame: &Frame) -> Result<(), Failure>;

    /// The digest of the run so far.
    fn digest(&self) -> Digest;
}

/// Runs a recipe and hands every frame to `sink`. Ends early when `stop` says so, or at the first difference from
/// `expected`.
fn run_into(
    recipe: &Recipe,
    expected: Option<&Log>,
    stop: StopRule,
    sink: &mut impl FrameSink,
) -> Result<Ended, Failure> {
    let watched = stop.progress(recipe.config.ticks);
    let mut run = begin(recipe)?;
    sink.take(run.frame())?;
    let mut comparison = expected.map(|log| Comparison::begin(log, run.frame()));
    loop {
        if let Some(difference) = comparison.as_ref().and_then(Comparison::difference) {
            return Ok(Ended::Differs(difference.to_string()));
        }
        if run.is_complete() {
            break;
        }
        let tick = run.frame().tick;
        if stop.now(tick) {
            return Ok(Ended::Stopped(tick));
        }
        run.step();
        if let Some(refused) = run.refusals().first().filter(|_| stop.at_refusal) {
            let next = "Its log was not written. Correct the script; `record` without --strict goes on.";
            return Err(Failure::input(format!("seed {}, {refused}", recipe.seed), next));
        }
        let frame = run.frame();
        if !comparison.as_mut().is_none_or(|comparison| comparison.tick(frame)) {
            continue;
        }
        sink.take(frame)?;
        watched.at(frame.tick);
    }
    Ok(Ended::Whole { last: run.frame().clone(), digest: sink.digest(), refusals: run.refusals().clone() })
}

/// Runs a recipe and calls `see` with every frame, that of tick 0 first.
pub fn run(recipe: &Recipe, stop: StopRule, see: impl FnMut(&Frame)) -> Result<Ended, Failure> {
    run_into(recipe, None, stop, &mut WatchedRun { recipe, run: None, see })
}

/// A run whose frames are seen, and hashed.
struct WatchedRun<'a, F> {
    recipe: &'a Recipe,
    run: Option<RunDigest>,
    see: F,
}

impl<F: FnMut(&Frame)> FrameSink for WatchedRun<'_, F> {
    fn take(&mut self, frame: &Frame) -> Result<(), Failure> {
        (self.see)(frame);
        match &mut self.run {
            Some(run) => run.tick(frame),
            None => self.run = Some(RunDigest::new(self.recipe, frame)),
        }
        Ok(())
    }

    fn digest(&self) -> Digest {
        self.run.as_ref().map_or(Digest(0), RunDigest::digest)
    }
}

/// The log of a run under way.
struct Writing<'a, F> {
    recipe: &'a Recipe,
    kind: LogKind,
    output: &'a Path,
    file: Option<ReportedFile>,
    writer: Option<LogWriter<ReportedFile>>,
    /// The last tick that the operating system took.
    taken: u64,
    see: F,
}

impl<F> Writing<'_, F> {
    fn failed(&self, error: LogError) -> Failure {
        match error {
            LogError::Io(error) => Failure::output(self.output, &error),
            error => Failure::internal(error),
        }
    }
}

impl<F: FnMut(&Frame)> FrameSink for Writing<'_, F> {
    fn take(&mut self, frame: &Frame) -> Result<(), Failure> {
        (self.see)(frame);
        let Some(writer) = &mut self.writer else {
            let Some(file) = self.file.take() else {
                return Err(self.failed(io::Error::other("begun twice").into()));
            };
            let writer = LogWriter::new(file, self.recipe, self.kind, frame);
            self.writer = Some(writer.map_err(|error| self.failed(error))?);
            return Ok(());
        };
        // a killed process loses at most a second of the run
        let is_second = frame.tick.is_multiple_of(SECOND);
        let written = writer.tick(frame).and_then(|()| if is_second { writer.flush() } else { Ok(()) });
        written.map_err(|error| self.failed(error))?;
        if is_second {
            self.taken = frame.tick;
        }
        Ok(())
    }

    fn digest(&self) -> Digest {
        self.writer.as_ref().map_or(Digest(0), LogWriter::digest)
    }
}

/// Runs a recipe and writes its log to its target.
///
/// Where the run stops early or the disk takes no more, what was done is kept in the file that [`partial_name`] names,
/// unless all of it is in `expected` already.
pub fn write_run(
    recipe: &Recipe,
    kind: LogKind,
    expected: Option<&Log>,
    stop: StopRule,
    target: &Target,
) -> Result<Ended, Failure> {
    write_run_watched(recipe, kind, expected, stop, target, |_| {})
}

/// As [`write_run`], and calls `see` with every frame, that of tick 0 first.
pub fn write_run_watched(
    recipe: &Recipe,
    kind: LogKind,
    expected: Option<&Log>,
    stop: StopRule,
    target: &Target,
    see: impl FnMut(&Frame),
) -> Result<Ended, Failure> {
    let (output, file) = (target.path(), ReportedFile::create(target)?);
    file.keep_when_abandoned(&partial_name(output));
    let mut writing = Writing { recipe, kind, output, file: Some(file), writer: None, taken: 0, see };
    let ended = run_into(recipe, expected, stop, &mut writing);
    let Some(mut writer) = writing.writer.take() else { return ended };
    let before = expected.map_or(0, Log::ticks);
    let finished = match &ended {
        Ok(Ended::Whole { .. }) => writer.end().map(|()| Some(output.to_owned())),
        Ok(Ended::Stopped(tick)) if *tick > before || before == 0 => writer.stop().map(|()| Some(partial_name(output))),
        _ => Ok(None),
    };
    let mut file = writer.into_inner();
    let finished = finished.and_then(|name| match name {
        Some(name) => file.sync().map(|()| Some(name)).map_err(LogError::from),
        None => Ok(None),
    });
    let finished = finished.map_err(|error| writing.failed(error));
    match (ended, finished) {
        (Ok(ended @ Ended::Whole { .. }), Ok(_)) => file.commit().map(|()| ended),
        (Ok(ended), Ok(Some(name))) => file.keep_as(&name).map(|()| ended),
        (Err(failure @ Failure::Output { .. }), _) | (Ok(_), Err(failure)) if writing.taken > before => {
            Err(with_partial_output(file, output, failure))
        }
        (Ok(_), Err(failure)) => Err(failure),
        (ended, _) => ended,
    }
}

/// The failure of a write, after what the disk took before was kept.
fn with_partial_output(file: ReportedFile, output: &Path, failure: Failure) -> Failure {
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
    recipe: &Recipe,
    kind: LogKind,
    expected: Option<&Log>,
    target: Option<&Target>,
    stop: StopRule,
    form: Printed,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    let ended = match target {
        Some(target) => write_run(recipe, kind, expected, stop, target)?,
        None => run(recipe, stop, |_| {})?,
    };
    match ended {
        Ended::Whole { last, digest, refusals } => {
            let summary = RunSummary::new(recipe, &last, digest);
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
        Ended::Stopped(tick) if expected.is_some_and(|log| tick <= log.ticks() && log.ticks() > 0) => {
            say(format!("stopped after tick {tick}, before the end of the existing recording, which is unchanged"));
            Ok(Outcome::Stopped)
        }
        Ended::Stopped(tick) => {
            let ticks = recipe.config.ticks;
            match target.map(|target| partial_name(target.path())) {
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
