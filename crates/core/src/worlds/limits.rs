//! Limits on world files.

/// The version of the world format that is read and written.
pub const WORLD_VERSION: u64 = 1;

/// Largest number of shapes in a world, and of items in each of its lists. Each segment of a polyline and each convex
/// piece of a concave polygon counts as a shape.
pub const MAX_ITEMS: usize = 100_000;
