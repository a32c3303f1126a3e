//! The tests of the core as a whole: one binary, a folder per subject.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

mod black_box;
mod kernel;
mod motion;
mod planning;
mod sensors;
