//! Grids derived from worlds.

pub(crate) mod cells;
pub(crate) mod distance_transform;
pub(crate) mod rasterize;
pub(crate) mod ros_export;
pub(crate) mod voronoi;
