//! `replay`: simulate a recorded run again, to its end.

use std::path::PathBuf;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use motion_lab::run::{Comparison, Digest, Divergence, Frame, Log, LogError, LogWriter, RunDigest};
use serde::Serialize;

use crate::cli::support::interrupt;
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::support::output::PendingFile;
use crate::cli::support::simulate::begin;
use crate::cli::support::summary::RunSummary;
use crate::cli::{Data, Failure, Outcome, say};

/// Simulate a recorded run again, from its seed and script alone and to its last tick, print where its robots end, and
/// say how many of the recorded ticks it equals to the last bit.
///
/// Unlike `verify` it does not stop where the recording ends: with -o the whole replayed run is kept, for
/// `diff` to compare. The exit code is 4 when a recorded tick differs, else 5 when the recording is damaged or
/// unfinished.
#[derive(Debug, Args)]
pub struct Replay {
    /// The log.
    file: PathBuf,
    /// Write the replayed run's log to this file.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
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

impl Replay {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { read, damage } = read_log(&self.file)?;
        let log = read.log;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is compared; the run is replayed to its end."));
        }
        interrupt::listen()?;
        let Some(Ended { last, digest, comparison }) = self.replay(&log)? else {
            say("stopped; nothing was written. Replay it again.");
            return Ok(Outcome::Stopped);
        };
        let divergence = comparison.divergence();
        let replayed = Replayed {
            run: RunSummary::new(log.seed, &log.config, &last, digest),
            sealed: comparison.recorded(),
            identical: comparison.identical(),
            divergence: divergence.map(Divergence::to_string),
        };
        if self.json {
            data.json(&replayed)?;
        } else {
            replayed.print(data)?;
        }
        if let Some(output) = &self.output {
            say(format!("wrote {}", output.display()));
        }
        Ok(match (divergence, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }

    /// Runs the log's run to its end; `None` when somebody asked to stop.
    fn replay<'a>(&self, log: &'a Log) -> Result<Option<Ended<'a>>, Failure> {
        let mut run = begin(log.seed, &log.config, &log.script)?;
        let mut digest = RunDigest::new(log.seed, &log.config, &log.script, run.frame());
        let mut comparison = Comparison::with(log);
        comparison.frame(run.frame());
        let mut writer = self.writer(log, run.frame())?;
        let bar = progress(log.config.ticks);
        while !run.is_complete() {
            if interrupt::asked_to_stop() {
                return Ok(None);
            }
            let frame = run.step();
            comparison.frame(frame);
            digest.tick(frame);
            if let Some(writer) = &mut writer {
                writer.tick(frame).map_err(|error| self.failed(error))?;
            }
            bar.set_position(frame.tick);
        }
        bar.finish_and_clear();
        if let Some(writer) = writer {
            writer.finish().map_err(|error| self.failed(error))?.commit()?;
        }
        Ok(Some(Ended { last: run.frame().clone(), digest: digest.digest(), comparison }))
    }

    fn writer(&self, log: &Log, initial: &Frame) -> Result<Option<LogWriter<PendingFile>>, Failure> {
        let Some(output) = &self.output else { return Ok(None) };
        let file = PendingFile::create(output)?;
        let writer = LogWriter::new(file, log.seed, &log.config, &log.script, initial);
        writer.map(Some).map_err(|error| self.failed(error))
    }

    fn failed(&self, error: LogError) -> Failure {
        match (error, &self.output) {
            (LogError::Io(error), Some(output)) => Failure::output(output, &error),
            (error, _) => Failure::internal(error),
        }
    }
}

/// The outcome of a replay.
struct Ended<'a> {
    last: Frame,
    digest: Digest,
    comparison: Comparison<'a>,
}

/// A progress bar on standard error; none where that is no terminal.
fn progress(ticks: u64) -> ProgressBar {
    let bar = ProgressBar::new(ticks);
    match ProgressStyle::with_template("{bar:40} tick {pos} of {len}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

impl Replayed<'_> {
    fn print(&self, data: &mut Data) -> Result<(), Failure> {
        let Replayed { run, sealed, identical, divergence } = self;
        run.print_robots(data)?;
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
