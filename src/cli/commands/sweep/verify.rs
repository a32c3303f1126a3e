//! `sweep verify`: whether tables and parts are as they were written, to the last bit of every value.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use crate::batch::{PartReader, TableError, TableFile, VerifiedTable};
use clap::Args;

use super::merge;
use crate::cli::support::input::{open, shown, title, unreadable, worst_of_each};
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Prove that tables and parts are as they were written: the seal of each is that of its rows, in their order.
///
/// A seal is a hash of every value of every row, of the study and of the columns. `sweep report` and `sweep reproduce`
/// compare it, too, before they say anything; the tables of `plan --compare` have one. A table of comma-separated
/// values has no room for a seal: --csv compares it, line by line, with the Parquet table of the same merge. Whoever
/// changes a table can seal it again; `sweep reproduce` settles a row.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab sweep verify noise.parquet
  motion-lab sweep verify noise.parquet --csv noise.csv
  motion-lab sweep verify runs/noise/*.sweep")]
pub struct VerifyTables {
    /// Tables (.parquet), or parts.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The table of comma-separated values that was written beside the table.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// The failure of a table that can't be read, or that is not as it was written.
pub fn refused(file: &Path, error: &TableError) -> Failure {
    let next = match error {
        TableError::NoRow { .. } => "Give the number of a row that is there.",
        TableError::NoSweep(_) => "Name a table that ends in .parquet and that `sweep merge` wrote.",
        TableError::Study(_) => "Use the version of motion-lab that wrote it.",
        _ => "Write it again with `sweep merge`, from its parts, which have seals of their own.",
    };
    Failure::input(format!("{}: {error}", file.display()), next)
}

/// The failure of a table of comma-separated values where a table with its study is needed.
pub fn has_no_study(csv: &Path) -> Failure {
    Failure::input(
        format!("{}: a table of comma-separated values does not hold its study or a seal", csv.display()),
        "Name the table that ends in .parquet; `sweep merge` writes both, and `sweep verify TABLE --csv FILE` compares \
         them.",
    )
}

impl VerifyTables {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if let Some(csv) = &self.csv {
            let [table] = &self.files[..] else {
                return Err(Failure::usage("--csv goes with one table", "Name the table of the same merge alone."));
            };
            return compare(table, csv, data);
        }
        let several = self.files.len() > 1;
        worst_of_each(&self.files, data, |file, data| {
            title(file, several, data)?;
            verify(file, data)
        })
    }
}

fn verify(file: &Path, data: &mut Data) -> Result<Outcome, Failure> {
    if file.extension().is_some_and(|ending| ending == "csv") {
        return Err(has_no_study(file));
    }
    if file.extension().is_some_and(|ending| ending == "parquet") {
        let VerifiedTable { rows, seal } = VerifiedTable::of(open(file)?).map_err(|error| refused(file, &error))?;
        data.line(format!("{}, as they were sealed: {seal}", counted(rows, "row")))?;
        return Ok(Outcome::Done);
    }
    let part = PartReader::new(BufReader::new(open(file)?)).and_then(PartReader::prove);
    let rows = part.map_err(|error| merge::refused(file, &error))?;
    data.line(format!("{}, as they were sealed", counted(rows, "row")))?;
    Ok(Outcome::Done)
}

/// Compares the lines of a table of comma-separated values with the rows of the table beside it.
fn compare(file: &Path, csv: &Path, data: &mut Data) -> Result<Outcome, Failure> {
    let table = TableFile::open(open(file)?).map_err(|error| refused(file, &error))?;
    let mut lines = CsvLines { input: BufReader::new(open(csv)?), number: 0, differs: None, failed: None };
    lines.compare(&table.study().table_heading());
    let rows = table.each(|row| lines.compare(&row.to_table_line())).map_err(|error| refused(file, &error))?;
    lines.end();
    if let Some(error) = lines.failed {
        return Err(unreadable(csv, &error));
    }
    if let Some(line) = lines.differs {
        data.line(format!("{}: line {line} is not as {} has it", shown(csv), shown(file)))?;
        return Ok(Outcome::Differs);
    }
    data.line(format!("{}, the same in both and as they were sealed", counted(rows, "row")))?;
    Ok(Outcome::Done)
}

/// The lines of a file that is compared.
struct CsvLines {
    input: BufReader<File>,
    number: u64,
    /// The first line that is another, from 1.
    differs: Option<u64>,
    failed: Option<io::Error>,
}

impl CsvLines {
    /// Compares the next line. After the first that is another nothing is read.
    fn compare(&mut self, expected: &str) {
        if self.differs.is_some() || self.failed.is_some() {
            return;
        }
        self.number += 1;
        let mut line = Vec::new();
        match self.input.read_until(b'\n', &mut line) {
            Err(error) => self.failed = Some(error),
            Ok(_) if line.strip_suffix(b"\n") == Some(expected.as_bytes()) => {}
            Ok(_) => self.differs = Some(self.number),
        }
    }

    /// Nothing may follow.
    fn end(&mut self) {
        if self.differs.is_some() || self.failed.is_some() {
            return;
        }
        match self.input.fill_buf() {
            Err(error) => self.failed = Some(error),
            Ok([]) => {}
            Ok(_) => self.differs = Some(self.number + 1),
        }
    }
}
