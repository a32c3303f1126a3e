//! The library's output files, written whole or not at all, with this program's errors.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use motion_lab::output;

use crate::cli::Failure;

/// A file that is being written: see [`output::PendingFile`].
pub struct ReportedFile {
    path: PathBuf,
    file: output::PendingFile,
}

impl ReportedFile {
    /// Begins a file that will be at `path`.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let file = output::PendingFile::create(path).map_err(|error| Failure::output(path, &error))?;
        Ok(ReportedFile { path: path.to_owned(), file })
    }

    /// Puts the file in its place.
    pub fn commit(self) -> Result<(), Failure> {
        self.file.commit().map_err(|error| Failure::output(&self.path, &error))
    }

    /// Flushes everything written to the disk.
    pub fn sync(&mut self) -> io::Result<()> {
        self.file.sync()
    }

    /// Keeps what the disk took, under another name in the same folder.
    pub fn keep_as(self, path: &Path) -> Result<(), Failure> {
        self.file.keep_as(path).map_err(|error| Failure::output(path, &error))
    }
}

impl Write for ReportedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    output::write_file(path, bytes).map_err(|error| Failure::output(path, &error))
}
