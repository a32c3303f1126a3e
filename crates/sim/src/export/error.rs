//! `ExportError`, why a log is not exported.

use std::io;

use crate::recording::RunError;
use crate::run::LogError;

/// Why a log is not exported. What was written until then is no whole export.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The output failed.
    #[error("the export can't be written: {0}")]
    Write(#[from] io::Error),
    /// The log's run cannot be shown: nobody added one of its kinds of robots, or a frame is none of this run.
    #[error(transparent)]
    Run(Box<RunError>),
    /// The log cannot be written as a file, whose records the export would hold.
    #[error(transparent)]
    Log(Box<LogError>),
    /// The records of the log's file cannot be copied.
    #[error("the records of the log's file: {0}")]
    Records(#[source] io::Error),
    /// The log's file ends before the log, so it is another log's.
    #[error("the log's own messages end before tick {0}")]
    Ends(u64),
}

impl From<RunError> for ExportError {
    fn from(error: RunError) -> Self {
        ExportError::Run(Box::new(error))
    }
}

impl From<LogError> for ExportError {
    fn from(error: LogError) -> Self {
        ExportError::Log(Box::new(error))
    }
}
