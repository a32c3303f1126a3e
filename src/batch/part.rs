//! Parts: the rows of one shard as a sealed text, written whole; and the lines of a journal while they are made.
//!
//! ```text
//! motion-lab sweep part 1
//! the study with all it names, one line of JSON
//! rows 0..250 of 1000
//! row,seed,ticks,...
//! 0,2005,1200,...
//! seal 32 hexadecimal digits: the xxh3-128 hash of all bytes before this line
//! ```

use std::io::{self, BufRead, Read, Write};
use std::ops::Range;

use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use motion_lab_core::one_line::OneLine;

use super::RowValue;
use super::columns::{Column, heading};
use super::row::RunRow;
use super::study::Study;

/// What a part begins with.
const MAGIC: &str = "motion-lab sweep part 1";

/// Largest length of a line, bytes. The study's line holds its worlds and scripts.
const MAX_LINE: u64 = 256 << 20;

/// Why a part can't be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PartError {
    /// It can't be read at all.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A file without a byte.
    #[error("it is empty")]
    Empty,
    /// Another file.
    #[error("it is no part of a sweep")]
    NotAPart,
    /// A study that can't be read, with the reason.
    #[error("{}", OneLine(.0))]
    Study(String),
    /// A whole part with other columns than this version gives to its study.
    #[error("its columns are those of another version of motion-lab")]
    Columns,
    /// A line that is none of this part's.
    #[error("line {0} is damaged")]
    Line(u64),
    /// The seal is missing or wrong.
    #[error("it is damaged: its seal is not that of its bytes")]
    Seal,
}

/// The head of a part: which rows of which sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartHead {
    /// The study's line: see [`Study::line`].
    pub study: String,
    /// The rows of the part.
    pub rows: Range<u64>,
    /// The number of rows of the sweep.
    pub runs: u64,
}

impl PartHead {
    /// The head of these rows of a sweep.
    pub fn new(study: &Study, rows: Range<u64>) -> Self {
        PartHead { study: study.line().to_owned(), rows, runs: study.runs() }
    }

    /// Its lines, each with its end.
    pub fn to_text(&self, columns: &[Column]) -> String {
        let PartHead { study, rows, runs } = self;
        let (rows, names) = (Self::rows_line(rows, *runs), heading(columns));
        format!("{MAGIC}\n{study}\n{rows}\n{names}\n")
    }

    fn rows_line(rows: &Range<u64>, runs: u64) -> String {
        format!("rows {}..{} of {runs}", rows.start, rows.end)
    }

    fn read_rows(line: &str) -> Option<(Range<u64>, u64)> {
        let (rows, runs) = line.strip_prefix("rows ")?.split_once(" of ")?;
        let (start, end) = rows.split_once("..")?;
        let (rows, runs): (Range<u64>, u64) = (start.parse().ok()?..end.parse().ok()?, runs.parse().ok()?);
        // a sign or a leading zero is nothing that is written here
        let is_as_written = Self::rows_line(&rows, runs) == line;
        (is_as_written && rows.start <= rows.end && rows.end <= runs).then_some((rows, runs))
    }
}

/// Writes a part.
pub struct PartWriter<W> {
    output: W,
    hasher: Xxh3,
}

impl<W: Write> PartWriter<W> {
    /// Begins a part.
    ///
    /// # Errors
    /// [`io::Error`] of the output.
    pub fn new(output: W, head: &PartHead, columns: &[Column]) -> io::Result<Self> {
        let mut writer = PartWriter { output, hasher: Xxh3::new() };
        writer.write(&head.to_text(columns))?;
        Ok(writer)
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.hasher.update(text.as_bytes());
        self.output.write_all(text.as_bytes())
    }

    /// Writes the next row, as [`RunRow::to_line`] has it.
    ///
    /// # Errors
    /// [`io::Error`] of the output.
    pub fn row(&mut self, line: &str) -> io::Result<()> {
        self.write(line)?;
        self.write("\n")
    }

    /// Seals the part and returns the output.
    ///
    /// # Errors
    /// [`io::Error`] of the output.
    pub fn finish(mut self) -> io::Result<W> {
        writeln!(self.output, "seal {:032x}", self.hasher.digest128())?;
        Ok(self.output)
    }
}

/// Reads a part row by row. What it hands out is proven only when it has read the seal: at the end.
pub struct PartReader<R> {
    input: R,
    hasher: Xxh3,
    line: u64,
    study: Study,
    head: PartHead,
    next: u64,
}

/// The next line without its end; `None` at the end of the input, and where a line has no end.
fn read_line(input: &mut impl BufRead, hasher: &mut Xxh3) -> io::Result<Option<String>> {
    let mut text = String::new();
    let taken = input.by_ref().take(MAX_LINE).read_line(&mut text);
    match taken {
        Err(error) if error.kind() == io::ErrorKind::InvalidData => return Ok(None),
        taken => taken?,
    };
    let Some(line) = text.strip_suffix('\n') else { return Ok(None) };
    if !line.starts_with("seal ") {
        hasher.update(text.as_bytes());
    }
    text.pop();
    Ok(Some(text))
}

