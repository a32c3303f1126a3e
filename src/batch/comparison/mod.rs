//! `PlannerComparison`, several planners by the same problems, at several seeds.
//!
//! ```
//! use motion_lab::batch::PlannerComparison;
//! use motion_lab::plans::{PlannerName, Task};
//!
//! let planners = vec![PlannerName::RrtConnect, PlannerName::AStar];
//! let comparison = PlannerComparison::of(Task::round_the_post(), planners, 0..3);
//! let attempts = comparison.run(|_| true)?;
//! assert_eq!(attempts.len(), 6);
//! for medians in comparison.medians(&attempts) {
//!     println!("{}: {} of {}", medians.planner, medians.solved, medians.attempts);
//! }
//! println!("{}", comparison.csv(&attempts));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod case;
mod compared;
mod medians;
mod ompl;
mod tables;
#[cfg(test)]
mod tests;

pub use case::{AskedPath, PlanCase};
pub use compared::{ComparedAttempt, MixedKinds, NoProblem, PathCost, PlannerComparison};
pub use medians::PlannerMedians;
