//! The world atlas in the window.

mod editing;
mod state;
pub(crate) mod view;

pub use state::{AtlasState, GRID};
