//! Output files, written whole or not at all. The command line and the window write with these.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile, TempDir};

/// A file under construction. It is written under a temporary name in the folder of its final name;
/// [`commit`](Self::commit) renames it in one step. Until then, and when it is dropped, an older file of the final name
/// stays as it was.
///
/// The temporary name is the final one, shortened if it is long, with a dot before it and `.XXXXXX.unfinished` after
/// it. A killed process leaves the file, and [`unfinished`] finds it.
pub struct PendingFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
    begun: Begun,
}

impl PendingFile {
    /// Begins a file that will be at `path`. A folder, device or pipe at `path` is refused, and so is a file that can't
    /// be written.
    ///
    /// # Errors
    /// [`io::Error`] gives the reason.
    pub fn create(path: &Path) -> io::Result<Self> {
        let path = resolved(path);
        let older = older_permissions(&path)?;
        let mut prefix = OsString::from(".");
        prefix.push(shortened(path.file_name().unwrap_or_default()));
        prefix.push(".");
        let (file, begun) = Begun::begin(
            || builder().prefix(&prefix).suffix(SUFFIX).tempfile_in(folder_of(&path)).map_err(plain),
            NamedTempFile::path,
        )?;
        // The lock lasts until the file is closed or the process ends. By it other processes tell the file from one
        // that a killed process left. On systems without locks they can't.
        let _ = file.as_file().lock();
        if let Some(permissions) = older {
            file.as_file().set_permissions(permissions)?;
        }
        Ok(PendingFile { path, file: BufWriter::new(file), begun })
    }

    /// Lets [`abandon_all`] keep the file as `path`, in the same folder, where there is no file of this name.
    pub fn keep_when_abandoned(&self, path: &Path) {
        let own = &self.begun.0;
        begun_here().iter_mut().filter(|(file, _)| file == own).for_each(|(_, kept)| *kept = Some(path.to_owned()));
    }

    /// Writes the file to the disk, then gives it its final name.
    ///
    /// # Errors
    /// [`io::Error`] when the disk does not take it. A file that was there before then stays.
    pub fn commit(mut self) -> io::Result<()> {
        self.sync()?;
        let path = self.path.clone();
        self.keep_as(&path)
    }

    /// Writes everything so far to the disk.
    ///
    /// # Errors
    /// [`io::Error`] when the disk does not take it.
    pub fn sync(&mut self) -> io::Result<()> {
        self.file.flush().map_err(plain)?;
        self.file.get_ref().as_file().sync_all()
    }

    /// Gives the file another name in the same folder, with the bytes that have reached it. Bytes still buffered, as
    /// after a failed write, are lost.
    ///
    /// # Errors
    /// [`io::Error`] when the file can't be renamed. It then stays under its temporary name, which the error names.
    pub fn keep_as(self, path: &Path) -> io::Result<()> {
        let (file, _) = self.file.into_parts();
        if let Err(refused) = file.persist(path) {
            let (_, left) = refused.file.keep().map_err(|error| error.error)?;
            return Err(io::Error::other(format!("{}; what was written is in {}", refused.error, left.display())));
        }
        sync_folder(path);
        Ok(())
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes).map_err(plain)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush().map_err(plain)
    }
}

/// The files and folders that this process has begun and not ended; of a file also the name to keep it by.
static BEGUN: Mutex<Vec<(PathBuf, Option<PathBuf>)>> = Mutex::new(Vec::new());

fn begun_here() -> MutexGuard<'static, Vec<(PathBuf, Option<PathBuf>)>> {
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The path of a file or folder in [`BEGUN`], which is taken from there with it.
struct Begun(PathBuf);

impl Begun {
    /// What `make` makes, at the path that `path_of` says.
    fn begin<T>(make: impl FnOnce() -> io::Result<T>, path_of: impl FnOnce(&T) -> &Path) -> io::Result<(T, Self)> {
        let mut begun = begun_here();
        let made = make()?;
        let path = path_of(&made).to_owned();
        begun.push((path.clone(), None));
        Ok((made, Begun(path)))
    }
}

impl Drop for Begun {
    fn drop(&mut self) {
        begun_here().retain(|(path, _)| *path != self.0);
    }
}

/// A temporary folder, for files that are passed on. It goes when it is dropped, and by [`abandon_all`].
pub struct PassingFolder {
    folder: TempDir,
    _begun: Begun,
}

