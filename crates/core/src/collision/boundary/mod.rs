//! The boundary of a scene: what rays meet.

pub(crate) mod grid;
pub(crate) mod segments;
