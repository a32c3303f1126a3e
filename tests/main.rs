//! The whole-system tests: one binary, a module per subject.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

mod fixtures;
mod oracle;

mod failsafe;
mod metamorphic;
mod pairs;
mod penetration;
mod polygons;
mod sweeps;
mod touches;