impl PassingFolder {
    /// Makes the folder.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be made.
    pub fn new() -> io::Result<Self> {
        let (folder, begun) = Begun::begin(TempDir::new, TempDir::path)?;
        Ok(PassingFolder { folder, _begun: begun })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Ends the process at once, with this exit code. Its files under construction are taken away first, but for those
/// that [`keep_when_abandoned`](PendingFile::keep_when_abandoned) gives a name. No other file is touched.
pub fn abandon_all(code: i32) -> ! {
    // the lock is kept to the end, so that no file is begun meanwhile
    let begun = begun_here();
    for (path, kept) in begun.iter() {
        match kept {
            Some(kept) if !kept.exists() => _ = fs::rename(path, kept),
            _ if path.is_dir() => _ = fs::remove_dir_all(path),
            _ => _ = fs::remove_file(path),
        }
    }
    std::process::exit(code)
}

/// Most links that are followed one after the other.
const MAX_LINKS: usize = 40;

/// The place that a path names: symbolic links are followed, also to a file that is not there yet, and the folder is
/// spelled in the one way that the system has for it.
pub fn resolved(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        let Ok(to) = fs::read_link(&path) else { break };
        path = folder_of(&path).join(to);
    }
    if let Ok(there) = fs::canonicalize(&path) {
        return there;
    }
    match (fs::canonicalize(folder_of(&path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path,
    }
}

/// The end of a temporary name.
const SUFFIX: &str = ".unfinished";

/// A name cut to at most 200 bytes, so that the temporary name fits into 255. A name that is not UTF-8 is not cut.
fn shortened(name: &OsStr) -> &OsStr {
    match name.to_str() {
        Some(text) => OsStr::new(&text[..text.floor_char_boundary(200)]),
        None => name,
    }
}

/// The error without the temporary name.
fn plain(error: io::Error) -> io::Error {
    error.kind().into()
}

/// The number of characters that make a temporary name unique, a dot before them.
const UNIQUE: usize = 6;

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The files that killed processes left in the folder of `path`, in the order of their names. Where the system has
/// locks, files that a process is still writing are left out.
///
/// # Errors
/// [`io::Error`] when the folder can't be read.
pub fn unfinished(path: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let output = resolved(path);
    for entry in fs::read_dir(folder_of(&output))? {
        let path = folder_of(&output).join(entry?.file_name());
        if is_temporary(&path) && is_left(&path)? {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Whether no process is writing the file any more. `false` is inconclusive on systems without locks.
///
/// # Errors
/// [`io::Error`] when the file can't be opened.
pub fn is_left(path: &Path) -> io::Result<bool> {
    // a shared lock, so that two callers don't block one another
    Ok(File::open(path)?.try_lock_shared().is_ok())
}

/// The final name of a temporary file. For another name that ends in `.partial` it is the name without that ending,
/// else `None`.
pub fn whole_name(path: &Path) -> Option<PathBuf> {
    let whole = path.with_extension("");
    if is_temporary(path) {
        let name = whole.file_stem()?.to_str()?.strip_prefix('.')?;
        return Some(path.with_file_name(name));
    }
    path.extension().is_some_and(|extension| extension == "partial").then_some(whole)
}

/// Whether a name has the form of a temporary name.
pub fn is_temporary(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let unique =
        name.strip_prefix('.').and_then(|name| name.strip_suffix(SUFFIX)).and_then(|name| name.rsplit_once('.'));
    unique.is_some_and(|(name, unique)| {
        !name.is_empty() && unique.len() == UNIQUE && unique.bytes().all(|b| b.is_ascii_alphanumeric())
    })
}

/// Writes a whole file.
///
/// # Errors
/// [`io::Error`] when it can't be written. A file that was there before then stays.
pub fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = PendingFile::create(path)?;
    file.write_all(bytes)?;
    file.commit()
}

/// The permissions of the file at `path`; `None` for no file. An error when the file may not be written, or something
/// else is there.
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

/// Writes the new name to the disk. Some file systems can't; the file itself is safe by then.
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

    #[test]
    fn what_a_killed_process_left_is_found_and_what_is_being_written_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.mcap");
        let mut pending = PendingFile::create(&path).unwrap();
        pending.write_all(b"one").unwrap();
        pending.flush().unwrap();
        let entry = fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
        let found = unfinished(&path).unwrap();
        #[cfg(unix)]
        assert!(found.is_empty(), "{found:?}");
        // as if killed: the name stays and the lock goes
        let (file, _) = pending.file.into_parts();
        file.keep().unwrap();
        for other in [
            "run.mcap.partial",
            ".hidden",
            ".run.mcap.a.unfinished",
            "..abcdef.unfinished",
            ".run.mcap.abcde-.unfinished",
        ] {
            fs::write(folder.path().join(other), b"").unwrap();
        }
        let name = entry.file_name().unwrap().to_str().unwrap();
        assert!(name.starts_with(".run.mcap.") && name.ends_with(".unfinished"), "{name}");
        assert_eq!(unfinished(&path).unwrap(), [&*entry]);
        assert_eq!(fs::read(&entry).unwrap(), b"one");
        assert_eq!(whole_name(&entry), Some(path.clone()));
        assert_eq!(whole_name(&folder.path().join("run.mcap.partial")), Some(path.clone()));
        assert_eq!(whole_name(&path), None);
        let hidden = folder.path().join(".run.backup");
        assert_eq!(whole_name(&hidden.with_extension("backup.partial")), Some(hidden));
        // two bytes a character: cut between two of them
        let long = folder.path().join("\u{e9}".repeat(127));
        write_file(&long, b"long").unwrap();
        assert_eq!(fs::read(&long).unwrap(), b"long");
    }
}
