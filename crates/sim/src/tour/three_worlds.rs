//! The tour of the book: the three worlds for a minute.

use super::TourConfig;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;

impl Default for TourConfig {
    /// The Apartment, the Workbench and the Lot for 1,200 ticks, 60 s at 20 Hz, with a sensor of 360 rays and 4 m on
    /// Rusty.
    fn default() -> Self {
        TourConfig {
            worlds: vec![World::apartment(), World::workbench(), World::lot()],
            ticks: 1200,
            sensor: Some(RangeSensor { n_rays: 360, max_range: 4.0 }),
        }
    }
}
