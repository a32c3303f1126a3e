//! `SinCos`, the sine and the cosine of an angle.

use crate::num;

/// The sine and the cosine of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SinCos {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl SinCos {
    /// Those of an angle in radians.
    #[inline]
    pub(crate) fn of(angle: f64) -> Self {
        let (sin, cos) = num::sin_cos(angle);
        SinCos { sin, cos }
    }
}