/// Reads to the end: whether the last line is the seal of all bytes before it.
fn is_sealed(input: &mut impl BufRead, hasher: &mut Xxh3) -> io::Result<bool> {
    let mut before = hasher.digest128();
    let mut last = None;
    while let Some(line) = read_line(input, hasher)? {
        let after = hasher.digest128();
        last = Some(line == format!("seal {before:032x}"));
        before = after;
    }
    Ok(last == Some(true) && input.fill_buf()?.is_empty())
}

impl<R: BufRead> PartReader<R> {
    /// Reads the head of a part.
    ///
    /// # Errors
    /// [`PartError`] for another file, a damaged head, or a study that this program can't read in a part whose seal is
    /// right.
    pub fn new(mut input: R) -> Result<Self, PartError> {
        let mut hasher = Xxh3::new();
        if input.fill_buf()?.is_empty() {
            return Err(PartError::Empty);
        }
        let mut magic = vec![0; MAGIC.len() + 1];
        match input.read_exact(&mut magic) {
            Err(error) if error.kind() != io::ErrorKind::UnexpectedEof => return Err(error.into()),
            _ => {}
        }
        if magic != format!("{MAGIC}\n").as_bytes() {
            return Err(PartError::NotAPart);
        }
        hasher.update(&magic);
        let plan_line = read_line(&mut input, &mut hasher)?.ok_or(PartError::Line(2))?;
        let study = match Study::of_line(&plan_line) {
            Ok(study) => study,
            Err(reason) if is_sealed(&mut input, &mut hasher)? => return Err(PartError::Study(reason)),
            Err(_) => return Err(PartError::Seal),
        };
        let rows = read_line(&mut input, &mut hasher)?.and_then(|line| PartHead::read_rows(&line));
        let (rows, runs) = rows.filter(|(_, runs)| *runs == study.runs()).ok_or(PartError::Line(3))?;
        match read_line(&mut input, &mut hasher)? {
            Some(names) if names == study.heading() => {}
            Some(_) if is_sealed(&mut input, &mut hasher)? => return Err(PartError::Columns),
            _ => return Err(PartError::Line(4)),
        }
        let next = rows.start;
        Ok(PartReader { input, hasher, line: 4, head: PartHead { study: plan_line, rows, runs }, study, next })
    }

    /// The study.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// The head.
    pub fn head(&self) -> &PartHead {
        &self.head
    }

    /// The next row with its line; `None` after the last one, whose seal is then proven.
    ///
    /// # Errors
    /// [`PartError`] where the part is damaged.
    pub fn row(&mut self) -> Result<Option<(RunRow, String)>, PartError> {
        if self.next > self.head.rows.end {
            return Ok(None);
        }
        self.line += 1;
        let before = self.hasher.digest128();
        let line = read_line(&mut self.input, &mut self.hasher)?.ok_or(PartError::Seal)?;
        if self.next == self.head.rows.end {
            let is_last = self.input.fill_buf()?.is_empty();
            self.next += 1;
            return if line == format!("seal {before:032x}") && is_last { Ok(None) } else { Err(PartError::Seal) };
        }
        let row = RunRow::of_line(&line, self.study.columns()).filter(|row| row.row == self.next);
        let row = row.ok_or(PartError::Line(self.line))?;
        self.next += 1;
        Ok(Some((row, line)))
    }

    /// Reads it to its end, which proves its bytes, and returns the number of its rows.
    ///
    /// # Errors
    /// [`PartError`] where the part is damaged.
    pub fn prove(mut self) -> Result<u64, PartError> {
        while self.row()?.is_some() {}
        Ok(self.head.rows.end - self.head.rows.start)
    }
}

/// A row's line as a journal keeps it: after its hash, so that a line cut short is known.
pub fn sealed_line(line: &str) -> String {
    format!("{:016x} {line}\n", xxh3_64(line.as_bytes()))
}

/// The row and its line from a journal's line without its end; `None` for one that is cut short or damaged.
pub fn unsealed_line<'a>(sealed: &'a str, columns: &[Column]) -> Option<(u64, &'a str)> {
    let (seal, line) = sealed.split_once(' ')?;
    let row = RunRow::of_line(line, columns)?;
    (seal == format!("{:016x}", xxh3_64(line.as_bytes()))).then_some((row.row, line))
}

impl RunRow {
    /// Whether the run failed: it could not be run, or something failed in it.
    pub fn is_failure(&self, columns: &[Column]) -> bool {
        self.cell(columns, "failure").is_some_and(|cell| *cell != RowValue::Empty)
    }

    /// Whether there was a run at all: a row without a digest only says why not.
    pub fn could_run(&self, columns: &[Column]) -> bool {
        self.cell(columns, "digest").is_some_and(|cell| *cell != RowValue::Empty)
    }

    /// Whether a robot was in contact in the run.
    pub fn has_contacts(&self, columns: &[Column]) -> bool {
        matches!(self.cell(columns, "contacts"), Some(RowValue::Whole(1..)))
    }
}
