//! A log named on the command line.

use std::path::Path;

use motion_lab::run::{Digest, Log, LogError, LogKind, ReadLog};

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

/// Reads a log with frames, as [`read_log`].
pub fn read_full_log(path: &Path) -> Result<LogSource, Failure> {
    let source = read_log(path)?;
    if source.log.kind() == LogKind::Frames { Ok(source) } else { Err(refused(path, &LogError::NoFrames)) }
}

/// Reads a log; of a damaged or unfinished file, its sealed beginning. Fails when not even that can be used.
pub fn read_log(path: &Path) -> Result<LogSource, Failure> {
    let bytes = read_bytes_if(path, MAX_LOG, begins_as_one)?;
    let progress =
        if bytes.len() < LONG { CommandProgress::none() } else { CommandProgress::of_bytes(bytes.len() as u64) };
    match Log::read_mcap_with(&bytes, |checked| progress.at(checked)) {
        Ok(ReadLog { log, program, .. }) => Ok(LogSource { log, program, damage: None }),
        Err(LogError::Damaged(damaged)) => {
            let message = format!("{}: {damaged}", shown(path));
            match damaged.recovered {
                Some(ReadLog { log, program, .. }) => Ok(LogSource { log, program, damage: Some(message) }),
                None => Err(Failure::input(message, "Record the run again.")),
            }
        }
        Err(error) => Err(refused(path, &error)),
    }
}

/// The digest of a log with frames.
pub fn digest_of(log: &Log) -> Result<Digest, Failure> {
    log.digest().ok_or_else(|| Failure::internal(LogError::NoFrames))
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
