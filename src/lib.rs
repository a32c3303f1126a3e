//! motion lab
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

pub mod ui;

#[cfg(feature = "window")]
pub mod app;

#[cfg(target_family = "wasm")]
pub mod web;

/// The names a planner or an experiment usually needs.
pub mod prelude {
    pub use crate::configuration::{Configuration, HitchCfg, R2, T2, Tn};
    pub use crate::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape, Vector2};
    pub use crate::random::{Seed, Stream};
    pub use crate::robots::{CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, Reach, Robot, Rusty, RustyCmd, RustyDisc};
}
