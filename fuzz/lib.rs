//! The targets, as the lab's own tests have them.

#[path = "../tests/fuzz/mod.rs"]
pub mod targets;
