//! The whole-system tests: one binary, a module per subject.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

mod fixtures;
mod oracle;
mod verdicts;

mod allocation;
mod anatomy;
mod atlas;
mod chapter;
mod cli;
mod edges;
mod examples;
mod exercises;
mod extremes;
mod failsafe;
mod faults;
mod house;
mod imports;
mod letters;
mod metamorphic;
mod pairs;
mod penetration;
mod planner;
mod polygons;
mod scans;
mod send_sync;
mod sensor_noise;
mod simulation;
mod sweeps;
mod touches;
