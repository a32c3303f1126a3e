//! Worlds: lists of named geometry, never bitmaps.

mod model;

pub use model::{Bounds, Mark, Obstacle, ObstacleKind, Place, Resident, World};
