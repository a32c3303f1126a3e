//! The short way of an angle.

use std::f64::consts::{PI, TAU};

/// The short way from `a` to `b`, radians; exactly half a turn goes the positive way.
pub fn short(a: f64, b: f64) -> f64 {
    let d = (b - a) % TAU;
    if d > PI {
        d - TAU
    } else if d <= -PI {
        d + TAU
    } else {
        d
    }
}
