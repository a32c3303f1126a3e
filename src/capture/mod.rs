//! Captures: a widget's view as a figure for a page, as SVG, PNG or GIF.

#[cfg(feature = "cli")]
mod files;

#[cfg(feature = "cli")]
pub use files::{film, film_with_robots, paint, slides, write};
pub use motion_lab_sim::capture::*;
