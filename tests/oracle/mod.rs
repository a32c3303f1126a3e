//! Two implementations of the collision questions that share no geometry code with the library: [`exact`], integer
//! arithmetic without any rounding (and [`ray`], the same for scans), and [`plain`], everyday `f64` by other methods than the library's.
//!
//! Both take placed shapes as they are, a list of core vertices and a radius, and nothing else from the library. [`arm`] writes out the kinematics of
//! the Workbench's arm for them.

use std::f64::consts::{PI, TAU};

#[cfg(feature = "sim")]
pub mod arm;
pub mod exact;
pub mod plain;
pub mod ray;
pub mod sweep;

/// The short way from `a` to `b`, radians; of exactly half a turn the positive way.
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
