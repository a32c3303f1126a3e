//! `ReadLog`, a log read from a file.

use crate::run::Log;

/// A log read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLog {
    /// The run, or its sealed beginning.
    pub log: Log,
    /// The program that wrote it, with its version.
    pub program: String,
    pub(super) world_texts: Vec<String>,
}
