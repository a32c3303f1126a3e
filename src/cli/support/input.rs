//! Reading input files, each up to a largest size.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::gate;
pub use super::gate::{is_dash, shown};
use super::progress::CommandProgress;
use crate::cli::{Data, Failure, Outcome, say};

/// Largest size of a script, a map or another text, bytes.
pub const MAX_TEXT: u64 = 64 << 20;

/// Largest size of a world file, bytes: 320 for each of 100,000 shapes or robots.
pub const MAX_WORLD: u64 = 32 << 20;

/// Largest size of a map or a drawing of another program, bytes.
pub const MAX_FOREIGN: u64 = 16 << 20;

/// Least number of files of which the files done are counted; of fewer, the work on each is.
const MANY: usize = 10;

/// The first `most` bytes of standard input. What was read is kept, so that a command may read `-` again.
fn standard_input(most: u64) -> io::Result<Vec<u8>> {
    static TAKEN: Mutex<Vec<u8>> = Mutex::new(Vec::new());
    let mut taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    let missing = most.saturating_sub(taken.len() as u64);
    io::stdin().lock().take(missing).read_to_end(&mut taken)?;
    Ok(taken[..taken.len().min(usize::try_from(most).unwrap_or(usize::MAX))].to_vec())
}

/// The whole file as text.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    read_text_of(path, MAX_TEXT)
}

/// The whole file as text, at most `limit` bytes.
pub fn read_text_of(path: &Path, limit: u64) -> Result<String, Failure> {
    let bytes = read_bytes(path, limit)?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|&&b| b == b'\n').count() + 1;
        Failure::input(
            format!("{}: not UTF-8: byte {at} (line {line}) begins no character", shown(path)),
            "Save it as UTF-8, or name the right file.",
        )
    })
}

/// The whole file, at most `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    read_bytes_if(path, limit, |_| true)
}

/// The whole file, at most `limit` bytes, if `may_be` accepts its first eight bytes; otherwise these eight alone.
pub fn read_bytes_if(path: &Path, limit: u64, may_be: impl FnOnce(&[u8]) -> bool) -> Result<Vec<u8>, Failure> {
    let failed = |error: io::Error| unreadable(path, &error);
    let mut bytes = Vec::new();
    if is_dash(path) {
        gate::read_stdin()?;
        bytes = standard_input(8).map_err(failed)?;
        if !may_be(&bytes) {
            return Ok(bytes);
        }
        bytes = standard_input(limit + 1).map_err(failed)?;
    } else {
        let mut file = open(path)?.take(8);
        file.read_to_end(&mut bytes).map_err(failed)?;
        if !may_be(&bytes) {
            return Ok(bytes);
        }
        file.set_limit((limit + 1).saturating_sub(bytes.len() as u64));
        file.read_to_end(&mut bytes).map_err(failed)?;
    }
    if bytes.len() as u64 > limit {
        return Err(Failure::input(
            format!("{}: too large: more than {limit} bytes", shown(path)),
            "Is it the right file? Larger ones are refused.",
        ));
    }
    Ok(bytes)
}

/// Calls `with` for every file. A wrong file gets a message, in order with the output for the files before it, and the
/// others still have their turn.
pub fn for_each_file(
    files: &[PathBuf],
    data: &mut Data,
    mut with: impl FnMut(&Path, &mut Data) -> Result<(), Failure>,
) -> Result<Outcome, Failure> {
    worst_of_each(files, data, |file, data| with(file, data).map(|()| Outcome::Done))
}

/// As [`for_each_file`], for work with an outcome. The outcome of all is the worst of them: a difference, else a wrong
/// input, else damage.
pub fn worst_of_each(
    files: &[PathBuf],
    data: &mut Data,
    mut with: impl FnMut(&Path, &mut Data) -> Result<Outcome, Failure>,
) -> Result<Outcome, Failure> {
    let order = [Outcome::Done, Outcome::Recovered, Outcome::BadInput, Outcome::Differs];
    let rank = |outcome: Outcome| order.iter().position(|o| *o == outcome);
    let mut worst = Outcome::Done;
    let progress =
        if files.len() < MANY { CommandProgress::none() } else { CommandProgress::of(files.len() as u64, "files") };
    for file in files {
        let outcome = match with(file, data) {
            Err(failure @ Failure::Input { .. }) => {
                data.flush()?;
                say(failure);
                Outcome::BadInput
            }
            ended => ended?,
        };
        worst = if rank(outcome) > rank(worst) { outcome } else { worst };
        // the next file's messages come after the output for this one
        data.flush()?;
        progress.step();
    }
    Ok(worst)
}

/// A line with the file's name before what is said about it, where there are several files.
pub fn title(file: &Path, several: bool, data: &mut Data) -> Result<(), Failure> {
    if several { data.line(format!("{}:", shown(file))) } else { Ok(()) }
}

/// The file, opened for reading; refused when it is a folder.
pub fn open(path: &Path) -> Result<File, Failure> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    if file.metadata().is_ok_and(|about| about.is_dir()) {
        return Err(unreadable(path, &ErrorKind::IsADirectory.into()));
    }
    gate::read(path, &file)?;
    Ok(file)
}

/// The failure of a file that can't be read.
pub fn unreadable(path: &Path, error: &io::Error) -> Failure {
    let (reason, next) = match error.kind() {
        ErrorKind::NotFound => ("there is no such file".into(), "Check the path and the folder you are in."),
        ErrorKind::IsADirectory => ("it is a folder, not a file".into(), "Name a file in it."),
        ErrorKind::PermissionDenied => ("you may not read it".into(), "Change its permissions, or name another file."),
        _ => (error.to_string(), "Name another file."),
    };
    Failure::input(format!("{}: {reason}", shown(path)), next)
}
