//! `sweep merge`: the parts of a sweep as one table, proven complete.

use std::fs::{self, File};
use std::io::{BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab::batch::{PartError, PartReader, RowValue, RunRow, Study, TableError, TableWriter};

use crate::cli::support::input::{open, unreadable};
use crate::cli::support::output::ReportedFile;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
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
    /// The table to write: .parquet, which holds its study and units, or .csv. May be given for each.
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

/// The failure of a part that can't be read.
pub fn refused(part: &Path, error: &PartError) -> Failure {
    let next = match error {
        PartError::Study(_) => "Use the version of motion-lab that wrote it.",
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
    fn begin(path: &Path, study: &Study) -> Result<Self, Failure> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("csv") => {
                let mut file = ReportedFile::create(path)?;
                writeln!(file, "{}", study.heading()).map_err(|error| Failure::output(path, &error))?;
                Ok(Output::Csv(file, path.to_owned()))
            }
            Some("parquet") => {
                let table = TableWriter::new(ReportedFile::create(path)?, study);
                Ok(Output::Parquet(Box::new(table.map_err(|error| unwritten(path, error))?), path.to_owned()))
            }
            _ => Err(Failure::usage(
                format!("{}: no table has this ending", path.display()),
                "Name a file that ends in .parquet or .csv.",
            )),
        }
    }

    fn row(&mut self, row: &RunRow, line: &str) -> Result<(), Failure> {
        match self {
            Output::Csv(file, path) => writeln!(file, "{line}").map_err(|error| Failure::output(path, &error)),
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
        check_outputs(&self.output)?;
        let targets = self.output.iter().map(|path| Target::file(path)).collect::<Result<Vec<_>, _>>()?;
        let mut outputs = self.output.iter().map(|path| Output::begin(path, &study)).collect::<Result<Vec<_>, _>>()?;
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
                Some((row, line, path)) => {
                    check_plan(&study, &row, &path)?;
                    failures += u64::from(row.is_failure(study.columns()));
                    outputs.iter_mut().try_for_each(|output| output.row(&row, &line))?;
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
                format!("{count} of {} rows are missing: the ranges above, without their ends", study.runs()),
                "Run the shards that are not finished; nothing was written.",
            ));
        }
        data.line(format!("{} rows, {failures} failed, study {}", study.runs(), study.digest()))?;
        outputs.into_iter().try_for_each(Output::finish)?;
        targets.iter().for_each(Target::wrote);
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

/// Checks that no two outputs are one file, of which only the last would stay.
fn check_outputs(outputs: &[PathBuf]) -> Result<(), Failure> {
    let real = |path: &PathBuf| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        fs::canonicalize(folder)
            .map_or_else(|_| path.clone(), |folder| folder.join(path.file_name().unwrap_or_default()))
    };
    let files: Vec<PathBuf> = outputs.iter().map(real).collect();
    match (1..files.len()).find(|i| files[..*i].contains(&files[*i])) {
        Some(i) => Err(Failure::usage(
            format!("{}: it is named twice", outputs[i].display()),
            "Give each -o a file of its own.",
        )),
        None => Ok(()),
    }
}
