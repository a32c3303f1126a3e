//! `export`: a log in the forms that other programs read.

mod sink;
mod stills;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab::export::{ExportError, write_csv, write_foxglove_of_file, write_jsonl, write_rerun_of_file};
use motion_lab::run::Log;

use crate::cli::support::input::read_bytes;
use crate::cli::support::log_source::{LogSource, MAX_LOG, read_log};
use crate::cli::support::output::PendingFile;
use crate::cli::support::simulate::not_shown;
use crate::cli::{Data, Failure, Outcome, say};
use sink::Sink;
use stills::StillArgs;

/// Write a log in a form that other programs read.
///
/// Every number is written with the fewest digits that read back to the same bits. An infinite range (nothing within
/// reach) is `inf` in CSV and the text "inf" in JSON, which has no infinity; -0.0 keeps its sign. Of a damaged or
/// unfinished file the sealed beginning is written, and the exit code is 5.
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
    /// CSV: a column for each ray of the range sensors as well.
    #[arg(long)]
    ranges: bool,
    #[command(flatten)]
    stills: StillArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A line of JSON for each tick, tick 0 first, with all that a frame holds.
    Jsonl,
    /// A row for each tick and robot.
    Csv,
    /// The run's figure: traces, ends and contacts in its worlds.
    Svg,
    /// The same, painted. Seed, digest and tick are in the file's notes.
    Png,
    /// The run as it goes: the same figure at tick after tick.
    Gif,
    /// An MCAP file for Foxglove and Lichtblick: the log's own channels, and transforms, scans, scenes and log messages
    /// by Foxglove's schemas. It is not a log that `verify` reads.
    Foxglove,
    /// The same for Rerun, which draws clouds of points: worlds, robots, paths and scans are clouds.
    Rerun,
}

impl Export {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if self.ranges && self.format != Format::Csv {
            return Err(Failure::usage(
                "--ranges is only valid with --format csv",
                "Leave it out: jsonl, foxglove and rerun always hold them.",
            ));
        }
        if matches!(self.format, Format::Foxglove | Format::Rerun | Format::Png | Format::Gif) && self.output.is_none()
        {
            return Err(Failure::usage("this form is not for standard output", "Name a file: -o FILE."));
        }
        let LogSource { read, damage } = read_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is exported; `motion-lab record --resume` makes it whole."));
        }
        let (file, log) = (&self.file, &read.log);
        match (self.format, &self.output) {
            (Format::Foxglove | Format::Rerun, Some(output)) => self.viewer(log, output)?,
            (Format::Png, Some(output)) => stills::png(&self.stills, file, log, output)?,
            (Format::Gif, Some(output)) => stills::gif(&self.stills, file, log, output)?,
            (format, output) => {
                let mut sink = Sink::new(output.as_deref(), data)?;
                match format {
                    Format::Jsonl => sink.take(|out| write_jsonl(log, out))?,
                    Format::Csv => sink.take(|out| write_csv(log, self.ranges, out))?,
                    _ => {
                        let tick = self.stills.tick.unwrap_or(log.frames.len() as u64);
                        sink.text(&stills::svg_at(file, log, tick)?)?;
                    }
                }
                sink.finish()?;
            }
        }
        if let Some(output) = &self.output {
            say(format!("wrote {}", output.display()));
        }
        Ok(if damage.is_some() { Outcome::Recovered } else { Outcome::Done })
    }

    /// Writes the log for a viewer.
    fn viewer(&self, log: &Log, output: &Path) -> Result<(), Failure> {
        let bytes = read_bytes(&self.file, MAX_LOG)?;
        let mut pending = PendingFile::create(output)?;
        let written = match self.format {
            Format::Rerun => write_rerun_of_file(&bytes, log, &mut pending, |_| {}),
            _ => write_foxglove_of_file(&bytes, log, &mut pending, |_| {}),
        };
        written.map_err(|error| match error {
            ExportError::Write(error) => Failure::output(output, &error),
            ExportError::Run(error) => not_shown(&self.file, &error),
            error => Failure::internal(error),
        })?;
        pending.commit()
    }
}
