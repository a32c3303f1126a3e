//! The sensors of a run: which are in it, in which order, and what they read.

mod changes;
pub(super) mod refusal;
pub(super) mod roster;
pub(crate) mod scanners;
pub(super) mod start;
pub(super) mod view;

pub(super) use changes::{changed, removed};
