//! What became of many runs, as figures.

mod boxes;
mod confidence;
mod histogram;
mod quartiles;

pub use boxes::{ByValue, boxes};
pub use confidence::ConfidenceInterval;
pub use histogram::{Distribution, histograms};
pub use quartiles::Quartiles;
