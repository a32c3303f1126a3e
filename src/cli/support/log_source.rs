//! A log named on the command line.

use std::fmt;
use std::fs::{self, File};
use std::io::Read as _;
use std::path::Path;

use clap::Args;
use motion_lab_sim::plans::{MAX_PATH_BYTES, PathFile};
use motion_lab_sim::run::{DamageKind, Digest, Log, LogError, LogKind, ReadLog};

use super::input::{read_bytes_if, shown};
use super::progress::CommandProgress;
use crate::cli::{Failure, say};

/// Largest size of a log file, bytes.
pub const MAX_LOG: u64 = 4 << 30;

/// A log from a file, or its sealed beginning.
pub struct LogSource {
    /// The log.
    pub log: Log,
    /// The program that wrote it, with its version.
    pub program: String,
    /// The run's digest that its end seals; `None` without one.
    pub sealed: Option<Digest>,
    /// The damage to the file, if it is not whole.
    pub damage: Option<LogDamage>,
}

/// The damage to a log's file.
pub struct LogDamage {
    /// What is wrong with the file, by its name.
    pub words: String,
    kind: DamageKind,
}

impl fmt::Display for LogDamage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl LogDamage {
    /// What to do about it. A recording that was cut off goes on; one that somebody changed is not made whole as if it
    /// were the one that was recorded.
    pub fn next(&self) -> &'static str {
        match self.kind {
            DamageKind::Cut => "`motion-lab record --resume` makes it whole.",
            _ => "Do not trust what comes after: ask for the log as it was recorded.",
        }
    }
}

/// Least size of a log whose reading shows how far it has come, bytes.
const LONG: usize = 2 << 20;

/// Says what is wrong with a log that is not whole, and what was done with its sealed beginning: `compared`.
pub fn say_damage(damage: Option<&LogDamage>, done: &str) {
    if let Some(damage) = damage {
        say(format!("{damage}\nThis much is {done}. {}", damage.next()));
    }
}

/// Whether a file may be a log, by its first eight bytes. Any other file is read no farther, however long it is.
pub fn begins_as_one(beginning: &[u8]) -> bool {
    !matches!(Log::read_mcap(beginning), Err(LogError::NotALog))
}

/// Reads a log with frames, as [`read_log`].
pub fn read_full_log(path: &Path) -> Result<LogSource, Failure> {
    let source = read_log(path)?;
    if source.log.kind() == LogKind::Frames { Ok(source) } else { Err(refused(path, &LogError::NoFrames)) }
}

/// Reads a log; of a damaged or unfinished file, its sealed beginning. Fails when not even that can be used, and where
/// the end seals the digest of another run.
pub fn read_log(path: &Path) -> Result<LogSource, Failure> {
    read(path, |error| Err(refused(path, &error)))
}

/// Reads a log as [`read_log`], also one whose end seals the digest of another run, which `sealed` then is.
pub fn read_claimed_log(path: &Path) -> Result<LogSource, Failure> {
    read(path, |error| match error {
        LogError::OtherRun(other) => Ok(LogSource::of(other.read, None)),
        error => Err(refused(path, &error)),
    })
}

/// Reads a log; of a damaged or unfinished file, its sealed beginning. Any other error is for `otherwise`.
fn read(path: &Path, otherwise: impl FnOnce(LogError) -> Result<LogSource, Failure>) -> Result<LogSource, Failure> {
    let bytes = read_bytes_if(path, MAX_LOG, begins_as_one)?;
    let progress =
        if bytes.len() < LONG { CommandProgress::none() } else { CommandProgress::of_bytes(bytes.len() as u64) };
    match Log::read_mcap_with(&bytes, |checked| progress.at(checked)) {
        Ok(read) => Ok(LogSource::of(read, None)),
        Err(LogError::Damaged(damaged)) => {
            let damage = LogDamage { words: format!("{}: {damaged}", shown(path)), kind: damaged.kind };
            match damaged.recovered {
                Some(read) => Ok(LogSource::of(read, Some(damage))),
                None => Err(Failure::input(damage, "Record the run again.")),
            }
        }
        Err(error) => otherwise(error),
    }
}

