//! Files, written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use pyo3::prelude::*;

use crate::world::os_error;

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
