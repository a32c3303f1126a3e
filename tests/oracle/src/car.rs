//! The kinematics of a car with a trailer, in closed form.

use motion_lab_core::num::{ln, tan};

/// The time in which a car that backs straight up folds from `from` to `to`: f' = (v / d) sin f, so tan(f / 2) grows as
/// exp(v t / d).
pub fn time_to_fold(from: f64, to: f64, v: f64, d: f64) -> f64 {
    d / v * ln(tan(0.5 * to) / tan(0.5 * from))
}
