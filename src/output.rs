//! Output files: written whole, or not at all. The command line and the window write by these.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// A file on its way: written under a temporary name in the folder of its final name, and put there in one step by
/// [`commit`](Self::commit). Until then, and when it is dropped, an older file of that name is as it was.
pub struct PendingFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

impl PendingFile {
    /// Begins a file that will be at `path`. Refused where no file can be written, and where something other than a file is.
    ///
    /// # Errors
    /// [`io::Error`] says why no file can be written there.
    pub fn create(path: &Path) -> io::Result<Self> {
        // through a symbolic link to the file itself
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let older = older_permissions(&path)?;
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let file = builder().prefix(".motion-lab-").tempfile_in(folder)?;
        if let Some(permissions) = older {
            file.as_file().set_permissions(permissions)?;
        }
        Ok(PendingFile { path, file: BufWriter::new(file) })
    }

    /// Puts the file in its place: on the disk first, then under its name.
    ///
    /// # Errors
    /// [`io::Error`] when the disk does not take it; whatever was there before still is.
    pub fn commit(self) -> io::Result<()> {
        let path = self.path.clone();
        self.commit_as(&path)
    }

    /// Puts the file under another name of the same folder.
    ///
    /// # Errors
    /// As [`commit`](Self::commit).
    pub fn commit_as(self, path: &Path) -> io::Result<()> {
        let file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.as_file().sync_all()?;
        file.persist(path).map_err(|error| error.error)?;
        sync_folder(path);
        Ok(())
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file.
///
/// # Errors
/// [`io::Error`] when it can't be written; whatever was there before still is.
pub fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = PendingFile::create(path)?;
    file.write_all(bytes)?;
    file.commit()
}

/// The permissions of the file at `path`; `None` when there is none. An error when it may not be written, or is no file.
fn older_permissions(path: &Path) -> io::Result<Option<fs::Permissions>> {
    match fs::metadata(path) {
        Ok(about) if about.is_file() => {
            OpenOptions::new().write(true).open(path)?;
            Ok(Some(about.permissions()))
        }
        Ok(about) if about.is_dir() => Err(ErrorKind::IsADirectory.into()),
        Ok(_) => Err(io::Error::other("it is a device or a pipe, not a file")),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Temporary files get the permissions of any new file, not the private ones that temporary files usually have.
fn builder() -> Builder<'static, 'static> {
    #[cfg_attr(not(unix), expect(unused_mut))]
    let mut builder = Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// Has the disk keep the new name. Some file systems can't; the file itself is safe by then.
fn sync_folder(path: &Path) {
    if let Some(Ok(folder)) = path.parent().map(File::open) {
        let _ = folder.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_there_whole_or_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f.txt");
        write_file(&path, b"one").unwrap();
        let mut pending = PendingFile::create(&path).unwrap();
        pending.write_all(b"two").unwrap();
        drop(pending);
        assert_eq!(fs::read(&path).unwrap(), b"one", "what was not committed leaves no trace");
        write_file(&path, b"three").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"three");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        assert_eq!(write_file(folder.path(), b"x").unwrap_err().kind(), ErrorKind::IsADirectory);
    }
}
