//! The tours: what each robot does when nobody drives it.

mod config;

pub use config::{
    BOOK_SEED, ConfigError, MAX_RANGE, MAX_RAYS, MAX_ROBOTS, MAX_TICKS, MAX_WORLDS, SensorConfig, TourConfig,
};
