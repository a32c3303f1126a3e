//! What a recorded run was like for each of its robots: contacts, path lengths, clearances, and how they change.

mod column;
mod gauge;
mod robot_stats;
mod series;
mod standing;

pub use column::{StatsColumn, StatsNumber};
pub use robot_stats::{LeastClearance, RobotStats, RunStats, StatsGatherer};
pub use series::{Quantity, Series, SeriesGatherer};
