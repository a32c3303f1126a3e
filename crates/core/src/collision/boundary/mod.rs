//! The boundary of a scene: what rays meet.

pub(crate) mod grid;
mod occluder;
pub(crate) mod scene_boundary;
pub(crate) mod segments;
pub(crate) mod sight;
