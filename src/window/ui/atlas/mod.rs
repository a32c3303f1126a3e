//! The world atlas in the window.

mod atlas_space;
mod chart;
mod editing;
mod entering;
mod field;
mod panel;
mod putting;
mod shown;
mod state;
pub(crate) mod view;

pub use state::{AtlasState, FIRST_CELL, Mode};
