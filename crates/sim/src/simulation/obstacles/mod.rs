//! The obstacles and doors of a run: entities, their state, and the scenes that follow from them.

pub(crate) mod change;
pub(crate) mod dress;
mod number_set;
pub(crate) mod roster;
mod standing;
mod standing_parts;
pub(crate) mod start;
pub(crate) mod sync;
