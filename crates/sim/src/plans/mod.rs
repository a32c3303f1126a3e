//! Plans as values: a planner by its name at work on a robot of a world, what there is to draw of it, and its path as a
//! file.
//!
//! ```
//! use motion_lab_sim::plans::{PlannerName, Task};
//! use motion_lab_core::planning::Progress;
//! use motion_lab_core::prelude::*;
//! use motion_lab_core::robots::AnyRobot;
//!
//! let at = |coordinates: &[f64]| AnyRobot::of_kind("reach", coordinates).unwrap();
//! let ((robot, start), (_, goal)) = (at(&[2.0, 0.0]), at(&[3.1, 0.0]));
//! let task = Task::new("Reach", robot, World::workbench(), [start, goal]);
//! let mut attempt = task.attempt(PlannerName::RrtConnect, Seed(2005))?;
//! while attempt.step() == Progress::Growing {}
//! assert_eq!(attempt.drawn().corners.last(), Some(&goal));
//! # Ok::<(), NoPath>(())
//! ```

mod attempt;
mod bug1_sensor;
mod checker_name;
mod corners;
mod drawn;
mod judged;
mod making;
mod named;
mod own;
mod path_file;
mod picture;
mod planners;
mod removal;
mod rounds;
mod task;

pub use attempt::{FileLeg, LegControl, LegMotion, PathLengths, PlanAttempt, ShortenedPath, Trial};
pub use bug1_sensor::{Bug1Sensor, Bug1Walk, WalkEnd};
pub use checker_name::CheckerName;
pub use drawn::{Drawn, DrawnBarrier, Rejected};
pub use judged::{JudgedPath, MAX_JUDGED};
pub use named::PlannerName;
pub use own::{LinePlanner, MadePlanner, OwnPlanner, PlannerMaker};
pub use path_file::{Counts, MAX_PATH_BYTES, PathFile, PathFileError};
pub use picture::{space_items, workspace_items};
pub use planners::{PlannerError, Planners, UnknownPlanner};
pub use removal::{Blocker, BlockerKind, NoRemoval, Removal};
pub use rounds::solve_in_rounds;
pub use task::{MAX_CLEARANCE, TUBE, Task};
