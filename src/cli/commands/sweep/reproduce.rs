//! `sweep reproduce`: a row's run once more, with its full log.

use std::io::BufReader;
use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab::batch::{PartError, PartReader, RowValue, RunRow, Study, TableError, TableFile};
use motion_lab::run::LogKind;

use super::merge;
use super::one::{log_name, remove_partial};
use super::planned::{PlannedInputs, made};
use crate::cli::commands::record::{Ended, StopRule, write_run};
use crate::cli::support::input::open;
use crate::cli::support::interrupt;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Run a row of a sweep once more, write its full log, and compare its digest with the row's.
///
/// The table (.parquet) or a part holds the study and all it names, so nothing else is needed.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab sweep reproduce noise.parquet --row 4711
  motion-lab sweep reproduce runs/noise/part-3-of-8.sweep --row 12 -o twelve.mcap")]
pub struct Reproduce {
    /// The table, or a part.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The number of the row, from 0.
    #[arg(long)]
    row: u64,
    /// The log to write. [default: ROW.mcap]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The study and a row of a table or a part.
fn find(file: &Path, number: u64) -> Result<(Study, RunRow), Failure> {
    let no_row = |error: TableError| {
        let next = match &error {
            TableError::NoRow { .. } => "Give the number of a row that is there.",
            _ => "Name a table that `sweep merge` wrote.",
        };
        Failure::input(format!("{}: {error}", file.display()), next)
    };
    match file.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => {
            let table = TableFile::open(open(file)?).map_err(no_row)?;
            let row = table.row(number).map_err(no_row)?;
            Ok((table.study().clone(), row))
        }
        Some("csv") => Err(Failure::input(
            format!("{}: a table of comma-separated values does not hold its study", file.display()),
            "Name the table that ends in .parquet, or a part.",
        )),
        _ => {
            let refused = |error: PartError| merge::refused(file, &error);
            let mut reader = PartReader::new(BufReader::new(open(file)?)).map_err(refused)?;
            // to the end, where the seal proves every row
            let mut found = None;
            while let Some((row, _)) = reader.row().map_err(refused)? {
                found = found.or((row.row == number).then_some(row));
            }
            if let Some(row) = found {
                return Ok((reader.study().clone(), row));
            }
            Err(Failure::input(
                format!("{}: it has rows {:?} and no row {number}", file.display(), reader.head().rows),
                "Name the part with this row.",
            ))
        }
    }
}

impl Reproduce {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        interrupt::listen();
        let (study, row) = find(&self.file, self.row)?;
        let columns = study.columns();
        let Some(RowValue::Text(expected)) = row.cell(columns, "digest").cloned() else {
            let Some(RowValue::Text(reason)) = row.cell(columns, "failure") else {
                return Err(Failure::input(
                    format!("{}: row {} has no digest", self.file.display(), self.row),
                    "Name a table that `sweep merge` wrote.",
                ));
            };
            data.line(format!("row {} could not be run, and there is no log: {reason}", self.row))?;
            return Ok(Outcome::Done);
        };
        let cannot = |reason: String| {
            Failure::input(
                format!("{}: row {} can't be run: {reason}", self.file.display(), self.row),
                "Use the version of motion-lab that made it.",
            )
        };
        let stopped = || {
            say("stopped; nothing is kept, start again");
            Outcome::Stopped
        };
        let run = match made(study.setup(self.row).map_err(cannot)?) {
            PlannedInputs::Run(run, _) => run,
            PlannedInputs::None(reason, _) => return Err(cannot(reason)),
            PlannedInputs::Stopped => return Ok(stopped()),
        };
        let output = self.output.unwrap_or_else(|| log_name(Path::new(""), self.row));
        let target = Target::log(&output)?;
        let Ended::Whole { digest, .. } = write_run(&run, LogKind::Frames, None, StopRule::default(), &target)? else {
            remove_partial(&output);
            return Ok(stopped());
        };
        target.wrote();
        if digest.to_string() == expected {
            data.line(format!("row {} is reproduced: digest {digest}", self.row))?;
            return Ok(Outcome::Done);
        }
        data.line(format!("row {} differs: digest {digest}, expected {expected}", self.row))?;
        Ok(Outcome::Differs)
    }
}
