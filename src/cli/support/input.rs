//! Reading input files, each up to a largest size.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use crate::cli::{Data, Failure, Outcome, say};

/// Largest size of a script, a map or another text, bytes.
pub const MAX_TEXT: u64 = 64 << 20;

/// Largest size of a world file, bytes: 320 for each of 100,000 shapes or robots.
pub const MAX_WORLD: u64 = 32 << 20;

/// Largest size of a map or a drawing of another program, bytes.
pub const MAX_FOREIGN: u64 = 16 << 20;

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
            format!("{}: not UTF-8: byte {at} (line {line}) begins no character", path.display()),
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
    let mut bytes = Vec::new();
    let mut file = open(path)?.take(8);
    file.read_to_end(&mut bytes).map_err(|error| unreadable(path, &error))?;
    if !may_be(&bytes) {
        return Ok(bytes);
    }
    file.set_limit((limit + 1).saturating_sub(bytes.len() as u64));
    file.read_to_end(&mut bytes).map_err(|error| unreadable(path, &error))?;
    if bytes.len() as u64 > limit {
        return Err(Failure::input(
            format!("{}: too large: more than {limit} bytes", path.display()),
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
    let mut outcome = Outcome::Done;
    for file in files {
        match with(file, data) {
            Err(failure @ Failure::Input { .. }) => {
                outcome = Outcome::BadInput;
                data.flush()?;
                say(failure);
            }
            ended => ended?,
        }
    }
    Ok(outcome)
}

/// The file, opened for reading; refused when it is a folder.
pub fn open(path: &Path) -> Result<File, Failure> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    match file.metadata() {
        Ok(about) if about.is_dir() => Err(unreadable(path, &ErrorKind::IsADirectory.into())),
        _ => Ok(file),
    }
}

/// The failure of a file that can't be read.
pub fn unreadable(path: &Path, error: &io::Error) -> Failure {
    let (reason, next) = match error.kind() {
        ErrorKind::NotFound => ("there is no such file".into(), "Check the path and the folder you are in."),
        ErrorKind::IsADirectory => ("it is a folder, not a file".into(), "Name a file in it."),
        ErrorKind::PermissionDenied => ("you may not read it".into(), "Change its permissions, or name another file."),
        _ => (error.to_string(), "Name another file."),
    };
    Failure::input(format!("{}: {reason}", path.display()), next)
}
