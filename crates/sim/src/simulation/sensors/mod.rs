//! The sensors of a run: which are in it, in which order, and what they read.

pub(super) mod dress;
mod named;
pub(super) mod refusal;
pub(super) mod roster;
pub(crate) mod scanners;
pub(super) mod start;
pub(super) mod view;
mod write;

pub(super) use named::OfConfiguration;
