//! The world of a `Warehouse`.

use super::super::World;
use super::hall::hall;
use super::layout::Layout;
use super::settings::{WAREHOUSE_ROBOTS, Warehouse, WarehouseError};

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
        let plan = Layout::of(self.robots);
        let mut world = hall(self, &plan);
        for bay in 0..plan.bays {
            super::bay::furnish(&mut world, self, &plan, bay);
        }
        Ok(world)
    }
}
