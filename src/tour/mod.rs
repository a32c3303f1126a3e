//! The tours: what each robot does when nobody drives it.

mod config;

pub use config::{BOOK_SEED, SensorConfig, TourConfig};
