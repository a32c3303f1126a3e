//! Where a trailer points behind a car that has followed its route for long.

use crate::num::{rk4, sin, wrap};
use crate::worlds::RoutePath;

/// How long before the car's place the trailer is put straight, in hitch lengths: an error falls by `e` in each.
const BEFORE: f64 = 20.0;
/// Integration steps per hitch length.
const STEPS: f64 = 10.0;

/// The heading of the trailer, its axle `hitch_len` metres behind the hitch, of a car whose hitch has followed the line
/// for long and is `s` metres along it: `d psi / ds = sin(theta - psi) / hitch_len`.
pub(super) fn trailer_heading(path: &RoutePath, s: f64, hitch_len: f64) -> f64 {
    let from = s - BEFORE * hitch_len;
    let rate = |s: f64, psi: f64| sin(path.at(s).theta - psi) / hitch_len;
    wrap(rk4(rate, path.at(from).theta, from, BEFORE * hitch_len, (BEFORE * STEPS) as u32))
}
