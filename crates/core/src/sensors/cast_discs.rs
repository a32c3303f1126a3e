//! Rays that meet a disc.

use super::rays::{Fan, Rays, raised, some};
use super::view::View;
use super::wedges::turns;
use crate::collision::{Circle, LANES};
use crate::num::sqrt;

/// An upper bound on the errors of the two bearings together, in turns.
const BEARINGS_ERROR: f64 = 1e-5;

/// A disc as the sensor sees it from outside.
#[derive(Clone, Copy)]
struct Disc {
    /// Its centre from the sensor, metres.
    cx: f64,
    cy: f64,
    /// The square of its radius.
    r2: f64,
    /// The square of the centre's distance, less `r2`: positive.
    outside: f64,
}

/// Raises the inverse range of every ray that meets the disc, that is of every ray between its two tangents.
#[inline(always)]
pub(super) fn raise_circle(circle: &Circle, view: &View, fan: &mut Fan) {
    let (cx, cy, r) = (circle.centre.x - view.origin.x, circle.centre.y - view.origin.y, circle.radius);
    let (d2, r2) = (cx * cx + cy * cy, r * r);
    let outside = d2 - r2; // positive: the origin is not inside
    if outside <= 0.0 || sqrt(d2) - r > view.reach {
        return;
    }
    let (middle, half) = (turns(cx, cy) - view.heading, turns(sqrt(outside), r) + BEARINGS_ERROR);
    let forward = |turns: f64| if turns < 0.0 { turns + 1.0 } else { turns };
    let begin = forward(forward(middle) - half);
    let end = begin + 2.0 * half;
    let disc = Disc { cx, cy, r2, outside };
    let block = |turns: f64| (turns * view.rays) as usize / LANES;
    // beyond a full turn the rays begin again; one loop for both stretches, because a function of its own would not be
    // compiled for the instructions of this one
    let stretches = [(begin, end), (0.0, end - 1.0)];
    for (from, to) in stretches.into_iter().take(if end >= 1.0 { 2 } else { 1 }) {
        for block in some(&mut fan.blocks, block(from)..block(to) + 1) {
            meet(block, disc, view.nothing);
        }
    }
}

/// Raises those of eight rays that meet the disc.
#[inline(always)]
fn meet(rays: &mut Rays, disc: Disc, nothing: f64) {
    let Disc { cx, cy, r2, outside } = disc;
    for ((dx, dy), inverse) in rays.dx.iter().zip(&rays.dy).zip(&mut rays.inverse) {
        let along = cx * dx + cy * dy;
        let across = cx * dy - cy * dx;
        let half = r2 - across * across;
        // the nearer root of t^2 - 2 t along + outside = 0, as 1/t = (along + sqrt(half)) / outside
        let value = if (along > 0.0) & (half >= 0.0) { (along + sqrt(half)) / outside } else { 0.0 };
        *inverse = raised(*inverse, value, nothing);
    }
}
