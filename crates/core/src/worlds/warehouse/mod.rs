//! `Warehouse`, a generated world of up to 100,000 robots that never meet.
//!
//! A bay holds four aisles that rovers drive round, eight cells with an arm each, and a road about all that for cars.
//! Rovers and cars follow [routes](super::Route), which do not cross; arms stay within their cells. So nobody comes
//! near anybody, however long the run. A hall has as many bays as its robots need.

mod bay;
mod generator;
mod hall;
mod layout;
mod settings;
#[cfg(test)]
mod tests;
mod trailer;

pub use settings::{WAREHOUSE_ROBOTS, Warehouse, WarehouseError};
