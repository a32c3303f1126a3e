//! `Target`, where a command's output goes, and what it says about it.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::console::note;
use super::input::{is_dash, read_bytes};
use super::log_source::MAX_LOG;
use super::output::write_file;
use crate::cli::{Data, Failure};

/// Writes a text to a file, and says so; to standard output when there is none.
pub fn write_text(output: Option<&Path>, text: &str, data: &mut Data) -> Result<(), Failure> {
    let Some(output) = output.filter(|output| !is_dash(output)) else { return data.text(text) };
    let target = Target::of(output)?;
    write_file(target.path(), text.as_bytes())?;
    target.finish(data)
}

/// The target of an output: a file, or for `-` standard output, which gets the whole file when it is done.
pub struct Target {
    path: PathBuf,
    /// The size of the file that is replaced, bytes.
    older: Option<u64>,
    /// The folder of a file that goes to standard output.
    passing: Option<TempDir>,
}

impl Target {
    /// The target that the user calls `output`. Call it before the file is begun.
    pub fn of(output: &Path) -> Result<Self, Failure> {
        if is_dash(output) {
            let folder = TempDir::new().map_err(|error| Failure::output(&std::env::temp_dir(), &error))?;
            return Ok(Target { path: folder.path().join("output"), older: None, passing: Some(folder) });
        }
        let older = fs::metadata(output).ok().filter(fs::Metadata::is_file).map(|about| about.len());
        Ok(Target { path: output.to_owned(), older, passing: None })
    }

    /// As [`of`](Self::of), for a file that standard output can't take: a log, or several files.
    pub fn file(output: &Path) -> Result<Self, Failure> {
        if is_dash(output) {
            return Err(Failure::usage("-: this output is not for standard output", "Name a file: -o FILE."));
        }
        Self::of(output)
    }

    /// The size of the file that is replaced, bytes; `None` where there is none.
    pub fn older(&self) -> Option<u64> {
        self.older
    }

    /// The file to write.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Says that the file was written, and what it replaced: `wrote run.mcap, replacing an older file of 512 bytes`.
    pub fn wrote(&self) {
        self.wrote_with("");
    }

    /// As [`wrote`](Self::wrote), with more about the file, such as ` with 3 obstacles`.
    pub fn wrote_with(&self, more: &str) {
        note(format!("wrote {}{more}{}", self.path.display(), self.replacing()));
    }

    /// `, replacing an older file of 512 bytes`; nothing where there was none.
    pub fn replacing(&self) -> String {
        self.older.map_or(String::new(), |bytes| format!(", replacing an older file of {bytes} bytes"))
    }

    /// Says that the file was written, or passes it on to standard output.
    pub fn finish(self, data: &mut Data) -> Result<(), Failure> {
        if self.passing.is_none() {
            self.wrote();
            return Ok(());
        }
        let bytes = read_bytes(&self.path, MAX_LOG)?;
        data.bytes(&bytes)
    }
}
