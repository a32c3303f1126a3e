//! `Target`, where a command's output goes, and what it says about it.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::output::{PassingFolder, resolved};

use super::console::note;
use super::gate::{self, OutputKind, as_on_disk, is_dash};
use crate::cli::{Data, Failure};

/// Number of digits of the largest `u64`.
const MAX_DIGITS: usize = 20;

/// The target of an output: a file, or for `-` standard output, which gets the whole file when it is done.
///
/// Every file that an option names as an output is written by its target, and no target is of a file that is also an
/// input or another output: see [`gate`]. A command makes its targets before it writes the first of them, but for the
/// logs of many runs, which it [checks](Self::check_log) then.
pub struct Target {
    path: PathBuf,
    /// The name that is taken besides, for a log that stops early.
    partial: Option<PathBuf>,
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
            return Ok(Target {
                path: folder.path().join("output"),
                partial: None,
                older: None,
                passing: Some(folder),
            });
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
        let partial = partial_name(output);
        gate::claim(&partial, OutputKind::Log)?;
        Ok(Target { partial: Some(partial), ..Self::claimed(output) })
    }

    /// Refuses a log as [`log`](Self::log) would, and claims nothing.
    pub fn check_log(output: &Path) -> Result<(), Failure> {
        gate::check(output)?;
        gate::check(&partial_name(output))
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
        let is_free = resolved(&partial) != resolved(begun);
        if is_free {
            gate::claim(&partial, OutputKind::Log)?;
        }
        Ok(Target { partial: is_free.then_some(partial), ..Self::claimed(output) })
    }

    fn claimed(output: &Path) -> Self {
        let older = fs::metadata(output).ok().filter(fs::Metadata::is_file).map(|about| about.len());
        Target { path: output.to_owned(), partial: None, older, passing: None }
    }

    /// The name that is taken besides, for a log that stops early.
    pub fn partial(&self) -> Option<&Path> {
        self.partial.as_deref()
    }

    /// Lets the gate forget the file, whether it was written or not. For logs of many runs that can't be one file, so
    /// that what is kept of them does not grow with their number.
    pub fn release(self) {
        gate::release(&self.path);
        if let Some(partial) = &self.partial {
            gate::release(partial);
        }
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

/// The numbers that may follow `before` in the names of a folder: of `run-12.mcap`, 1 and 12 follow `run-`. None where
/// the folder can't be listed.
///
/// An input is a file that is there, so of any number of logs only these can be one.
pub fn numbers_in(folder: &Path, before: &str) -> BTreeSet<u64> {
    let on_disk = |name: OsString| as_on_disk(name).to_string_lossy().into_owned();
    let before = on_disk(before.into());
    let numbers = |name: String| {
        let rest = name.strip_prefix(&before).unwrap_or_default();
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count().min(MAX_DIGITS);
        (1..=digits).filter_map(|length| rest[..length].parse().ok()).collect::<Vec<u64>>()
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.flat_map(|entry| numbers(on_disk(entry.file_name()))).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_holds_every_number_that_its_digits_may_begin_with() {
        for (before, name, numbers) in [
            ("", "12.mcap", &[1, 12][..]),
            ("", "a12.mcap", &[]),
            ("run-", "run-705b9", &[7, 70, 705]),
            ("run-", "run", &[]),
            ("1", "123", &[2, 23]),
            ("", "007", &[0, 7]),
            ("x", "x18446744073709551616", &[1, 18, 184, 1844]),
            ("", "\u{e9}1", &[]),
            ("\u{e9}", "\u{e9}1\u{e9}", &[1]),
        ] {
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join(name), "").unwrap();
            let found: Vec<u64> = numbers_in(folder.path(), before).into_iter().take(4).collect();
            assert_eq!(found, numbers, "{before} {name}");
        }
        let folder = tempfile::tempdir().unwrap();
        assert!(numbers_in(&folder.path().join("none"), "").is_empty());
        for name in ["3", "20.mcap", &format!("{}0", u64::MAX)] {
            fs::create_dir(folder.path().join(name)).unwrap();
        }
        let found = numbers_in(folder.path(), "");
        assert_eq!(found.last(), Some(&u64::MAX), "the whole of the first 20 digits");
        assert!(found.is_superset(&[2, 3, 20].into()), "of every name: {found:?}");
    }
}
