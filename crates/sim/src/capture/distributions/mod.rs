//! What became of many runs, as figures.

mod boxes;
mod histogram;
mod quartiles;

pub use boxes::{ByValue, boxes};
pub use histogram::{Distribution, histograms};
pub use quartiles::Quartiles;
