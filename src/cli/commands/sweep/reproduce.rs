//! `sweep reproduce`: a row's run once more, with its full log.

use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::batch::{Column, PartError, PartReader, RowValue, RunRow, Study, TableError, TableFile};
use clap::Args;

use super::merge;
use super::one::{again, log_name};
use super::verify;
use crate::cli::support::input::open;
use crate::cli::support::interrupt;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Run a row of a sweep once more, write its full log, and compare every cell of the row with what the run gives.
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
    let refused = |error: TableError| verify::refused(file, &error);
    match file.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => {
            let table = TableFile::open(open(file)?).map_err(refused)?;
            let study = table.study().clone();
            Ok((study, table.row(number).map_err(refused)?))
        }
        Some("csv") => Err(verify::has_no_study(file)),
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

/// The columns in which two rows differ, each with what is there and what the run gives.
fn differences(columns: &[Column], found: &RunRow, again: &RunRow) -> Vec<String> {
    let text = |row: &RunRow, i: usize| row.cells.get(i).map_or_else(String::new, RowValue::to_text);
    let named = |(i, column): (usize, &Column)| {
        let [found, again] = [text(found, i), text(again, i)];
        let shown = |text: String| if text.is_empty() { "nothing".to_owned() } else { text };
        (found != again).then(|| format!("{} {}, expected {}", column.name, shown(again), shown(found)))
    };
    columns.iter().enumerate().filter_map(named).collect()
}

impl Reproduce {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        interrupt::listen();
        let (study, row) = find(&self.file, self.row)?;
        let columns = study.columns();
        let output = self.output.unwrap_or_else(|| log_name(Path::new(""), self.row));
        let target = Target::log(&output)?;
        let Some(again) = again(&study, self.row, &target)? else {
            say("stopped; nothing is kept, start again");
            return Ok(Outcome::Stopped);
        };
        let digest = match again.cell(columns, "digest") {
            Some(RowValue::Text(digest)) => Some(digest),
            _ => None,
        };
        if digest.is_some() {
            target.wrote();
        }
        let differences = differences(columns, &row, &again);
        if !differences.is_empty() {
            data.line(format!("row {} differs: {}", self.row, differences.join("; ")))?;
            return Ok(Outcome::Differs);
        }
        match (digest, again.cell(columns, "failure")) {
            (Some(digest), _) => data.line(format!("row {} is reproduced: digest {digest}", self.row))?,
            (None, Some(RowValue::Text(reason))) => {
                data.line(format!("row {} could not be run, and there is no log: {reason}", self.row))?;
            }
            (None, _) => {
                data.line(format!("row {} is reproduced: no run plays its path, and there is no log", self.row))?
            }
        }
        Ok(Outcome::Done)
    }
}
