//! `Target`, where a command's output goes, and what it says about it.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::output::{PassingFolder, resolved};

use super::console::note;
use super::gate::{self, OutputKind, is_dash};
use crate::cli::{Data, Failure};

/// The target of an output: a file, or for `-` standard output, which gets the whole file when it is done.
///
/// There is no other way to write a file than by its target, and no target of a file that is also an input or another
/// output: see [`gate`]. A command makes its targets before it writes the first of them.
pub struct Target {
    path: PathBuf,
    /// The size of the file that is replaced, bytes.
    older: Option<u64>,
    /// The folder of a file that goes to standard output.
    passing: Option<PassingFolder>,
}

impl Target {
    /// The target that the user calls `output`: anything but a log. Call it before the file is begun.
    pub fn of(output: &Path) -> Result<Self, Failure> {
        if is_dash(output) {
            gate::claim_stdout()?;
            let folder = PassingFolder::new().map_err(|error| Failure::output(&std::env::temp_dir(), &error))?;
            return Ok(Target { path: folder.path().join("output"), older: None, passing: Some(folder) });
        }
        gate::claim(output, OutputKind::Other)?;
        Ok(Self::claimed(output))
    }

    /// As [`of`](Self::of), for a file that standard output can't take, as one of several.
    pub fn file(output: &Path) -> Result<Self, Failure> {
        if is_dash(output) { Err(not_for_stdout()) } else { Self::of(output) }
    }

    /// As [`file`](Self::file), for a log. The name by which it is kept if it stops early is taken too.
    pub fn log(output: &Path) -> Result<Self, Failure> {
        if is_dash(output) {
            return Err(not_for_stdout());
        }
        gate::claim(output, OutputKind::Log)?;
        gate::claim(&partial_name(output), OutputKind::Log)?;
        Ok(Self::claimed(output))
    }

    /// As [`log`](Self::log), for a log that goes on with the recording in `begun`, which may be what it replaces: all
    /// of it is in the log.
    pub fn resumed(output: &Path, begun: &Path) -> Result<Self, Failure> {
        if is_dash(output) {
            return Err(not_for_stdout());
        }
        if output != begun {
            gate::claim(output, OutputKind::Log)?;
        }
        let partial = partial_name(output);
        if resolved(&partial) != resolved(begun) {
            gate::claim(&partial, OutputKind::Log)?;
        }
        Ok(Self::claimed(output))
    }

    fn claimed(output: &Path) -> Self {
        let older = fs::metadata(output).ok().filter(fs::Metadata::is_file).map(|about| about.len());
        Target { path: output.to_owned(), older, passing: None }
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
        self.finish_with("", data)
    }

    /// As [`finish`](Self::finish), with more about the file.
    pub fn finish_with(self, more: &str, data: &mut Data) -> Result<(), Failure> {
        if self.passing.is_none() {
            self.wrote_with(more);
            return Ok(());
        }
        let bytes = fs::read(&self.path).map_err(|error| Failure::output(&self.path, &error))?;
        data.bytes(&bytes)
    }
}

fn not_for_stdout() -> Failure {
    Failure::usage("-: this output is not for standard output", "Name a file: -o FILE.")
}

/// The name of a recording that stopped early: the output's name with `.partial` behind it.
pub fn partial_name(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".partial");
    name.into()
}
