//! `sweep merge`: the parts of a sweep as one table, proven complete.

use std::fs::{self, File};
use std::io::{BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::batch::{PartError, PartReader, RowValue, RunRow, Study, TableError, TableWriter};
use clap::{Args, ValueEnum};

use crate::cli::support::input::{is_dash, open, unreadable};
use crate::cli::support::output::ReportedFile;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Make one table of a sweep's parts, if they hold every row.
///
/// Parts of any sharding go together; a row that several hold must be the same in all, and each must say the seed, the
/// length and the values that the study has in it. Nothing is written where rows are missing, which are listed, or
/// where parts are of different studies. Without an output it only checks.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab sweep merge runs/noise -o noise.parquet -o noise.csv
  motion-lab sweep merge node1 node2 node3")]
pub struct Merge {
    /// Parts, or folders of parts.
    #[arg(required = true, value_name = "PART|FOLDER")]
    parts: Vec<PathBuf>,
    /// The table to write: .parquet, which holds its study and units, or .csv; `-` is standard output. May be given for
    /// each.
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// The form. [default: by the output's name; csv for `-`]
    #[arg(long, requires = "output")]
    format: Option<TableForm>,
}

/// The form of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TableForm {
    /// Comma-separated values.
    Csv,
    /// A Parquet file, with its study and units.
    Parquet,
}

impl TableForm {
    /// The form `said`, else the one that a file's name tells, else CSV for standard output.
    fn of(path: &Path, said: Option<TableForm>) -> Result<TableForm, Failure> {
        let named = match path.extension().and_then(|ending| ending.to_str()) {
            Some("csv") => Some(TableForm::Csv),
            Some("parquet") => Some(TableForm::Parquet),
            _ => None,
        };
        let piped = || is_dash(path).then_some(TableForm::Csv);
        said.or(named).or_else(piped).ok_or_else(|| {
            Failure::usage(
                format!("{}: no table has this ending", path.display()),
                "Name a file that ends in .parquet or .csv, or say --format.",
            )
        })
    }
}

/// The failure of a part that can't be read.
pub fn refused(part: &Path, error: &PartError) -> Failure {
    let next = match error {
        PartError::Study(_) | PartError::Columns => "Use the version of motion-lab that wrote it.",
        PartError::NotAPart => {
            "Name a part, or a folder of parts. A damaged part is taken away and its shard run again."
        }
        _ => "Take it away and run its shard again.",
    };
    Failure::input(format!("{}: {error}", part.display()), next)
}

/// The parts in these files and folders.
fn found(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut parts = Vec::new();
    for path in paths {
        if !path.is_dir() {
            parts.push(path.clone());
            continue;
        }
        let entries = fs::read_dir(path).map_err(|error| unreadable(path, &error))?;
        let mut names = Vec::new();
        for entry in entries {
            let name = entry.map_err(|error| unreadable(path, &error))?.path();
            if name.extension().is_some_and(|ending| ending == "sweep") && name.is_file() {
                names.push(name);
            }
        }
        names.sort();
        parts.extend(names);
    }
    Ok(parts)
}

/// A part, opened.
struct OpenedPart {
    path: PathBuf,
    reader: PartReader<BufReader<File>>,
    /// The next row.
    row: Option<(RunRow, String)>,
}

impl OpenedPart {
    fn open(path: &Path) -> Result<Self, Failure> {
        let reader = PartReader::new(BufReader::new(open(path)?)).map_err(|error| refused(path, &error))?;
        Ok(OpenedPart { path: path.to_owned(), reader, row: None })
    }

    /// Reads it to its end, which proves its bytes.
    fn prove(self) -> Result<u64, Failure> {
        self.reader.prove().map_err(|error| refused(&self.path, &error))
    }

    fn advance(&mut self) -> Result<(), Failure> {
        self.row = self.reader.row().map_err(|error| refused(&self.path, &error))?;
        Ok(())
    }
}

/// An output.
enum Output {
    Csv(ReportedFile, PathBuf),
    Parquet(Box<TableWriter<ReportedFile>>, PathBuf),
}

impl Output {
    fn begin(target: &Target, form: TableForm, study: &Study) -> Result<Self, Failure> {
        let path = target.path();
        match form {
            TableForm::Csv => {
                let mut file = ReportedFile::create(target)?;
                writeln!(file, "{}", study.table_heading()).map_err(|error| Failure::output(path, &error))?;
                Ok(Output::Csv(file, path.to_owned()))
            }
            TableForm::Parquet => {
                let table = TableWriter::new(ReportedFile::create(target)?, study);
                Ok(Output::Parquet(Box::new(table.map_err(|error| unwritten(path, error))?), path.to_owned()))
            }
        }
    }

    fn row(&mut self, row: &RunRow) -> Result<(), Failure> {
        match self {
            Output::Csv(file, path) => {
                writeln!(file, "{}", row.to_table_line()).map_err(|error| Failure::output(path, &error))
            }
            Output::Parquet(table, path) => table.row(row.clone()).map_err(|error| unwritten(path, error)),
        }
    }

