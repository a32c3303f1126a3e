//! The world atlas in the window.

mod editing;
mod entering;
mod field;
mod panel;
mod shown;
mod state;
pub(crate) mod view;

pub use state::{AtlasState, FIRST_CELL, Mode};
