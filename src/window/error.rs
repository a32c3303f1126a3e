//! `SessionError`, why a run could not be started, saved, opened or pictured.

use motion_lab_sim::atlas::TeleportRefusal;
use motion_lab_sim::avoid::AvoidError;
use motion_lab_sim::capture::CaptureError;
use motion_lab_sim::recording::RunError;
use motion_lab_sim::run::LogError;
use motion_lab_sim::simulation::{RestoreError, SpawnError};

/// Why the session could not do as asked. The run under way stays, unless the error says otherwise.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The new run cannot start.
    #[error(transparent)]
    Spawn(#[from] SpawnError),
    /// A kept frame does not fit the run.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// The run cannot be recorded.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The log cannot be read or written.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The picture cannot be made.
    #[error(transparent)]
    Capture(#[from] CaptureError),
    /// A contact cannot be explained.
    #[error(transparent)]
    Avoid(#[from] AvoidError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] std::io::Error),
    /// Nothing has been run, so there is nothing to save.
    #[error("nothing has been run yet; press Play first")]
    NotRun,
    /// No robot has this name.
    #[error("there is no {0}")]
    NoRobot(String),
    /// A robot that has no room where it was to be put.
    #[error("{0}")]
    Refused(TeleportRefusal),
    /// A file that is too large to open.
    #[error("{found} bytes: the window opens at most {most}")]
    TooLarge {
        /// Its size, bytes.
        found: u64,
        /// The largest size, bytes.
        most: u64,
    },
}
