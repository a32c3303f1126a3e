//! The target of an export: a file that is written whole or not at all, or standard output.

use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::cli::support::output::PendingFile;
use crate::cli::{Data, Failure};

/// A file that is being written, or standard output.
pub enum Sink<'a> {
    /// A file under this name.
    File(PathBuf, PendingFile),
    /// Standard output.
    Data(&'a mut Data),
}

impl<'a> Sink<'a> {
    /// The file at `output`; standard output when there is none.
    pub fn new(output: Option<&Path>, data: &'a mut Data) -> Result<Self, Failure> {
        Ok(match output {
            Some(path) => Sink::File(path.to_owned(), PendingFile::create(path)?),
            None => Sink::Data(data),
        })
    }

    /// Writes a line.
    pub fn line(&mut self, line: impl Display) -> Result<(), Failure> {
        match self {
            Sink::File(path, file) => writeln!(file, "{line}").map_err(|error| Failure::output(path, &error)),
            Sink::Data(data) => data.data_line(line),
        }
    }

    /// Writes a text as it is.
    pub fn text(&mut self, text: &str) -> Result<(), Failure> {
        match self {
            Sink::File(path, file) => file.write_all(text.as_bytes()).map_err(|error| Failure::output(path, &error)),
            Sink::Data(data) => data.text(text),
        }
    }

    /// Whether the reader of standard output has gone away.
    pub fn is_closed(&self) -> bool {
        matches!(self, Sink::Data(data) if data.is_closed())
    }

    /// Puts a file in its place.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Sink::File(_, file) => file.commit(),
            Sink::Data(_) => Ok(()),
        }
    }
}
