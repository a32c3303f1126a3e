//! What planners need of `motion-lab`: three robots, worlds, exact collision answers, sensors, pictures and planners.
//!
//! # What you can do here
//!
//! - Ask a scene: [`collision::Collision`] has the four questions, [`collision::Scene`] the answers.
//! - Prove an edge: [`collision::Checker::edge`] gives a verdict, [`collision::Certificate`] holds its proof.
//! - Plan: [`collision::Problem`] has a start, a goal and seeded samples, [`planning`] planners whose paths are proven.
//! - Draw: [`picture::Figure`] makes SVG of pictures in metres.
//!
//! ```
//! use motion_lab_core::picture::{Figure, Theme, world};
//! use motion_lab_core::prelude::*;
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
//! The crate `motion-lab` re-exports all of this and adds the simulator, the run log and the lab itself. This one has
//! no features, uses neither Bevy nor egui and opens no files.
//!
//! The modules stand in reading order: each uses only those above it. `ARCHITECTURE.md` is their map.
//!
//! Conventions: SI units, radians, `f64`; x right, y up, counter-clockwise positive; angles wrapped to `(-pi, pi]`.
//! Touching counts as collision.

pub mod num;

pub mod short_list;

#[doc(hidden)]
pub mod text_position;

#[doc(hidden)]
pub mod one_line;

#[doc(hidden)]
pub mod names;

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
