//! A log named on the command line.

use std::path::Path;

use motion_lab::run::{DigestLog, Log, LogError, ReadDigestLog, ReadLog};

use super::input::{read_bytes_if, shown};
use super::log_kind::AnyLog;
use super::progress::Progress;
use crate::cli::{Failure, say};

/// Largest size of a log file, bytes.
pub const MAX_LOG: u64 = 4 << 30;

/// A log from a file, or its sealed beginning.
pub struct LogSource {
    /// The log.
    pub read: ReadLog,
    /// The damage to the file, if it is not whole.
    pub damage: Option<String>,
}

/// A log of either kind from a file, or its sealed beginning.
pub struct AnySource {
    /// The log.
    pub log: AnyLog,
    /// The program that wrote it, with its version.
    pub program: String,
    /// The damage to the file, if it is not whole.
    pub damage: Option<String>,
}

/// Least size of a log whose reading shows how far it has come, bytes.
const LONG: usize = 2 << 20;

/// Says what is wrong with a log that is not whole, and what was done with its sealed beginning: `compared`.
pub fn say_damage(damage: Option<&String>, done: &str) {
    if let Some(damage) = damage {
        say(format!("{damage}\nThis much is {done}; `motion-lab record --resume` makes it whole."));
    }
}

/// Whether a file may be a log, by its first eight bytes. Any other file is read no farther, however long it is.
pub fn begins_as_one(beginning: &[u8]) -> bool {
    !matches!(Log::read_mcap(beginning), Err(LogError::NotALog))
}

/// Reads a log with frames; of a damaged or unfinished file, its sealed beginning. Fails when not even that can be
/// used.
pub fn read_log(path: &Path) -> Result<LogSource, Failure> {
    let bytes = read_bytes_if(path, MAX_LOG, begins_as_one)?;
    with_frames(path, &bytes)
}

fn with_frames(path: &Path, bytes: &[u8]) -> Result<LogSource, Failure> {
    let progress = if bytes.len() < LONG { Progress::none() } else { Progress::of_bytes(bytes.len() as u64) };
    match Log::read_mcap_with(bytes, |checked| progress.at(checked)) {
        Ok(read) => Ok(LogSource { read, damage: None }),
        Err(LogError::Damaged(damaged)) => {
            let message = damaged.to_string();
            match damaged.recovered {
                Some(read) => Ok(LogSource { read, damage: Some(format!("{}: {message}", shown(path))) }),
                None => Err(beyond_use(path, &message)),
            }
        }
        Err(error) => Err(refused(path, &error)),
    }
}

/// As [`read_log`], of a log with frames or of digests.
pub fn read_any_log(path: &Path) -> Result<AnySource, Failure> {
    let bytes = read_bytes_if(path, MAX_LOG, begins_as_one)?;
    match DigestLog::read_mcap(&bytes) {
        Ok(ReadDigestLog { log, program }) => Ok(AnySource { log: AnyLog::Digest(log), program, damage: None }),
        Err(LogError::DamagedDigests(damaged)) if damaged.recovered.is_some() => {
            let message = format!("{}: {damaged}", shown(path));
            let Some(ReadDigestLog { log, program }) = damaged.recovered else {
                return Err(beyond_use(path, &message));
            };
            Ok(AnySource { log: AnyLog::Digest(log), program, damage: Some(message) })
        }
        // a log with frames, or what can't be read as either
        Err(LogError::HasFrames | LogError::DamagedDigests(_)) => {
            let LogSource { read, damage } = with_frames(path, &bytes)?;
            Ok(AnySource { log: AnyLog::Full(read.log), program: read.program, damage })
        }
        Err(error) => Err(refused(path, &error)),
    }
}

fn beyond_use(path: &Path, message: &str) -> Failure {
    Failure::input(format!("{}: {message}", shown(path)), "Record the run again.")
}

fn refused(path: &Path, error: &LogError) -> Failure {
    let file = shown(path);
    let next = match error {
        LogError::NotALog => "Name a file that `motion-lab record -o` wrote.".to_owned(),
        LogError::Export => "Name the log that it was exported from.".to_owned(),
        LogError::Version(_) => "Read it with the motion-lab that wrote it.".to_owned(),
        LogError::NoFrames => format!("Make the frames from it: motion-lab replay {file} --log full -o FULL.mcap"),
        _ => "Record the run again.".to_owned(),
    };
    Failure::input(format!("{file}: {error}"), next)
}
