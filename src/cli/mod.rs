//! The program and its command line: one command a file. Data goes to standard output, messages to standard error.

mod command_line;
mod commands;
mod help;
mod program;
mod support;

pub use program::Program;

pub(crate) use support::console::{Data, say};
pub(crate) use support::end::{Failure, Outcome};
