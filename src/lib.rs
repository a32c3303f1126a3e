//! A deterministic 2D robot-motion laboratory: three robots, three worlds, one collision checker that answers four questions,
//! one simulator.
//!
//! The modules stand in reading order: each uses only those above it. The pure core is everything down to [`run`]; Bevy begins
//! at [`simulation`].
//!
//! - Ask about configurations: [`collision::Checker`], and the trait [`collision::Collision`] that planners take.
//! - Run something: [`recording::Run`].
//! - Draw something: [`picture`].
//! - Write a planner: [`guide::write_a_planner`].
//!
//! Conventions: SI units, radians, `f64`; x right, y up, counter-clockwise positive; angles wrapped to `(-pi, pi]`. Touching counts
//! as collision.
#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod num;

pub mod random;

pub mod geometry;

pub mod configuration;

pub mod robots;

pub mod worlds;

pub mod collision;

pub mod sensors;

pub mod tour;

pub mod run;

pub mod simulation;

pub mod recording;

pub mod picture;

pub mod cspace;

pub mod anatomy;

pub mod atlas;

#[cfg(not(target_family = "wasm"))]
pub mod output;

pub mod manifest;

pub mod capture;

pub mod ui;

#[cfg(feature = "screen")]
pub mod app;

pub mod web;

pub mod guide;

/// The names a planner or an experiment usually needs.
pub mod prelude {
    pub use crate::configuration::{Configuration, HitchCfg, R2, T2, Tn};
    pub use crate::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape, Vector2};
    pub use crate::random::{Seed, Stream};
    pub use crate::robots::{CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, Reach, Robot, Rusty, RustyCmd, RustyDisc};
}

/// The code in README runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
