//! `ReadLog`, a log read from a file.

use crate::run::{Digest, Log};

/// A log read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLog {
    /// The run, or its sealed beginning.
    pub log: Log,
    /// The program that wrote it, with its version.
    pub program: String,
    /// The run's digest that the end of the file seals. `None` without an end, and in a log with frames that was
    /// written before their ends sealed one: then nothing but its frames says that it is this run.
    pub sealed: Option<Digest>,
    pub(super) world_texts: Vec<String>,
    /// The version of the file's format.
    pub(super) format: &'static str,
}
