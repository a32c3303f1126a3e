//! The world atlas in the window.

mod editing;
mod entering;
mod field;
mod panel;
mod shown;
mod state;
pub(crate) mod view;

pub use state::{AtlasState, Mode};

/// The side of a grid cell at first, metres.
pub const FIRST_CELL: f64 = 0.25;
