//! `CaptureError`, why nothing was captured.

use std::io;

use crate::recording::RunError;

/// Why a capture failed. No file is left behind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CaptureError {
    /// The run has no such tick.
    #[error("there is no tick {tick}: they are 0 to {last}")]
    NoTick {
        /// The tick asked for.
        tick: u64,
        /// The run's last tick.
        last: u64,
    },
    /// The subject does not move from tick to tick, so it gives no GIF.
    #[error(
        "query anatomy is one frozen scene: nothing in it moves from tick to tick, so there is nothing to make a GIF of"
    )]
    Frozen,
    /// The run has no such robot, or no such world.
    #[error("the run has no {0}")]
    NotInRun(String),
    /// The run of the log can't be shown.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The images would be larger than any.
    #[error("the pictures are too large: {0} pixels wide")]
    TooLarge(u32),
    /// The GIF would have more pictures than a page makes.
    #[error("{pictures} pictures: a page makes at most {most}, motion-lab capture any number")]
    TooMany {
        /// Their number.
        pictures: u64,
        /// The largest number.
        most: u64,
    },
    /// Whoever asked for it stopped it.
    #[error("stopped")]
    Stopped,
    /// The file can't be written.
    #[error("it can't be written: {0}")]
    Write(#[from] io::Error),
    /// A fault of the lab.
    #[error("{0}")]
    Fault(String),
}
