//! The gate that every input and every output of a command passes: no file is both, and none is written twice.
//!
//! An input is noted when it is opened, an output when its target is claimed, which a command does before it begins to
//! write; of the logs of many runs it then checks those that could be an input, and claims each before its run.
//! Whichever comes second is refused.

use std::collections::HashMap;
use std::ffi::OsString;
use std::fs::{self, File, Metadata};
use std::hash::Hash;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::output::resolved;
use motion_lab_sim::run::{Log, LogError};

use crate::cli::Failure;

/// The bytes in which a log says what it is.
const HEAD: u64 = 4096;

/// Whether a path is `-`, which names standard input or standard output.
pub fn is_dash(path: &Path) -> bool {
    path == Path::new("-")
}

/// An input's name for messages.
pub fn shown(path: &Path) -> String {
    if is_dash(path) { "standard input".to_owned() } else { path.display().to_string() }
}

/// What tells a file from all others, whatever it is called: device and inode.
type FileId = (u64, u64);

/// Where a file is or will be: its folder, and its name there.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct FilePlace {
    folder: Option<FileId>,
    name: OsString,
}

impl FilePlace {
    fn of(path: &Path) -> Self {
        let path = resolved(path);
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        match fs::metadata(folder).ok().and_then(|about| id_of(&about)) {
            Some(id) => {
                FilePlace { folder: Some(id), name: as_on_disk(path.file_name().unwrap_or_default().to_owned()) }
            }
            None => FilePlace { folder: None, name: as_on_disk(path.into_os_string()) },
        }
    }
}

/// The name in lower case on systems whose disks usually don't tell the cases apart.
pub fn as_on_disk(name: OsString) -> OsString {
    if cfg!(any(windows, target_os = "macos")) { name.to_ascii_lowercase() } else { name }
}

