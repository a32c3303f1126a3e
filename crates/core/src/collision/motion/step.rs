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
        let (size, sagitta) = (largest_coordinate([&hull]), motion.sagitta(k, from.s, to.s));
        // a distance that proves more than the parts before do changes nothing
        let dist = collision.distance_of_hull_within(hull, proving(least, sagitta, size));
        least = least_proven(dist - sagitta - rounding(size, dist), least);
        if least <= 0.0 {
            break;
        }
    }
    least
}

/// The least of what is proven for one part and for others, metres. NaN, as of a bound that is none, proves nothing
/// whatever the other parts are: then it is 0.
pub(crate) fn least_proven(proven: f64, least: f64) -> f64 {
    if proven.is_nan() { 0.0 } else { lesser(proven, least) }
}

/// A distance that certainly proves more than this clearance, and so does every greater one, metres; infinity for an
/// infinite clearance. Four times the rounding is added: the rounding may double with the distance.
fn proving(clearance: f64, sagitta: f64, size: f64) -> f64 {
    let reach = clearance + sagitta;
    reach + 4.0 * rounding(size, reach)
}

/// What a step's proof subtracts for rounding from the distance of a hull whose coordinates are at most `size`, metres.
pub(crate) fn rounding(size: f64, distance: f64) -> f64 {
    if distance.is_finite() { 32.0 * ulp(size + distance) } else { 0.0 }
}
