//! The world atlas in the window.

mod editing;
mod state;
pub(crate) mod view;

pub use state::AtlasState;

/// The side of a grid cell at first, metres.
pub const FIRST_CELL: f64 = 0.25;
