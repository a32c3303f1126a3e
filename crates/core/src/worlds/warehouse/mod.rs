//! `Warehouse`, a generated world of up to 100,000 robots that never meet.
//!
//! A bay holds four aisles that rovers drive round, eight cells with an arm each, and a road about all that for cars.
//! Rovers and cars follow [routes](super::Route), which do not cross; arms stay within their cells. So nobody comes
//! near anybody, however long the run. A hall has as many bays as its robots need.

mod bay;
mod hall;
mod plan;
mod trailer;

use super::World;
use crate::random::Seed;
use hall::hall;
use plan::Plan;

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

impl Warehouse {
    /// The world. It takes time in proportion to the robots, and is the same to the bit everywhere.
    ///
    /// At its start and in a run of any length, no two robots come within 5 cm of each other, and none of an obstacle,
    /// unless somebody drives one.
    ///
    /// # Errors
    /// [`WarehouseError`] when the number of robots is out of range.
    pub fn world(&self) -> Result<World, WarehouseError> {
        if !(WAREHOUSE_ROBOTS[0]..=WAREHOUSE_ROBOTS[1]).contains(&self.robots) {
            return Err(WarehouseError::Robots(self.robots));
        }
        let plan = Plan::of(self.robots);
        let mut world = hall(self, &plan);
        for bay in 0..plan.bays {
            bay::furnish(&mut world, self, &plan, bay);
        }
        Ok(world)
    }
}

#[cfg(test)]
mod tests;
