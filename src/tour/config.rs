//! `TourConfig`, what is run: the worlds with their resident robots, for how long, with which sensor.

use crate::random::Seed;
use crate::worlds::World;

/// The seed of every run printed in the book.
pub const BOOK_SEED: Seed = Seed(2005);

/// A range sensor as a run configures it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorConfig {
    /// The number of rays.
    pub n_rays: u32,
    /// The greatest range, metres.
    pub max_range: f64,
}

/// What is run. The robots are the worlds' residents, numbered from 0 in the order of the worlds and their lists.
#[derive(Clone, Debug, PartialEq)]
pub struct TourConfig {
    /// The worlds.
    pub worlds: Vec<World>,
    /// The number of ticks.
    pub ticks: u64,
    /// The range sensor of every Rusty; `None` for none.
    pub sensor: Option<SensorConfig>,
}
