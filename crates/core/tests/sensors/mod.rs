//! Range sensors.

mod rays;
mod scan_shapes;
mod scan_worlds;
mod scans;
