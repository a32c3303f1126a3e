//! What one step of a march proves.

use super::place::At;
use crate::collision::Collision;
use crate::geometry::largest_coordinate;
use crate::num::{lesser, ulp};
use crate::robots::Motion;

/// The clearance that one step between two places proves, metres; not positive when it proves nothing.
///
/// Between the two places each part stays within its sagitta of the convex hull of its two placed cores. So the
/// distance from that hull to the obstacles, less the sagitta, is a lower bound of the clearance. Another 32 ulps are
/// subtracted: 16 that the distance may err by, the rest for the rounding of the placed vertices.
pub(crate) fn step_clearance<M: Motion>(collision: &dyn Collision, motion: &M, from: At, to: At) -> f64 {
    let mut least = f64::INFINITY;
    for (k, (p0, p1)) in from.footprint.parts().iter().zip(to.footprint.parts()).enumerate() {
        let hull = p0.placed().hull_with(p1.placed());
        let size = largest_coordinate([&hull]);
        let dist = collision.distance_of_hull(hull);
        let proven = dist - motion.sagitta(k, from.s, to.s) - rounding(size, dist);
        // a NaN bound proves nothing, whatever the other parts are
        least = if proven.is_nan() { 0.0 } else { lesser(proven, least) };
        if least <= 0.0 {
            break;
        }
    }
    least
}

/// What a step's proof subtracts for rounding from the distance of a hull whose coordinates are at most `size`, metres.
pub(crate) fn rounding(size: f64, distance: f64) -> f64 {
    if distance.is_finite() { 32.0 * ulp(size + distance) } else { 0.0 }
}
