//! The whole-system tests: one binary, a module per subject. Without features it has those of the core.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

#[cfg(feature = "sim")]
mod allocation;
#[cfg(feature = "sim")]
mod anatomy;
mod angles;
mod arcs;
#[cfg(feature = "cli")]
mod atlas;
#[cfg(feature = "sim")]
mod caches;
mod certificates;
mod chapter;
#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "sim")]
mod coded_sensors;
#[cfg(feature = "sim")]
mod controls;
#[cfg(feature = "sim")]
mod crowds;
#[cfg(feature = "sim")]
mod digest_logs;
mod edges;
#[cfg(feature = "sim")]
mod examples;
mod exercises;
mod extremes;
mod failsafe;
mod faults;
mod fixtures;
mod footprints;
#[cfg(all(unix, feature = "cli"))]
mod gate;
mod house;
#[cfg(feature = "cli")]
mod imports;
#[cfg(feature = "sim")]
mod inputs;
mod jackknife;
#[cfg(feature = "sim")]
mod keyframes;
mod letters;
#[cfg(feature = "sim")]
mod many_worlds;
mod metamorphic;
#[cfg(feature = "sim")]
mod noise_streams;
#[cfg(feature = "sim")]
mod obstacles;
mod oracle;
#[cfg(feature = "sim")]
mod own_sensors;
mod pairs;
mod penetration;
#[cfg(feature = "sim")]
mod pins;
mod planner;
mod planning;
mod polygons;
mod rates;
mod rays;
#[cfg(feature = "sim")]
mod replicas;
mod rounded;
mod scan_shapes;
mod scan_worlds;
mod scans;
mod send_sync;
#[cfg(feature = "sim")]
mod sensor_noise;
#[cfg(feature = "sim")]
mod sightings;
#[cfg(feature = "sim")]
mod simulation;
#[cfg(feature = "sim")]
mod sizes;
#[cfg(feature = "sim")]
mod stats;
mod sweeps;
mod tangents;
#[cfg(feature = "sim")]
mod tick_oracle;
#[cfg(feature = "sim")]
mod tick_tangents;
mod ties;
mod touches;
mod trailer;
mod verdicts;
#[cfg(feature = "sim")]
mod warehouse;
#[cfg(feature = "sim")]
mod words;
mod wrappers;
