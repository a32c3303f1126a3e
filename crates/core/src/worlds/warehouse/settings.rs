//! `Warehouse`, what a generated world is made by.

use crate::random::Seed;

/// Smallest and largest number of robots in a generated warehouse.
pub const WAREHOUSE_ROBOTS: [usize; 2] = [10, 100_000];

/// A warehouse to be generated: eight rovers, an arm and a car for every ten robots.
///
/// ```
/// use motion_lab_core::random::Seed;
/// use motion_lab_core::worlds::Warehouse;
/// let world = Warehouse { seed: Seed(1), robots: 50, trailers: false }.world().unwrap();
/// assert_eq!(world.robots.len(), 50);
/// assert_eq!(world.robots[0].name, "rover 00000"); // the number is the id that the robot has in a run
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Warehouse {
    /// Chooses the speeds, the places of the robots on their routes, and which racks are missing.
    pub seed: Seed,
    /// The number of robots.
    pub robots: usize,
    /// Whether every car pulls a trailer.
    pub trailers: bool,
}

/// Why a warehouse cannot be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WarehouseError {
    /// Too few robots, or too many.
    #[error("{0} robots: a warehouse has {least} to {most}", least = WAREHOUSE_ROBOTS[0], most = WAREHOUSE_ROBOTS[1])]
    Robots(usize),
}
