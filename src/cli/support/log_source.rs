//! A log named on the command line.

use std::path::Path;

use motion_lab::run::{Log, LogError, ReadLog};

use super::input::read_bytes_if;
use crate::cli::Failure;

/// Largest size of a log file, bytes.
pub const MAX_LOG: u64 = 4 << 30;

/// A log from a file, or its sealed beginning.
pub struct LogSource {
    /// The log.
    pub read: ReadLog,
    /// The damage to the file, if it is not whole.
    pub damage: Option<String>,
}

/// Whether a file may be a log, by its first eight bytes. Any other file is read no farther, however long it is.
pub fn begins_as_one(beginning: &[u8]) -> bool {
    !matches!(Log::read_mcap(beginning), Err(LogError::NotALog))
}

/// Reads a log; of a damaged or unfinished file, its sealed beginning. Fails when not even that can be used.
pub fn read_log(path: &Path) -> Result<LogSource, Failure> {
    let bytes = read_bytes_if(path, MAX_LOG, begins_as_one)?;
    let refused =
        |error: &dyn std::fmt::Display, next| Err(Failure::input(format!("{}: {error}", path.display()), next));
    match Log::read_mcap(&bytes) {
        Ok(read) => Ok(LogSource { read, damage: None }),
        Err(LogError::Damaged(damaged)) => {
            let message = damaged.to_string();
            match damaged.recovered {
                Some(read) => Ok(LogSource { read, damage: Some(format!("{}: {message}", path.display())) }),
                None => refused(&message, "Record the run again."),
            }
        }
        Err(error @ LogError::NotALog) => refused(&error, "Name a file that `motion-lab record -o` wrote."),
        Err(error @ LogError::Export) => refused(&error, "Name the log that it was exported from."),
        Err(error @ LogError::Version(_)) => refused(&error, "Read it with the motion-lab that wrote it."),
        Err(error) => refused(&error, "Record the run again."),
    }
}
