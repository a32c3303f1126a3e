//! The narrow phase: one pair of convex shapes, exact about contact.

pub(crate) mod convex;
pub(crate) mod core_lanes;
pub(crate) mod distance;
pub(crate) mod double_double;
pub(crate) mod half_planes;
pub(crate) mod nearest;
pub(crate) mod pair;
pub(crate) mod separating_line;
