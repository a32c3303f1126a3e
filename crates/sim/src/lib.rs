//! The simulator of `motion-lab`: runs as data, Bevy's entities under one schedule, the log, and the values of what a
//! lab shows. The crate `motion-lab` re-exports all of it.
//!
//! A run is recorded from a seed, and simulated again to be compared:
//!
//! ```
//! use motion_lab_sim::recording::{Run, verify};
//! use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
//!
//! let log = Run::record(TourConfig { ticks: 20, ..TourConfig::default() }, BOOK_SEED)?;
//! assert_eq!(verify(&log, |_| {})?.identical, 20); // every f64 to the last bit
//! # Ok::<(), motion_lab_sim::recording::RunError>(())
//! ```
//!
//! The modules stand in reading order: each uses only those above it. `ARCHITECTURE.md` is their map. Conventions are
//! those of [`motion_lab_core`].

pub mod tour;

pub mod run;

pub mod tow;

pub mod anatomy;

pub mod atlas;

pub mod simulation;

pub mod recording;

pub mod course;

pub mod shrink;

pub mod tasks;

pub mod export;

pub mod plans;

pub mod problems;

pub mod avoid;

#[doc(hidden)]
pub mod manifest;

pub mod capture;

#[doc(hidden)]
pub mod lens;

pub mod run_page;
