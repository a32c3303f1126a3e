//! Writing output files: whole, or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::Failure;

/// A file on its way: written under a temporary name in the folder of its final name, and put there in one step by
/// [`commit`](Self::commit). Until then, and when it is dropped, an older file of that name is as it was.
pub struct PendingFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

impl PendingFile {
    /// Begins a file that will be at `path`. Refused where no file can be written, and where something other than a file is.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let begin = || -> io::Result<Self> {
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
        };
        begin().map_err(|error| Failure::output(path, &error))
    }

    /// Puts the file in its place: on the disk first, then under its name.
    pub fn commit(self) -> Result<(), Failure> {
        let path = self.path.clone();
        self.commit_as(&path)
    }

    /// Puts the file under another name of the same folder.
    pub fn commit_as(self, path: &Path) -> Result<(), Failure> {
        let file = self.file;
        let finish = || -> io::Result<()> {
            let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
            file.as_file().sync_all()?;
            file.persist(path).map_err(|error| error.error)?;
            sync_folder(path);
            Ok(())
        };
        finish().map_err(|error| Failure::output(path, &error))
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
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut file = PendingFile::create(path)?;
    file.write_all(bytes).map_err(|error| Failure::output(path, &error))?;
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
