//! The whole-system tests: one binary, a module per subject.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

mod allocation;
mod cli;
mod house;
mod planner;
