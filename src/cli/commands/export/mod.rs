//! `export`: a log in the forms that other programs read.

mod page;
mod sink;
mod stills;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab_sim::export::{ExportError, write_csv, write_foxglove_of_file, write_jsonl, write_rerun_of_file};
use motion_lab_sim::run::Log;

use crate::cli::support::input::{is_dash, read_bytes};
use crate::cli::support::log_source::{LogSource, MAX_LOG, read_full_log, read_log, say_damage};
use crate::cli::support::output::{ReportedFile, write_file};
use crate::cli::support::progress::{CommandProgress, CountedWriter};
use crate::cli::support::simulate::not_shown;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome};
use page::PageArgs;
use sink::ExportSink;
use stills::StillArgs;

/// Write a log in a form that other programs read.
///
/// Every number is written with the fewest digits that read back to the same bits. An infinite range (nothing within
/// reach) is `inf` in CSV and the text "inf" in JSON, which has no infinity; -0.0 keeps its sign. Of a damaged or
/// unfinished file the sealed beginning is written, and the exit code is 5.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab export run.mcap -o run.csv
  motion-lab export run.mcap --tick 300 --theme dark --names -o run.png
  motion-lab export run.mcap --format gif --every 10 -o - > run.gif
  motion-lab export run.mcap -o run.html
  motion-lab export run.mcap --format jsonl | head -1")]
pub struct Export {
    /// The log, or a page that holds one; `-` is standard input.
    file: PathBuf,
    /// The form. [default: by the output's name: .jsonl, .csv, .svg, .png, .gif, .html; .mcap is foxglove]
    #[arg(long)]
    format: Option<ExportFormat>,
    /// Write to this file; `-`, or none, is standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// CSV: a column for each ray of the range sensors as well.
    #[arg(long)]
    ranges: bool,
    #[command(flatten)]
    stills: StillArgs,
    #[command(flatten)]
    page: PageArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ExportFormat {
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
    /// A page that any browser opens without a network. It holds the run and the simulator, simulates the run again,
    /// says whether every second comes out the same, and plays it. The lab opens it, and whatever reads a log reads it.
    /// Logs of digests have this form, too.
    Html,
    /// An MCAP file for Foxglove and Lichtblick: the log's own channels, and transforms, scans, scenes and log messages
    /// by Foxglove's schemas. It is not a log that `verify` reads.
    Foxglove,
    /// The same for Rerun, which draws clouds of points: worlds, robots, paths and scans are clouds.
    Rerun,
}

impl ExportFormat {
    /// The form that a file's name tells.
    fn by_name(path: &Path) -> Option<ExportFormat> {
        Some(match path.extension()?.to_str()? {
            "jsonl" => ExportFormat::Jsonl,
            "csv" => ExportFormat::Csv,
            "svg" => ExportFormat::Svg,
            "png" => ExportFormat::Png,
            "gif" => ExportFormat::Gif,
            "html" | "htm" => ExportFormat::Html,
            "mcap" => ExportFormat::Foxglove,
            _ => return None,
        })
    }
}

impl Export {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let output = self.output.as_deref().filter(|path| !is_dash(path));
        let Some(format) = self.format.or_else(|| ExportFormat::by_name(output?)) else {
            return Err(match output {
                Some(path) => Failure::usage(
                    format!("{}: its name does not tell the form", path.display()),
                    "Say it with --format: jsonl, csv, svg, png, gif, html, foxglove or rerun.",
                ),
                None => Failure::usage("no form is named", "Name a file with -o FILE, or say the form with --format."),
            });
        };
        if self.ranges && format != ExportFormat::Csv {
            return Err(Failure::usage(
                "--ranges is only valid with --format csv",
                "Leave it out: jsonl, foxglove and rerun always hold them.",
            ));
        }
        if self.page.template.is_some() && format != ExportFormat::Html {
            return Err(Failure::usage("--template is only valid with --format html", "Leave it out."));
        }
        if matches!(format, ExportFormat::Foxglove | ExportFormat::Rerun) && output.is_none() {
            return Err(Failure::usage("this form is not for standard output", "Name a file: -o FILE."));
        }
        let read = if format == ExportFormat::Html { read_log } else { read_full_log };
        let source = read(&self.file)?;
        let LogSource { log, damage, .. } = &source;
        say_damage(damage.as_ref(), "exported");
        let file = &self.file;
        let target = Target::of(output.unwrap_or(Path::new("-")))?;
        match (format, output) {
            (ExportFormat::Foxglove | ExportFormat::Rerun, _) => viewer(format, file, log, &target)?,
            (ExportFormat::Png, _) => stills::png(&self.stills, file, log, &target)?,
            (ExportFormat::Gif, _) => stills::gif(&self.stills, file, log, &target)?,
            (ExportFormat::Html, _) => match page::page(&self.page, file, log)? {
                Some(page) => write_file(&target, page.as_bytes())?,
                None => return Ok(Outcome::Differs),
            },
            (format, output) => {
                let is_terminal = data.is_terminal();
                let mut sink = ExportSink::new(output.map(|_| &target), data)?;
                // a terminal that shows the lines needs no bar among them
                let is_shown = output.is_none() && is_terminal;
                let progress =
                    |lines| if is_shown { CommandProgress::none() } else { CommandProgress::of(lines, "lines") };
                let ticks = log.ticks() + 1;
                match format {
                    ExportFormat::Jsonl => {
                        let progress = progress(ticks);
                        sink.take(|out| write_jsonl(log, CountedWriter(out, &progress)))?;
                    }
                    ExportFormat::Csv => {
                        let progress = progress(ticks * log.recipe.config.robot_names().count() as u64);
                        sink.take(|out| write_csv(log, self.ranges, CountedWriter(out, &progress)))?;
                    }
                    _ => {
                        let tick = self.stills.tick.unwrap_or(log.ticks());
                        sink.text(&stills::svg_at(&self.stills, file, log, tick)?)?;
                    }
                }
                sink.finish()?;
            }
        }
        if output.is_some() || matches!(format, ExportFormat::Png | ExportFormat::Gif | ExportFormat::Html) {
            target.finish(data)?;
        }
        Ok(if damage.is_some() { Outcome::Recovered } else { Outcome::Done })
    }
}

/// Writes the log that was read from `file` for a viewer.
fn viewer(format: ExportFormat, file: &Path, log: &Log, target: &Target) -> Result<(), Failure> {
    let output = target.path();
    let bytes = read_bytes(file, MAX_LOG)?;
    let mut pending = ReportedFile::create(target)?;
    let progress = CommandProgress::of(2 * (log.ticks() + 1), "steps, two a frame");
    let written = match format {
        ExportFormat::Rerun => write_rerun_of_file(&bytes, log, &mut pending, |_| {}, || progress.step()),
        _ => write_foxglove_of_file(&bytes, log, &mut pending, |_| {}, || progress.step()),
    };
    written.map_err(|error| match error {
        ExportError::Write(error) => Failure::output(output, &error),
        ExportError::Run(error) => not_shown(file, &error),
        error => Failure::internal(error),
    })?;
    pending.commit()
}
