//! The tests of the simulator as a whole: one binary, a folder per subject.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

mod avoid;
mod obstacles;
mod pins;
mod runs;
mod sensors;
mod shrink;
mod simulator;
mod tasks;
mod tick_oracle;
mod truth;