impl LogSource {
    fn of(read: ReadLog, damage: Option<LogDamage>) -> Self {
        let ReadLog { log, program, sealed, .. } = read;
        LogSource { log, program, sealed, damage }
    }
}

/// The run digests of which a log should have one.
#[derive(Debug, Args)]
pub struct ExpectedDigests {
    /// The run digest that a log must have, as `record` printed it when the run was honest: whoever changes a log can
    /// seal it again, but not with this digest. Given several times, each log must have one of them.
    #[arg(long = "expect", value_name = "DIGEST")]
    digests: Vec<Digest>,
}

impl ExpectedDigests {
    /// Whether any is expected.
    pub fn is_any(&self) -> bool {
        !self.digests.is_empty()
    }

    /// Why a log with this run digest is not what is expected.
    pub fn refusal(&self, found: Digest) -> Option<String> {
        let expected: Vec<String> = self.digests.iter().map(ToString::to_string).collect();
        let is_expected = expected.is_empty() || self.digests.contains(&found);
        (!is_expected).then(|| {
            let expected = expected.join(" or ");
            format!(
                "the run digest is {found}, expected {expected}: seed, settings, worlds, script or frames are others"
            )
        })
    }
}

/// The digest of a log with frames.
pub fn digest_of(log: &Log) -> Result<Digest, Failure> {
    log.digest().ok_or_else(|| Failure::internal(LogError::NoFrames))
}

/// The failure of a file that is no log and that is known for what it is: a path, a sweep's table or part, a world, a
/// script. `None` for any other.
pub fn other_file(path: &Path) -> Option<Failure> {
    let about = fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
    let mut beginning = Vec::new();
    File::open(path).ok()?.take(4096).read_to_end(&mut beginning).ok()?;
    let beginning = String::from_utf8_lossy(&beginning);
    let is_small = about.len() <= MAX_PATH_BYTES as u64;
    let is_path = || is_small && fs::read_to_string(path).is_ok_and(|text| PathFile::read(&text).is_ok());
    let file = shown(path);
    let (what, next) = if beginning.trim_start().starts_with('{') && is_path() {
        let next = "The window shows it: *Open a path* in Plan judges it by the exact scene. `motion-lab plan --record \
            RUN.mcap` makes the log of a run that plays a path.";
        ("a path, not a run log", next.to_owned())
    } else if beginning.starts_with("PAR1") {
        ("a table, not a run log", format!("Prove a sweep's table: motion-lab sweep verify {file}"))
    } else if beginning.starts_with("motion-lab sweep part ") {
        ("a part of a sweep, not a run log", format!("Prove it: motion-lab sweep verify {file}"))
    } else if path.extension().is_some_and(|ending| ending == "ron") {
        let next = format!("Check a world: motion-lab world check {file}. A script: motion-lab script check {file}.");
        ("a text in RON, as a world or a script is, not a run log", next)
    } else {
        return None;
    };
    Some(Failure::input(format!("{file}: this is {what}"), next))
}

fn refused(path: &Path, error: &LogError) -> Failure {
    if let (LogError::NotALog, Some(other)) = (error, other_file(path)) {
        return other;
    }
    let file = shown(path);
    let next = match error {
        LogError::NotALog => "Name a file that `motion-lab record -o` wrote.".to_owned(),
        LogError::Page(_) => "Name a page that *Save as page* of the lab wrote, or a log.".to_owned(),
        LogError::Export => "Name the log that it was exported from.".to_owned(),
        LogError::Version(_) => "Read it with the motion-lab that wrote it.".to_owned(),
        LogError::NoFrames => format!("Make the frames from it: motion-lab replay {file} --log full -o FULL.mcap"),
        LogError::OtherRun(_) => "Do not trust what is in it: ask for the log as it was recorded.".to_owned(),
        _ => "Record the run again.".to_owned(),
    };
    Failure::input(format!("{file}: {error}"), next)
}
