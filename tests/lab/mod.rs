//! The lab beside its program: examples, words, letters, grading, and the scripts of the gate.

mod anatomy;
#[cfg(feature = "cli")]
mod atlas;
pub mod examples;
#[cfg(feature = "window")]
mod frames;
#[cfg(all(unix, feature = "cli"))]
mod gate;
mod grading;
mod letters;
#[cfg(feature = "cli")]
mod studies;
mod words;
