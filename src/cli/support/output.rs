//! The library's output files, written whole or not at all, with this program's errors.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::output;

use super::gate::{self, is_dash, shown};
use super::target::Target;
use crate::cli::{Data, Failure};

/// A file that is being written: see [`output::PendingFile`].
pub struct ReportedFile {
    path: PathBuf,
    partial: Option<PathBuf>,
    file: output::PendingFile,
}

impl ReportedFile {
    /// Begins the file of a target.
    pub fn create(target: &Target) -> Result<Self, Failure> {
        let path = target.path();
        let file = output::PendingFile::create(path).map_err(|error| Failure::output(path, &error))?;
        Ok(ReportedFile { path: path.to_owned(), partial: target.partial().map(Path::to_owned), file })
    }

    /// Puts the file in its place. A log's other name, for one that stops early, is free then.
    pub fn commit(self) -> Result<(), Failure> {
        self.file.commit().map_err(|error| Failure::output(&self.path, &error))?;
        gate::written(&self.path);
        if let Some(partial) = &self.partial {
            gate::release(partial);
        }
        Ok(())
    }

    /// Lets an end at once keep the file under this name, in the same folder, where there is none of this name.
    pub fn keep_when_abandoned(&self, path: &Path) {
        self.file.keep_when_abandoned(path);
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

/// Makes the folder of an output that is several files, where there is none.
pub fn make_folder(folder: &Path) -> Result<(), Failure> {
    if is_dash(folder) {
        return Err(Failure::usage("-: this output is a folder, not for standard output", "Name a folder: -o FOLDER."));
    }
    fs::create_dir_all(folder).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => Failure::Output {
            file: shown(folder),
            reason: "this output is a folder, and a file is there".to_owned(),
            next: "Name a folder, or one that there is not yet.".to_owned(),
        },
        _ => Failure::output(folder, &error),
    })
}

/// Writes the whole file of a target.
pub fn write_file(target: &Target, bytes: &[u8]) -> Result<(), Failure> {
    let path = target.path();
    output::write_file(path, bytes).map_err(|error| Failure::output(path, &error))?;
    gate::written(path);
    Ok(())
}

/// Writes a text to a file, and says so; to standard output when there is none.
pub fn write_text(output: Option<&Path>, text: &str, data: &mut Data) -> Result<(), Failure> {
    let Some(output) = output.filter(|output| !is_dash(output)) else { return data.text(text) };
    let target = Target::of(output)?;
    write_file(&target, text.as_bytes())?;
    target.finish(data)
}