    fn finish(self) -> Result<(), Failure> {
        match self {
            Output::Csv(file, _) => file.commit(),
            Output::Parquet(table, path) => table.finish().map_err(|error| unwritten(&path, error))?.commit(),
        }
    }
}

fn unwritten(path: &Path, error: TableError) -> Failure {
    Failure::output(path, &std::io::Error::other(error))
}

impl Merge {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let paths = found(&self.parts)?;
        let mut parts = Vec::with_capacity(paths.len());
        let mut study: Option<(Study, PathBuf)> = None;
        for path in paths {
            let reader = OpenedPart::open(&path)?.reader;
            let (study, first) = study.get_or_insert_with(|| (reader.study().clone(), path.clone()));
            if study.line() != reader.head().study {
                // a damaged study looks like another one
                for path in [&*first, &path] {
                    OpenedPart::open(path)?.prove()?;
                }
                return Err(Failure::input(
                    format!(
                        "{}: it is of another study ({}) than {} ({})",
                        path.display(),
                        reader.study().digest(),
                        first.display(),
                        study.digest()
                    ),
                    "Merge the parts of one study only.",
                ));
            }
            parts.push((reader.head().rows.clone(), path));
        }
        let Some((study, _)) = study else {
            return Err(Failure::input("there are no parts", "Name parts, or folders with files that end in .sweep."));
        };
        parts.sort_by(|(a, pa), (b, pb)| (a.start, b.end, pa).cmp(&(b.start, a.end, pb)));
        let forms = self.output.iter().map(|path| TableForm::of(path, self.format)).collect::<Result<Vec<_>, _>>()?;
        let targets = self.output.iter().map(|path| Target::of(path)).collect::<Result<Vec<_>, _>>()?;
        let outputs = targets.iter().zip(forms).map(|(target, form)| Output::begin(target, form, &study));
        let mut outputs = outputs.collect::<Result<Vec<_>, _>>()?;
        let progress = CommandProgress::of(study.runs(), "rows");
        let mut waiting = parts.into_iter().peekable();
        let mut at_work: Vec<OpenedPart> = Vec::new();
        let (mut missing, mut failures): (Vec<Range<u64>>, u64) = (Vec::new(), 0);
        for next in 0..study.runs() {
            while let Some((_, path)) = waiting.next_if(|(rows, _)| rows.start <= next) {
                let mut opened = OpenedPart::open(&path)?;
                opened.advance()?;
                at_work.push(opened);
            }
            let mut taken: Option<(RunRow, String, PathBuf)> = None;
            for part in &mut at_work {
                let Some((row, line)) = part.row.take_if(|(row, _)| row.row == next) else { continue };
                match &taken {
                    None => taken = Some((row, line, part.path.clone())),
                    Some((_, first, _)) if *first == line => {}
                    Some((.., first)) => {
                        return Err(Failure::input(
                            format!("row {next} is not the same in {} and {}", first.display(), part.path.display()),
                            "One of them was made by another version or a machine at fault: see `sweep reproduce`.",
                        ));
                    }
                }
                part.advance()?;
            }
            at_work.retain(|part| part.row.is_some());
            match taken {
                None => match missing.last_mut() {
                    Some(range) if range.end == next => range.end += 1,
                    _ => missing.push(next..next + 1),
                },
                Some((row, _, path)) => {
                    check_plan(&study, &row, &path)?;
                    failures += u64::from(row.is_failure(study.columns()));
                    outputs.iter_mut().try_for_each(|output| output.row(&row))?;
                }
            }
            progress.at(next + 1);
        }
        drop(progress);
        if !missing.is_empty() {
            missing.iter().try_for_each(|range| data.line(format!("{range:?}")))?;
            data.flush()?;
            let count: u64 = missing.iter().map(|range| range.end - range.start).sum();
            return Err(Failure::input(
                format!(
                    "{count} of {} are missing: the ranges above, without their ends",
                    counted(study.runs(), "row")
                ),
                "Run the shards that are not finished; nothing was written.",
            ));
        }
        let rows = counted(study.runs(), "row");
        data.line(format!("{rows}, {failures} failed, study {}", study.digest()))?;
        outputs.into_iter().try_for_each(Output::finish)?;
        targets.into_iter().try_for_each(|target| target.finish(data))?;
        Ok(Outcome::Done)
    }
}

/// Checks that a row says the run that the study has in it: its seed, its length, the values of the axes.
fn check_plan(study: &Study, row: &RunRow, path: &Path) -> Result<(), Failure> {
    let Some((column, own)) = study.contradicted(row) else { return Ok(()) };
    // where the seal is wrong, the part is damaged
    OpenedPart::open(path)?.prove()?;
    let (name, number, own) = (&column.name, row.row, own.to_text());
    let found = row.cell(study.columns(), name).map_or_else(String::new, RowValue::to_text);
    Err(Failure::input(
        format!("{}: row {number} has {name} {found:?}, where its study has {own:?}", path.display()),
        "It was changed after it was made. Take the part away and run its shard again.",
    ))
}
