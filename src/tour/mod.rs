//! The tours: what each robot does when nobody drives it. Pure functions of the seed, the tick and where the robot is.

mod config;
mod reversing;
mod sensors;
mod sinusoids;
mod three_worlds;
mod waypoints;

pub use config::{BOOK_SEED, ConfigError, MAX_ROBOTS, MAX_TICKS, MAX_WORLDS, TourConfig};
pub use reversing::{LEG_SECONDS, LEGS, Reversing};
pub use sinusoids::{MAX_JOINT_SPEED, Sinusoids};
pub use waypoints::{ARRIVAL_RADIUS, TOUR_MARK, Waypoints};
