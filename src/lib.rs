//! A deterministic 2D robot-motion laboratory: three robots, three worlds, one collision checker that answers four
//! questions, one simulator.
//!
//! The modules stand in reading order: each uses only those above it.
//!
//! - Ask about configurations: [`collision::Checker`], and the trait [`collision::Collision`] that planners take.
//! - Draw something: [`picture`].
#![cfg_attr(feature = "sim", doc = "- Run something: [`recording::Run`].")]
#![cfg_attr(feature = "sim", doc = "- Write a planner: [`guide::write_a_planner`].")]
//!
//! Conventions: SI units, radians, `f64`; x right, y up, counter-clockwise positive; angles wrapped to `(-pi, pi]`.
//! Touching counts as collision.
//!
//! # Features
//!
//! Without features the library is the core, which is what a planner needs: robots, worlds, collision answers, sensors,
//! drawings and the configuration space, without Bevy.
//!
//! | feature | adds |
//! |---|---|
//! | `sim` | the simulator, the run log and what shows them: the rest of the library except for what follows |
//! | `cli` | `sim`, the program `motion-lab`, worlds from other formats, pictures as PNG and GIF |
//! | `headless` | `cli`; `motion-lab` without arguments records the tour and checks it |
//! | `window` (by default) | `cli`; `motion-lab` without arguments opens the lab in a window |
//! | `web` | `sim`, and the lab in a page, for WebAssembly |
//! | `screen` | what `window` and `web` share; not meant to be enabled by itself |
#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod num;

pub mod short_list;
mod text_position;

pub mod random;

pub mod geometry;

pub mod configuration;

pub mod robots;

pub mod worlds;

pub mod collision;

pub mod sensors;

pub mod picture;

pub mod cspace;

#[cfg(feature = "sim")]
pub mod tour;

#[cfg(feature = "sim")]
pub mod run;

#[cfg(feature = "sim")]
pub mod simulation;

#[cfg(feature = "sim")]
pub mod recording;

#[cfg(feature = "sim")]
pub mod anatomy;

#[cfg(feature = "sim")]
pub mod atlas;

#[cfg(feature = "cli")]
pub mod output;

#[cfg(feature = "sim")]
pub mod manifest;

#[cfg(feature = "sim")]
pub mod capture;

#[cfg(feature = "sim")]
pub mod ui;

#[cfg(feature = "screen")]
pub mod app;

#[cfg(feature = "sim")]
pub mod web;

#[cfg(feature = "sim")]
pub mod guide;

/// The names a planner or an experiment usually needs.
///
/// Bevy's prelude has a `World` and a `Scene` of its own: a program that uses both names ours in full.
pub mod prelude {
    pub use crate::collision::{
        CarChecker, ChainChecker, Checker, Collision, DiscChecker, EdgeVerdict, Problem, Scene, Witness,
    };
    pub use crate::configuration::{Configuration, HitchCfg, R2, T2, Tn};
    pub use crate::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape, Vector2};
    pub use crate::random::{Seed, Stream};
    pub use crate::robots::{CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, Reach, Robot, Rusty, RustyCmd, RustyDisc};
    pub use crate::worlds::World;
}

/// The code in README runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
