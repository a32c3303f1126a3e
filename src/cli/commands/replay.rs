//! `replay`: simulate a recorded run again, to its end.

use crate::cli::support::choices::log_kind;
use std::path::PathBuf;

use clap::Args;
use motion_lab_sim::run::{Comparison, Frame, Log, LogError, LogKind, LogWriter};
use serde::Serialize;

use crate::cli::support::interrupt;
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::support::output::ReportedFile;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::begin;
use crate::cli::support::summary::RunSummary;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Simulate a recorded run again, from its seed and script alone and to its last tick, print where its robots end, and
/// say how many of the recorded ticks it equals to the last bit.
///
/// Unlike `verify` it does not stop where the recording ends: with -o the whole replayed run is kept, for
/// `diff` to compare; of a digest log, `--log full` makes the frames. The exit code is 4 when a recorded tick differs,
/// else 5 when the recording is damaged or unfinished.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab replay run.mcap
  motion-lab replay cut.mcap -o whole.mcap
  motion-lab replay digests.mcap --log full -o full.mcap")]
pub struct ReplayArgs {
    /// The log; `-` is standard input.
    file: PathBuf,
    /// Write the replayed run's log to this file.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What that log keeps: `full`, every frame, or `digest`, a digest of each second. [default: as FILE does]
    #[arg(long, value_name = "KIND", value_parser = log_kind(), requires = "output", hide_possible_values = true)]
    log: Option<LogKind>,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
    /// Configurations as Rust prints them.
    #[arg(long)]
    debug: bool,
}

#[derive(Serialize)]
struct Replayed<'a> {
    #[serde(flatten)]
    run: RunSummary<'a>,
    /// The number of recorded ticks.
    sealed: u64,
    /// The number of them that the replay equals, from the first on.
    identical: u64,
    divergence: Option<String>,
}

impl ReplayArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { log, damage, .. } = read_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is compared; the run is replayed to its end."));
        }
        let target = self.output.as_deref().map(Target::log).transpose()?;
        interrupt::listen();
        let Some((last, comparison)) = self.replay(&log, target.as_ref())? else {
            say("stopped; nothing was written. Replay it again.");
            return Ok(Outcome::Stopped);
        };
        let replayed = Replayed {
            run: RunSummary::new(&log.recipe, &last, comparison.digest()),
            sealed: log.ticks(),
            identical: comparison.identical(),
            divergence: comparison.difference().map(ToString::to_string),
        };
        if self.json {
            data.json(&replayed)?;
        } else {
            replayed.print(self.debug, data)?;
        }
        if let Some(target) = target {
            target.wrote();
        }
        Ok(match (replayed.divergence, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }

    /// Runs the log's run to its end, and returns the last frame; `None` when somebody asked to stop.
    fn replay<'a>(
        &self,
        log: &'a Log,
        target: Option<&Target>,
    ) -> Result<Option<(Frame, Comparison<&'a Log>)>, Failure> {
        let mut run = begin(&log.recipe)?;
        let mut comparison = Comparison::begin(log, run.frame());
        let mut writer = self.writer(log, target, run.frame())?;
        let progress = CommandProgress::of(log.recipe.config.ticks, "ticks");
        while !run.is_complete() {
            if interrupt::asked_to_stop() {
                return Ok(None);
            }
            let frame = run.step();
            comparison.tick(frame);
            if let Some(writer) = &mut writer {
                writer.tick(frame).map_err(|error| self.failed(error))?;
            }
            progress.at(frame.tick);
        }
        if let Some(writer) = writer {
            writer.finish().map_err(|error| self.failed(error))?.commit()?;
        }
        Ok(Some((run.frame().clone(), comparison)))
    }

    fn writer(
        &self,
        log: &Log,
        target: Option<&Target>,
        initial: &Frame,
    ) -> Result<Option<LogWriter<ReportedFile>>, Failure> {
        let Some(target) = target else { return Ok(None) };
        let (file, kind) = (ReportedFile::create(target)?, self.log.unwrap_or(log.kind()));
        LogWriter::new(file, &log.recipe, kind, initial).map(Some).map_err(|error| self.failed(error))
    }

    fn failed(&self, error: LogError) -> Failure {
        match (error, &self.output) {
            (LogError::Io(error), Some(output)) => Failure::output(output, &error),
            (error, _) => Failure::internal(error),
        }
    }
}

impl Replayed<'_> {
    fn print(&self, debug: bool, data: &mut Data) -> Result<(), Failure> {
        let Replayed { run, sealed, identical, divergence } = self;
        run.print_robots(debug, data)?;
        data.line(format!("digest {}", run.digest))?;
        if let Some(divergence) = divergence {
            data.line(divergence)?;
        }
        if *sealed == run.ticks {
            data.line(format!("{identical} of {sealed} ticks bit-identical"))
        } else {
            data.line(format!("{identical} of {sealed} sealed ticks bit-identical; the run has {}", run.ticks))
        }
    }
}
