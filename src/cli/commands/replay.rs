//! `replay`: simulate a recorded run again, to its end.

use std::path::PathBuf;

use clap::Args;
use motion_lab::run::{Digest, Frame, LogError, RunDigest};
use serde::Serialize;

use crate::cli::support::interrupt;
use crate::cli::support::log_kind::{AnyComparison, AnyLog, AnyWriter, LogKind};
use crate::cli::support::log_source::{AnySource, read_any_log};
use crate::cli::support::output::PendingFile;
use crate::cli::support::progress::Progress;
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
pub struct Replay {
    /// The log; `-` is standard input.
    file: PathBuf,
    /// Write the replayed run's log to this file.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What that log keeps: `full`, every frame, or `digest`, a digest of each second. [default: as FILE does]
    #[arg(long, value_name = "KIND", value_enum, requires = "output", hide_possible_values = true)]
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

impl Replay {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let AnySource { log, damage, .. } = read_any_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is compared; the run is replayed to its end."));
        }
        let target = self.output.as_deref().map(Target::file).transpose()?;
        interrupt::listen()?;
        let Some(Ended { last, digest, comparison }) = self.replay(&log)? else {
            say("stopped; nothing was written. Replay it again.");
            return Ok(Outcome::Stopped);
        };
        let (seed, config, _) = log.parts();
        let replayed = Replayed {
            run: RunSummary::new(seed, config, &last, digest),
            sealed: comparison.recorded(),
            identical: comparison.identical(),
            divergence: comparison.difference(config),
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

    /// Runs the log's run to its end; `None` when somebody asked to stop.
    fn replay<'a>(&self, log: &'a AnyLog) -> Result<Option<Ended<'a>>, Failure> {
        let (seed, config, script) = log.parts();
        let mut run = begin(seed, config, script)?;
        let mut digest = RunDigest::new(seed, config, script, run.frame());
        let mut comparison = AnyComparison::with(log);
        comparison.frame(run.frame(), &digest);
        let mut writer = self.writer(log, run.frame(), &digest)?;
        let progress = Progress::of(config.ticks, "ticks");
        while !run.is_complete() {
            if interrupt::asked_to_stop() {
                return Ok(None);
            }
            let frame = run.step();
            digest.tick(frame);
            comparison.frame(frame, &digest);
            if let Some(writer) = &mut writer {
                writer.tick(frame, &digest).map_err(|error| self.failed(error))?;
            }
            progress.at(frame.tick);
        }
        let digest = digest.digest();
        if let Some(mut writer) = writer {
            writer.end(digest).map_err(|error| self.failed(error))?;
            writer.into_inner().commit()?;
        }
        Ok(Some(Ended { last: run.frame().clone(), digest, comparison }))
    }

    fn writer(
        &self,
        log: &AnyLog,
        initial: &Frame,
        run: &RunDigest,
    ) -> Result<Option<AnyWriter<PendingFile>>, Failure> {
        let Some(output) = &self.output else { return Ok(None) };
        let file = PendingFile::create(output)?;
        let writer = AnyWriter::new(file, self.log.unwrap_or(log.kind()), log.parts(), initial, run);
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
    comparison: AnyComparison<'a>,
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
