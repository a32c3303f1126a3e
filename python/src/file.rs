//! Files: read within a limit, written whole or not at all.

use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

/// Largest script or assignment that is read, bytes.
pub const MAX_TEXT: u64 = 64 << 20;

/// The error of a file as Python's own functions raise it: a `FileNotFoundError` with the file's name.
pub fn os_error(error: &io::Error, path: &Path) -> PyErr {
    match error.raw_os_error() {
        // Rust's words end with the number, which Python adds itself
        Some(number) => {
            let words = error.to_string();
            let words = words.split(" (os error").next().unwrap_or_default().to_owned();
            PyOSError::new_err((number, words, path.display().to_string()))
        }
        None => PyOSError::new_err(format!("{}: {error}", path.display())),
    }
}

/// The text of a file of at most `most` bytes; else, in words, why it is not `what`.
///
/// # Errors
/// `OSError` for a file that cannot be read.
pub fn text_of(py: Python<'_>, path: &Path, what: &str, most: u64) -> PyResult<Result<String, String>> {
    let mut bytes = Vec::new();
    let read = py.detach(|| fs::File::open(path)?.take(most + 1).read_to_end(&mut bytes));
    read.map_err(|error| os_error(&error, path))?;
    let shown = path.display();
    if bytes.len() as u64 > most {
        return Ok(Err(format!("{shown}: {what} has at most {most} bytes")));
    }
    Ok(String::from_utf8(bytes).map_err(|_| format!("{shown}: the file is not UTF-8 text")))
}

/// Writes a file whole, in place of an older one: whoever reads it meanwhile finds the older one.
///
/// # Errors
/// `OSError`; an older file is still there.
pub fn replace(py: Python<'_>, path: &Path, bytes: &[u8]) -> PyResult<()> {
    py.detach(|| write_beside(path, bytes)).map_err(|error| os_error(&error, path))
}

fn write_beside(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // a pipe or a device has no older content, and nothing may take its place
    if fs::metadata(path).is_ok_and(|about| !about.is_file()) {
        return fs::write(path, bytes);
    }
    // a link stays a link
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.partial", std::process::id()));
    let beside = path.with_file_name(name);
    let written = fs::File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let moved = written.and_then(|()| fs::rename(&beside, path));
    if moved.is_err() {
        // the reason why it failed says more than that nothing could be removed
        let _ = fs::remove_file(&beside);
    }
    moved
}
