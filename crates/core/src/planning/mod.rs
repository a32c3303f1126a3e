//! Plans: planners whose paths are proven, and the tools to write one.
//!
//! A [`Planner`] works on a [`Problem`](crate::collision::Problem) one iteration at a time. Its [`Growth`] can be drawn
//! after every iteration. [`solve`] runs it within [`Bounds`]. A returned path is a [`CertifiedPath`]: each of its legs
//! holds the certificate of its whole length, so there is no path that is only hoped to be free.
//!
//! ```
//! use motion_lab_core::planning::{Bounds, RrtConnect, solve};
//! use motion_lab_core::prelude::*;
//! let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
//! let problem = Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(2005))?;
//! let path = solve(&mut RrtConnect::new(problem.clone()), &Bounds::default())?;
//! assert_eq!((path.start(), path.goal()), (problem.start(), problem.goal()));
//! assert!(path.verify(problem.checker().scene())? > 0.0); // metres, along the whole path
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! One rule holds for all of them: a path lies within the scene's bounds, whose sides belong to them. The robot's
//! [position](crate::robots::Robot::position), a rover's centre or the middle of a car's rear axle, stays within them
//! all the way; the footprint may reach over them. A [`Problem`](crate::collision::Problem) refuses ends outside, a
//! [`Growth`] asks about no motion that leaves them, and [`solve`] accepts none.
//!
//! A planner of one's own implements [`Planner`]; it then runs, is bounded and is checked as those here.

mod bounds;
pub mod curves;
mod goal;
mod growth;
pub mod hybrid;
mod metric;
mod nearest;
mod no_path;
mod path;
mod planner;
pub mod planners;
mod progress;
mod queue;
mod sampling;
mod search;
mod sensed;
mod settings;
mod shortcut;

pub use bounds::{Bound, Bounds, Effort};
pub use goal::{Ball, TipDisc};
pub use growth::{Growth, Node, Rejection};
pub use metric::{Metric, MetricError};
pub use nearest::{Nearest, Neighbour};
pub use no_path::{CellSides, NoPath};
#[doc(hidden)]
pub use path::is_same;
pub use path::{CertifiedPath, Leg, LinePath, PathError, UnprovenPath};
pub use planner::{Planner, accepted, called_free, solve, solve_unproven};
pub use planners::{
    Bug1, Bug2, CellDecomposition, GridSearch, PotentialField, Prm, Rrt, RrtConnect, RrtStar, TangentGraph,
    VisibilityGraph, cell_length_bound, length_bound,
};
pub use progress::Progress;
pub use queue::Queue;
pub use sampling::{sample_near, sample_shorter, sample_toward_goal};
pub use search::Search;
pub use sensed::{LeavePoint, RoundEnd, Sensed};
pub use settings::SamplingSettings;
pub use shortcut::MARGIN;
