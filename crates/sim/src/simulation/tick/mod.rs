//! The systems of a tick: input, drive, cut, settle, sense.

pub(crate) mod crowd;
pub(crate) mod drive;
pub(crate) mod hold;
pub(crate) mod input;
pub(crate) mod parallel;
pub(crate) mod phase_states;
pub(crate) mod refusals;
pub(crate) mod sense;
pub(crate) mod settle;
pub(crate) mod swept_set;
pub(crate) mod world_crowds;

#[cfg(test)]
mod tests;