#[cfg(unix)]
fn id_of(about: &Metadata) -> Option<FileId> {
    use std::os::unix::fs::MetadataExt;
    Some((about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn id_of(_about: &Metadata) -> Option<FileId> {
    None
}

/// The regular file that a standard stream was redirected to.
#[cfg(unix)]
fn file_of(stream: &impl std::os::fd::AsFd) -> Option<FileId> {
    let about = File::from(stream.as_fd().try_clone_to_owned().ok()?).metadata().ok()?;
    if about.is_file() { id_of(&about) } else { None }
}

#[cfg(not(unix))]
fn file_of<S>(_stream: &S) -> Option<FileId> {
    None
}

/// Files, by what they are and by where they are, with the names that the user gave them.
#[derive(Debug, Default)]
struct FileSet {
    ids: HashMap<FileId, PathBuf>,
    places: HashMap<FilePlace, PathBuf>,
}

impl FileSet {
    fn add(&mut self, id: Option<FileId>, place: Option<FilePlace>, name: &Path) {
        self.ids.extend(id.map(|id| (id, name.to_owned())));
        self.places.extend(place.map(|place| (place, name.to_owned())));
    }

    fn find(&self, id: Option<FileId>, place: Option<&FilePlace>) -> Option<&PathBuf> {
        id.and_then(|id| self.ids.get(&id)).or_else(|| place.and_then(|place| self.places.get(place)))
    }
}

/// What this process reads and writes.
#[derive(Debug, Default)]
struct Gate {
    inputs: FileSet,
    /// The outputs that are claimed and not yet written.
    claimed: FileSet,
    /// The places that were written.
    written: FileSet,
}

static GATE: Mutex<Option<Gate>> = Mutex::new(None);

/// Whether an output goes to standard output, which then holds nothing else.
static STDOUT_IS_TAKEN: AtomicBool = AtomicBool::new(false);

/// Whether a log may be replaced by something else.
static FORCED: AtomicBool = AtomicBool::new(false);

/// Lets outputs replace logs, whatever they are.
pub fn force() {
    FORCED.store(true, Ordering::Relaxed);
}

fn with_gate<T>(work: impl FnOnce(&mut Gate) -> T) -> T {
    let mut gate: MutexGuard<'_, Option<Gate>> = GATE.lock().unwrap_or_else(PoisonError::into_inner);
    work(gate.get_or_insert_default())
}

/// Whether an output goes to standard output, which then holds nothing else.
pub fn stdout_is_taken() -> bool {
    STDOUT_IS_TAKEN.load(Ordering::Relaxed)
}

/// Claims standard output for one output.
///
/// # Errors
/// [`Failure::Usage`] for a second one.
pub fn claim_stdout() -> Result<(), Failure> {
    if STDOUT_IS_TAKEN.swap(true, Ordering::Relaxed) {
        return Err(Failure::usage("-: two outputs can't both go to standard output", "Name a file for one of them."));
    }
    Ok(())
}

/// Notes that standard input is read.
///
/// # Errors
/// [`Failure::Usage`] where it is a file that an output was claimed for.
pub fn read_stdin() -> Result<(), Failure> {
    note_input(file_of(&std::io::stdin()), None, Path::new("-"))
}

/// Notes that this file, opened, is read.
///
/// # Errors
/// [`Failure::Usage`] where an output was claimed for it.
pub fn read(path: &Path, file: &File) -> Result<(), Failure> {
    match file.metadata() {
        Ok(about) if about.is_file() => note_input(id_of(&about), Some(FilePlace::of(path)), path),
        _ => Ok(()),
    }
}

fn note_input(id: Option<FileId>, place: Option<FilePlace>, name: &Path) -> Result<(), Failure> {
    let claimed = with_gate(|gate| {
        let claimed = gate.claimed.find(id, place.as_ref()).cloned();
        gate.inputs.add(id, place, name);
        claimed
    });
    let stdout = || (id.is_some() && id == file_of(&std::io::stdout())).then(|| PathBuf::from("-"));
    match claimed.or_else(stdout) {
        Some(output) => Err(both(&output, name)),
        None => Ok(()),
    }
}

/// The failure of a file that is both an output and an input.
fn both(output: &Path, input: &Path) -> Failure {
    let written = if is_dash(output) { "standard output".to_owned() } else { shown(output) };
    Failure::usage(
        format!("{written}: this output is the same file as the input {}", shown(input)),
        "Name another file; this one is as it was.",
    )
}

/// What may be done with a file that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// A log, which may replace another.
    Log,
    /// Anything else, which replaces no log.
    Other,
}

impl Gate {
    /// Why a file is no output: it is an input, another output or standard output.
    fn refusal(&self, output: &Path, id: Option<FileId>, place: &FilePlace) -> Option<Failure> {
        if let Some(input) = self.inputs.find(id, Some(place)) {
            return Some(both(output, input));
        }
        if let Some(other) = self.claimed.find(id, Some(place)).or_else(|| self.written.find(None, Some(place))) {
            return Some(twice(output, &shown(other)));
        }
        (id.is_some() && id == file_of(&std::io::stdout())).then(|| twice(output, "standard output"))
    }
}

/// The regular file of this name, if there is one, and its place.
fn file_at(output: &Path) -> (Option<Metadata>, FilePlace) {
    (fs::metadata(output).ok().filter(Metadata::is_file), FilePlace::of(output))
}

/// Refuses an output as [`claim`] would, and claims nothing.
///
/// # Errors
/// [`Failure::Usage`] where it is the same file as an input, as another output or as standard output, by whatever name.
pub fn check(output: &Path) -> Result<(), Failure> {
    let (about, place) = file_at(output);
    let refused = with_gate(|gate| gate.refusal(output, about.as_ref().and_then(id_of), &place));
    refused.map_or(Ok(()), Err)
}

/// Claims a file for an output.
///
/// # Errors
/// [`Failure::Usage`] where it is the same file as an input, as another output or as standard output, by whatever name;
/// where it is a log and the output is none.
pub fn claim(output: &Path, kind: OutputKind) -> Result<(), Failure> {
    let (about, place) = file_at(output);
    let id = about.as_ref().and_then(id_of);
    let refused = with_gate(|gate| {
        let refused = gate.refusal(output, id, &place);
        if refused.is_none() {
            gate.claimed.add(id, Some(place), output);
        }
        refused
    });
    match refused {
        Some(refused) => Err(refused),
        None if about.is_some() && kind == OutputKind::Other => spare_log(output),
        None => Ok(()),
    }
}

/// The failure of a file that two outputs would be.
fn twice(output: &Path, other: &str) -> Failure {
    Failure::usage(
        format!("{}: it is named twice, also as {other}", output.display()),
        "Give each output a file of its own; this one is as it was.",
    )
}

/// Notes that a claimed output was written, so that the same command may read it.
pub fn written(output: &Path) {
    let place = FilePlace::of(output);
    with_gate(|gate| {
        gate.claimed.ids.retain(|_, name| name != output);
        if let Some(name) = gate.claimed.places.remove(&place) {
            gate.written.add(None, Some(place), &name);
        }
    });
}

/// Forgets an output, written or not: another one may be this file.
pub fn release(output: &Path) {
    let place = FilePlace::of(output);
    with_gate(|gate| {
        gate.claimed.ids.retain(|_, name| name != output);
        gate.claimed.places.remove(&place);
        gate.written.places.remove(&place);
    });
}

/// Refuses a file that is a log, unless `--force` is given.
fn spare_log(output: &Path) -> Result<(), Failure> {
    if FORCED.load(Ordering::Relaxed) || !is_log(output) {
        return Ok(());
    }
    Err(Failure::usage(
        format!("{}: it is a log, and this output is none", output.display()),
        "Name another file, or replace the log by --force; it is as it was.",
    ))
}

/// Whether a file is a log, whole or damaged, by its beginning. A file for viewers is none.
fn is_log(path: &Path) -> bool {
    use std::io::Read;
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.is_ok()
        && head.len() >= 8
        && !matches!(Log::read_mcap(&head), Err(LogError::NotALog | LogError::Export | LogError::Page(_)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::support::output::ReportedFile;
    use crate::cli::support::target::{Target, partial_name};

    /// A folder of which the gate knows nothing when it is gone: a later file may get the number of one in it.
    struct PassingNames(tempfile::TempDir);

    impl PassingNames {
        fn new() -> Self {
            PassingNames(tempfile::tempdir().unwrap())
        }

        fn file(&self, name: &str) -> PathBuf {
            self.0.path().join(name)
        }

        /// How many names in it the gate knows.
        fn known(&self) -> usize {
            let is_here = |name: &&PathBuf| name.starts_with(self.0.path());
            let of = |files: &FileSet| files.ids.values().chain(files.places.values()).filter(is_here).count();
            with_gate(|gate| [&gate.inputs, &gate.claimed, &gate.written].map(of).iter().sum())
        }
    }

    impl Drop for PassingNames {
        fn drop(&mut self) {
            with_gate(|gate| {
                for files in [&mut gate.inputs, &mut gate.claimed, &mut gate.written] {
                    files.ids.retain(|_, name| !name.starts_with(self.0.path()));
                    files.places.retain(|_, name| !name.starts_with(self.0.path()));
                }
            });
        }
    }

    #[test]
    fn a_log_that_is_released_is_forgotten_whatever_came_of_it() {
        let folder = PassingNames::new();
        let log = |number: u32| folder.file(&format!("{number}.mcap"));
        for replacing in [2, 3] {
            fs::write(log(replacing), "an older file").unwrap();
        }
        for number in 0..4 {
            let target = Target::log(&log(number)).unwrap();
            assert!(folder.known() >= 2, "the log and its unfinished name");
            assert!(Target::log(&log(number)).is_err() && Target::check_log(&log(number)).is_err());
            if [1, 2].contains(&number) {
                fs::write(log(number), "whole").unwrap();
                written(&log(number));
                assert!(Target::log(&log(number)).is_err(), "it was written");
            }
            target.release();
            assert_eq!(folder.known(), 0, "{number}");
        }
        Target::log(&log(0)).unwrap().release();
    }

    #[test]
    fn a_log_that_is_whole_leaves_its_unfinished_name_free() {
        let folder = PassingNames::new();
        let log = folder.file("run.mcap");
        let target = Target::log(&log).unwrap();
        assert!(check(&partial_name(&log)).is_err());
        ReportedFile::create(&target).unwrap().commit().unwrap();
        assert!(check(&partial_name(&log)).is_ok() && check(&log).is_err());
        assert_eq!(folder.known(), 1);
    }

    #[test]
    fn a_check_claims_nothing() {
        let folder = PassingNames::new();
        let log = folder.file("run.mcap");
        Target::check_log(&log).unwrap();
        assert_eq!(folder.known(), 0);
        let input = folder.file("run.mcap.partial");
        fs::write(&input, "World()").unwrap();
        read(&input, &File::open(&input).unwrap()).unwrap();
        assert!(Target::check_log(&log).is_err());
        assert!(check(&log).is_ok());
    }
}
