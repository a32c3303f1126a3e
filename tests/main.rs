//! The whole-system tests: one binary, a module per subject. Without features it has those of the core.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

mod fixtures;
mod oracle;
mod verdicts;

#[cfg(feature = "sim")]
mod allocation;
#[cfg(feature = "sim")]
mod anatomy;
mod angles;
#[cfg(feature = "cli")]
mod atlas;
mod certificates;
mod chapter;
#[cfg(feature = "cli")]
mod cli;
mod edges;
#[cfg(feature = "sim")]
mod examples;
mod exercises;
mod extremes;
mod failsafe;
mod faults;
#[cfg(all(unix, feature = "cli"))]
mod gate;
mod house;
#[cfg(feature = "cli")]
mod imports;
mod letters;
mod metamorphic;
mod pairs;
mod penetration;
#[cfg(feature = "sim")]
mod pins;
mod planner;
mod polygons;
mod scans;
mod send_sync;
#[cfg(feature = "sim")]
mod sensor_noise;
#[cfg(feature = "sim")]
mod simulation;
mod sweeps;
mod touches;
