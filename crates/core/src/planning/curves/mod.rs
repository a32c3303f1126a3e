//! The shortest curves of a car among no obstacles: Dubins's, which only go ahead, and Reeds and Shepp's, which also go
//! back.

mod curve;
mod dubins;
mod reeds_shepp;
#[cfg(test)]
mod tests;

pub use curve::{Curve, CurvePiece, Turn};
pub use dubins::dubins;
pub use reeds_shepp::reeds_shepp;
