//! What a recorded run was like for each of its robots: contacts, path lengths, clearances, and how they change.

mod gauge;
mod robot_stats;
mod series;
mod standing;

pub use robot_stats::{LeastClearance, RobotStats, RunStats, StatsGatherer};
pub use series::{Quantity, Series, SeriesGatherer};
