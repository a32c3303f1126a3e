//! The target of an export: a file that is written whole or not at all, or standard output.

use std::io::{self, Write};
use std::path::PathBuf;

use motion_lab_sim::export::ExportError;

use crate::cli::support::output::ReportedFile;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure};

/// A file that is being written, or standard output.
pub enum ExportSink<'a> {
    /// A file under this name.
    File(PathBuf, ReportedFile),
    /// Standard output.
    Data(&'a mut Data),
}

impl<'a> ExportSink<'a> {
    /// The file of a target; standard output when there is none.
    pub fn new(target: Option<&Target>, data: &'a mut Data) -> Result<Self, Failure> {
        Ok(match target {
            Some(target) => ExportSink::File(target.path().to_owned(), ReportedFile::create(target)?),
            None => ExportSink::Data(data),
        })
    }

    /// Writes a text as it is.
    pub fn text(&mut self, text: &str) -> Result<(), Failure> {
        self.take(|out| Ok(out.write_all(text.as_bytes())?))
    }

    /// Takes what `write` writes. A reader of standard output that has gone away is no failure.
    pub fn take(&mut self, write: impl FnOnce(&mut Self) -> Result<(), ExportError>) -> Result<(), Failure> {
        match (write(self), self) {
            (Ok(()), _) => Ok(()),
            (Err(ExportError::Write(error)), ExportSink::File(path, _)) => Err(Failure::output(path, &error)),
            (Err(ExportError::Write(error)), ExportSink::Data(data)) => data.after(Err(error)),
            (Err(error), _) => Err(Failure::internal(error)),
        }
    }

    /// Puts a file in its place.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            ExportSink::File(_, file) => file.commit(),
            ExportSink::Data(_) => Ok(()),
        }
    }
}

impl Write for ExportSink<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            ExportSink::File(_, file) => file.write(bytes),
            ExportSink::Data(data) => data.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            ExportSink::File(_, file) => file.flush(),
            ExportSink::Data(data) => Write::flush(&mut **data),
        }
    }
}
