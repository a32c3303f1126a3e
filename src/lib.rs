//! A deterministic 2D robot-motion laboratory: three robots, three worlds, one collision checker that answers four
//! questions, one simulator.
//!
//! # What you can do here
//!
//! - Ask a scene: [`collision::Collision`] has the four questions, [`collision::Scene`] the answers.
//! - Prove an edge: [`collision::Checker::edge`] gives a verdict, [`collision::Certificate`] holds its proof.
//! - Plan: [`collision::Problem`] has a start, a goal and seeded samples, [`planning`] planners whose paths are proven.
//! - Draw: [`picture::Figure`] makes SVG of pictures in metres.
//! - Record and verify a run: [`recording::Run`] and [`recording::verify`].
//! - Write a planner, chapter by chapter: [`guide::write_a_planner`].
//!
//! ```
//! use motion_lab::picture::{Figure, Theme, world};
//! use motion_lab::prelude::*;
//!
//! let (scene, arm) = (Scene::workbench(), Reach::<2>::workbench());
//! let (a, b) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
//! // ask a scene: metres to the nearest obstacle
//! assert!(scene.distance(&arm.footprint(&a)) > 0.0);
//! // prove an edge: the post stands between two free configurations
//! let checker = Checker::new(scene, arm);
//! assert!(matches!(checker.edge(&a, &b)?, EdgeVerdict::Hit { .. }));
//! // plan: the first sample that a free edge joins to the start
//! let mut problem = Problem::try_new(checker, a, b, Seed(2005))?;
//! let next = (0..1000).find_map(|_| Some(problem.sample()).filter(|q| problem.checker().edge_free(&a, q)));
//! assert!(next.is_some());
//! // draw: the same bytes on every platform
//! let svg = Figure::of(world(&World::workbench())).svg(Theme::Light.palette());
//! assert!(svg.contains("the post"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A run is recorded from a seed, and simulated again to be compared:
//!
//! ```
//! use motion_lab::recording::{Run, verify};
//! use motion_lab::tour::{BOOK_SEED, TourConfig};
//!
//! let log = Run::record(TourConfig { ticks: 20, ..TourConfig::default() }, BOOK_SEED)?;
//! assert_eq!(verify(&log, |_| {})?.identical, 20); // every f64 to the last bit
//! # Ok::<(), motion_lab::recording::RunError>(())
//! ```
//!
//! The modules stand in reading order: each uses only those above it. `ARCHITECTURE.md` is their map.
//!
//! Conventions: SI units, radians, `f64`; x right, y up, counter-clockwise positive; angles wrapped to `(-pi, pi]`.
//! Touching counts as collision.
//!
//! # Crates
//!
//! The library is five crates, and this one re-exports the others. A planner needs `motion-lab-core` alone, which has
//! no features; `motion-lab-sim` adds the simulator and the run log, on Bevy's ECS; `motion-lab-import` reads the files
//! of other programs; `motion-lab-raster` makes pixels of drawings. What is only here is the lab itself.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `headless` | the program `motion-lab`, worlds from other formats, pictures as PNG and GIF; without arguments the program records the tour and checks it |
//! | `window` (by default) | the same program, which without arguments opens the lab in a window |
//! | `web` | the lab in a page, for WebAssembly |
//! | `cli`, `screen` | parts of the others; not meant to be enabled by themselves |
#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub use motion_lab_core::{
    collision, configuration, cspace, geometry, num, picture, planning, prelude, random, robots, sensors, short_list,
};
pub use motion_lab_sim::{
    anatomy, atlas, avoid, course, export, plans, problems, run, run_page, shrink, simulation, tour,
};

/// Worlds: lists of named geometry, never bitmaps.
pub mod worlds {
    pub use motion_lab_core::worlds::*;
    #[cfg(feature = "cli")]
    #[doc(inline)]
    pub use motion_lab_import as import;
}

/// Recording, replaying and grading runs.
pub mod recording {
    pub use motion_lab_sim::course::*;
    pub use motion_lab_sim::recording::*;
}

#[cfg(any(feature = "cli", feature = "web"))]
mod json_words;

#[cfg(feature = "cli")]
mod output;

#[cfg(feature = "cli")]
pub mod batch;

pub mod capture;

// what only a desktop uses lies idle in the page, which shares the widgets
#[cfg(feature = "screen")]
#[cfg_attr(not(feature = "window"), allow(dead_code, unused_imports))]
mod window;

/// The lab in a window.
#[cfg(feature = "window")]
pub mod app {
    pub use crate::window::desktop::{Opened, WindowError, open_in_window, run_window, run_window_with};
    pub use crate::window::{LabSystems, is_busy};
}

#[doc(hidden)] // public for tests alone
pub mod web;

pub mod guide;

#[cfg(feature = "cli")]
pub mod cli;

/// The code in README runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
