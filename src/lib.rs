//! A deterministic 2D robot-motion laboratory: three robots, three worlds, one collision checker that answers four
//! questions, one simulator.
//!
//! # What you can do here
//!
//! - Ask a scene: [`collision::Collision`] has the four questions, [`collision::Scene`] the answers.
//! - Prove an edge: [`collision::Checker::edge`] gives a verdict, [`collision::Certificate`] holds its proof.
//! - Plan: [`collision::Problem`] has a start, a goal and seeded samples, [`planning`] planners whose paths are proven.
//! - Draw: [`picture::Figure`] makes SVG of pictures in metres.
#![cfg_attr(feature = "sim", doc = "- Record and verify a run: [`recording::Run`] and [`recording::verify`].")]
#![cfg_attr(feature = "sim", doc = "- Write a planner, chapter by chapter: [`guide::write_a_planner`].")]
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
#![cfg_attr(
    feature = "sim",
    doc = r#"
A run is recorded from a seed, and simulated again to be compared:

```
use motion_lab::recording::{Run, verify};
use motion_lab::tour::{BOOK_SEED, TourConfig};

let log = Run::record(TourConfig { ticks: 20, ..TourConfig::default() }, BOOK_SEED)?;
assert_eq!(verify(&log, |_| {})?.identical, 20); // every f64 to the last bit
# Ok::<(), motion_lab::recording::RunError>(())
```
"#
)]
//!
//! The modules stand in reading order: each uses only those above it. `ARCHITECTURE.md` is their map.
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

pub mod planning;

#[cfg(feature = "sim")]
pub mod tour;

#[cfg(feature = "sim")]
pub mod run;

#[cfg(feature = "sim")]
pub mod anatomy;

#[cfg(feature = "sim")]
pub mod atlas;

#[cfg(feature = "sim")]
pub mod simulation;

#[cfg(feature = "sim")]
pub mod recording;

#[cfg(feature = "sim")]
pub mod export;

#[cfg(feature = "sim")]
pub mod plans;

// the program's own; public because the program is a crate of its own
#[doc(hidden)]
#[cfg(feature = "cli")]
pub mod output;

#[cfg(feature = "cli")]
pub mod sweep;

// the program's own likewise
#[doc(hidden)]
#[cfg(feature = "sim")]
pub mod manifest;

#[cfg(feature = "sim")]
pub mod capture;

#[cfg(feature = "screen")]
mod ui;

#[cfg(feature = "screen")]
pub mod app;

// the program's own likewise: it writes links
#[doc(hidden)]
#[cfg(all(feature = "sim", any(target_family = "wasm", feature = "cli", test)))]
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
    pub use crate::configuration::{Chart, Configuration, HitchCfg, R2, T2, Tn};
    pub use crate::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape, Vector2};
    pub use crate::planning::{LinePath, NoPath, Planner, Progress, solve};
    pub use crate::random::{Seed, Stream};
    pub use crate::robots::{CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, Reach, Robot, Rusty, RustyCmd, RustyDisc};
    pub use crate::worlds::World;
}

/// The code in README runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
