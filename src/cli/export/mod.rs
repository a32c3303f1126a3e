//! `export`: a log in the forms that other programs read.

mod csv;
mod foxglove;
mod jsonl;
mod sink;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab::run::{Frame, Log};

use super::figure::RunFigure;
use super::log_source::{LogSource, read_log};
use super::simulate::show;
use super::{Data, Failure, Outcome, say};
use sink::Sink;

/// Write a log in a form that other programs read.
///
/// Every number is written with the fewest digits that read back to the same bits. An infinite range (nothing within reach) is
/// `inf` in CSV and the text "inf" in JSON, which has no infinity; -0.0 keeps its sign. Of a damaged or unfinished file the sealed
/// beginning is written, and the exit code is 5.
#[derive(Debug, Args)]
pub struct Export {
    /// The log.
    file: PathBuf,
    /// The form.
    #[arg(long)]
    format: Format,
    /// Write to this file; standard output when there is none.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// CSV: a column for each ray of the range sensor as well.
    #[arg(long)]
    ranges: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A line of JSON for each tick, tick 0 first, with all that a frame holds.
    Jsonl,
    /// A row for each tick and robot.
    Csv,
    /// The run's figure: traces, ends and contacts in its worlds.
    Svg,
    /// An MCAP file for Foxglove, Lichtblick and Rerun: the log's own channels, and transforms, scans, scenes and log messages
    /// by Foxglove's schemas. It is not a log that `verify` reads.
    Foxglove,
}

impl Export {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if self.ranges && self.format != Format::Csv {
            return Err(Failure::usage("--ranges goes with --format csv alone", "Leave it out: the others have them."));
        }
        if self.format == Format::Foxglove && self.output.is_none() {
            return Err(Failure::usage("an MCAP file is not for standard output", "Name it: -o FILE."));
        }
        let LogSource { read, damage } = read_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is exported; `motion-lab record --resume` makes it whole."));
        }
        if let (Format::Foxglove, Some(output)) = (self.format, &self.output) {
            foxglove::write(&self.file, &read.log, output)?;
        } else {
            let mut sink = Sink::new(self.output.as_deref(), data)?;
            match self.format {
                Format::Jsonl => jsonl::write(&read.log, &mut sink)?,
                Format::Csv => csv::write(&read.log, self.ranges, &mut sink)?,
                Format::Svg | Format::Foxglove => svg(&self.file, &read.log, &mut sink)?,
            }
            sink.finish()?;
        }
        if let Some(output) = &self.output {
            say(format!("wrote {}", output.display()));
        }
        Ok(if damage.is_some() { Outcome::Recovered } else { Outcome::Done })
    }
}

/// The run's figure, as its frames say it went.
fn svg(file: &Path, log: &Log, sink: &mut Sink) -> Result<(), Failure> {
    let mut figure = RunFigure::default();
    show(file, log, |run, _| {
        figure.watch(run.view());
        Ok(())
    })?;
    sink.text(&figure.svg(log.seed, &log.config, log.frames.len() as u64, log.digest()))
}

/// A log's frames from tick 0 on.
fn frames(log: &Log) -> impl Iterator<Item = &Frame> {
    std::iter::once(&log.initial).chain(&log.frames)
}
