//! `Quantized`, a coordinate as scripts hold it.

use serde::{Deserialize, Serialize};

/// A captured coordinate, metres or radians in units of 2^-20: `Quantized(1 << 20)` is 1. The rounding keeps pixels out
/// of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Quantized(pub i64);

impl Quantized {
    /// Units per metre or radian.
    pub const UNITS: f64 = 1_048_576.0;

    /// The nearest quantized value (ties to even); `None` unless finite and below 9.1e15 units in size, a little above
    /// 2^33.
    pub fn try_new(value: f64) -> Option<Self> {
        let scaled = (value * Self::UNITS).round_ties_even();
        (scaled.abs() < 9.1e15).then_some(Quantized(scaled as i64))
    }

    /// The value in metres or radians; exact up to 2^53 units.
    pub fn value(self) -> f64 {
        self.0 as f64 / Self::UNITS
    }
}
