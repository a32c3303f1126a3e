//! `Slot`, the files of this process's run under way, and those that other processes have left.

use super::settings::PROGRAM;
use bevy::platform::dirs::preferences_dir;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use crate::output::{unfinished, write_file};

/// The folder of the runs under way; `None` where the system has no place for settings.
pub fn folder_of_runs() -> Option<PathBuf> {
    Some(preferences_dir()?.join(PROGRAM).join("runs"))
}

/// File extension of a run under way.
const RUN: &str = "run";

/// File extension of the file that a process has locked while it lives.
const LOCK: &str = "lock";

/// The files of one window of one process: the run under way, and a file that is locked while the process lives. The
/// lock ends with the process, however it ends, so others tell a run that was left from one that still goes on.
pub struct Slot {
    run: PathBuf,
    /// Closed when the slot is dropped, which ends the lock.
    _lock: File,
}

impl Slot {
    /// Takes a name that nobody has, for a window of the process with this number.
    ///
    /// # Errors
    /// [`io::Error`] when the folder can't be made or written, or knows no locks.
    pub fn take(folder: &Path, process: u32) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        // the number of a process that ended may come again
        for number in 0..1000 {
            let run = folder.join(format!("{process}-{number}.{RUN}"));
            let lock = match OpenOptions::new().write(true).create_new(true).open(run.with_extension(LOCK)) {
                Ok(lock) => lock,
                Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
                Err(error) => return Err(error),
            };
            if run.exists() {
                drop(lock);
                fs::remove_file(run.with_extension(LOCK))?;
                continue;
            }
            lock.lock()?;
            return Ok(Slot { run, _lock: lock });
        }
        Err(ErrorKind::AlreadyExists.into())
    }

    /// Writes the run, whole or not at all.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be written.
    pub fn write(&self, bytes: &[u8]) -> io::Result<()> {
        write_file(&self.run, bytes)
    }

    /// Takes the run's file away; the name stays taken.
    pub fn clear(&self) {
        let _ = fs::remove_file(&self.run);
    }

    /// Gives the name back at the ordinary end. A run that was written stays.
    pub fn release(self) {
        let lock = self.run.with_extension(LOCK);
        drop(self);
        let _ = fs::remove_file(lock);
    }
}

/// Age from which on a lock without a run is taken away. A process that is about to lock one has made it a moment ago.
const STALE: Duration = Duration::from_secs(3600);

/// Takes away the locks of processes that ended without a word and without a run.
pub fn remove_stale_locks(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let made = fs::metadata(&path).and_then(|about| about.modified());
        let is_old = made.is_ok_and(|made| made.elapsed().is_ok_and(|age| age > STALE));
        let is_bare = path.extension().is_some_and(|e| e == LOCK) && !path.with_extension(RUN).exists();
        if is_bare && is_old && !is_alive(&path) {
            let _ = fs::remove_file(&path);
        }
    }
}

/// The runs that processes left which no longer live, the newest first.
pub fn left_behind(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let runs = paths.filter(|path| path.extension().is_some_and(|e| e == RUN) && !is_alive(path));
    let mut found: Vec<(SystemTime, PathBuf)> =
        runs.filter_map(|path| Some((fs::metadata(&path).and_then(|about| about.modified()).ok()?, path))).collect();
    found.sort();
    found.into_iter().rev().map(|(_, path)| path).collect()
}

/// Whether the process of this run still lives, as far as the system can say.
fn is_alive(run: &Path) -> bool {
    match File::open(run.with_extension(LOCK)) {
        Ok(lock) => lock.try_lock().is_err(),
        Err(error) => error.kind() != ErrorKind::NotFound,
    }
}

/// Takes away a run that was left, and all that belongs to it.
pub fn forget(run: &Path) {
    for left in unfinished(run).unwrap_or_default() {
        let _ = fs::remove_file(left);
    }
    let _ = fs::remove_file(run);
    let _ = fs::remove_file(run.with_extension(LOCK));
}

/// Puts a run that can't be brought back aside, under a name that nobody looks for. Returns where it is.
pub fn move_away(run: &Path) -> PathBuf {
    let aside = run.with_extension("damaged");
    let _ = fs::remove_file(run.with_extension(LOCK));
    if fs::rename(run, &aside).is_ok() { aside } else { run.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_window_takes_the_files_of_another() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (Slot::take(folder.path(), 7).unwrap(), Slot::take(folder.path(), 7).unwrap());
        a.write(b"a").unwrap();
        b.write(b"b").unwrap();
        assert_ne!(a.run, b.run);
        assert!(left_behind(folder.path()).is_empty(), "both live");
        // one ends without a word, and its number comes again
        let left = a.run.clone();
        drop(a);
        assert_eq!(left_behind(folder.path()), [&*left]);
        let again = Slot::take(folder.path(), 7).unwrap();
        again.write(b"again").unwrap();
        assert_eq!(fs::read(&left).unwrap(), b"a");
        assert_eq!(fs::read(&b.run).unwrap(), b"b");
        assert_eq!(left_behind(folder.path()), [&*left]);
        forget(&left);
        // given back with its run, given back without
        let kept = b.run.clone();
        b.release();
        again.clear();
        again.release();
        assert_eq!(left_behind(folder.path()), [&*kept]);
        let there: Vec<PathBuf> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().path()).collect();
        assert_eq!(there, [&*kept], "nothing else is left");
        // a run without its lock, whose number comes again
        let next = Slot::take(folder.path(), 7).unwrap();
        assert_ne!(next.run, kept);
    }

    #[test]
    fn only_old_locks_of_nobody_and_without_a_run_are_swept() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let aged = |name: &str, age: u64| {
            let file = File::create(at(name)).unwrap();
            file.set_modified(SystemTime::now() - Duration::from_secs(age)).unwrap();
            file
        };
        for (name, age) in [("1-0.lock", 7200), ("2-0.lock", 60), ("3-0.lock", 7200), ("3-0.run", 7200)] {
            aged(name, age);
        }
        let held = aged("4-0.lock", 7200);
        held.lock().unwrap();
        remove_stale_locks(folder.path());
        let left = ["1-0.lock", "2-0.lock", "3-0.lock", "3-0.run", "4-0.lock"].map(|name| at(name).exists());
        assert_eq!(left, [false, true, true, true, true]);
        drop(held);
    }

    #[test]
    fn what_was_left_is_listed_from_the_newest() {
        let folder = tempfile::tempdir().unwrap();
        for (age, name) in [(50, "1-0.run"), (10, "2-0.run"), (90, "3-0.run"), (0, "4-0.lock"), (0, "5-0.damaged")] {
            let file = File::create(folder.path().join(name)).unwrap();
            file.set_modified(SystemTime::now() - Duration::from_secs(age)).unwrap();
        }
        let names: Vec<_> = left_behind(folder.path()).iter().map(|p| p.file_name().unwrap().to_owned()).collect();
        assert_eq!(names, ["2-0.run", "1-0.run", "3-0.run"]);
        assert!(left_behind(&folder.path().join("none")).is_empty());
    }
}
