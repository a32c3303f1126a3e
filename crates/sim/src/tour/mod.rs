//! The tours: what each robot does when nobody drives it. Pure functions of the seed, the tick and where the robot is.
//! A robot has its kind's own tour, unless its world gives it a route.

mod config;
mod reversing;
mod route;
mod sensors;
mod sinusoids;
mod three_worlds;
mod waypoints;

pub use config::{BOOK_SEED, ConfigError, MAX_ROBOTS, MAX_TICKS, MAX_WORLDS, TourConfig};
pub use reversing::{LEG_SECONDS, LEGS, Reversing};
pub use route::{RouteTour, RouteTours, Step, Touring, Tracking};
pub use sinusoids::{MAX_JOINT_SPEED, Sinusoids};
pub use waypoints::{ARRIVAL_RADIUS, TOUR_MARK, Waypoints};
