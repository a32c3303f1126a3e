//! The certified march: a motion proven free piece by piece, or bracketed where it hits.

use super::{Certificate, Collision, EdgeVerdict, MarchOptions, ObstacleId, ProvenStep, UnresolvedReason};
use crate::geometry::{Footprint, Part, Pose2, Shape, largest_coordinate};
use crate::num::{greater, lesser, ulp};
use crate::robots::Motion;

/// A hit is bracketed to this much motion, metres, where the footprint meets the obstacle head-on.
pub const BRACKET: f64 = 1e-6;

/// The clearance that one step from `s0` to `s1` proves, given the two footprints; not positive when it proves nothing.
///
/// Between `s0` and `s1` each part stays within its sagitta of the convex hull of its two placed cores. So the distance from
/// that hull to the obstacles, less the sagitta, is a lower bound of the clearance. A further 32 ulps are taken off: 16 that the
/// distance may err by, the rest for the rounding of the placed vertices.
pub(super) fn step_clearance<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    (s0, f0): (f64, &Footprint),
    (s1, f1): (f64, &Footprint),
) -> f64 {
    let mut least = f64::INFINITY;
    for (k, (p0, p1)) in f0.parts().iter().zip(f1.parts()).enumerate() {
        let hull = p0.placed().hull_with(p1.placed());
        let size = largest_coordinate([&hull]);
        let shape = Shape::Hull { vertices: hull.core().into(), radius: hull.radius() };
        let dist = collision.distance(&Footprint::new([Part::new(Pose2::IDENTITY, shape)]));
        let slack = if dist.is_finite() { 32.0 * ulp(size + dist) } else { 0.0 };
        least = lesser(dist - motion.sagitta(k, s0, s1) - slack, least);
        if least <= 0.0 {
            break;
        }
    }
    least
}

/// How far any part can move between `s0` and `s1`, metres.
fn width<M: Motion>(motion: &M, parts: usize, s0: f64, s1: f64) -> f64 {
    (0..parts).fold(0.0, |w, k| greater(motion.bound(k, s0, s1), w))
}

/// Whether a motion keeps its clearance above `options.margin`, by proof.
///
/// The march goes from 0 to 1 in steps each proven by [`Motion::sagitta`] and one `distance` query per part, halving where a
/// proof fails and growing where it succeeds. Near a grazed obstacle the sagitta is of second order in the step, so sliding
/// along a wall stays cheap; a translation or a disc's straight line is proven in one step. Where the far end of a failed step is
/// in contact, the hit is bracketed between the last proven point and that contact; a bracket of at most [`BRACKET`] of motion
/// ends the march.
pub fn march<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    options: MarchOptions,
    mut certificate: Option<&mut Certificate>,
) -> EdgeVerdict {
    if let Some(c) = certificate.as_deref_mut() {
        c.clear(options.margin);
    }
    let margin = options.margin;
    let start = motion.footprint_at(0.0);
    let parts = start.parts().len();
    let in_contact = |footprint: &Footprint| collision.distance(footprint) <= margin;
    let hit = |free_until: f64, contact_at: f64| {
        let (part, obstacle) = collision
            .witness(&motion.footprint_at(contact_at))
            .map_or((0, ObstacleId::UNKNOWN), |w| (w.part, w.obstacle));
        EdgeVerdict::Hit { free_until, contact_at, part, obstacle }
    };
    if in_contact(&start) {
        return hit(0.0, 0.0);
    }
    let end = motion.footprint_at(1.0);
    let size = largest_coordinate(start.parts().iter().chain(end.parts()).map(Part::placed));
    let finest = 64.0 * ulp(size);
    // the first place known to be in contact; nothing beyond it matters
    let mut contact = in_contact(&end).then_some(1.0);
    let (mut lo, mut at_lo, mut h) = (0.0, start, 1.0);
    let mut clearance = f64::INFINITY;
    let mut steps = 0;
    loop {
        let limit = contact.unwrap_or(1.0);
        let hi = if lo + h < limit { lo + h } else { limit };
        let reach = width(motion, parts, lo, limit);
        if steps == options.budget {
            return EdgeVerdict::Unresolved { free_until: lo, gap: reach, reason: UnresolvedReason::Budget };
        }
        steps += 1;
        let at_hi = if hi == 1.0 { end.clone() } else { motion.footprint_at(hi) };
        let proven = if contact == Some(hi) {
            0.0 // its far end is in contact: there is nothing to prove
        } else {
            step_clearance(collision, motion, (lo, &at_lo), (hi, &at_hi))
        };
        if proven > margin {
            clearance = lesser(proven, clearance);
            if let Some(c) = certificate.as_deref_mut() {
                c.push(ProvenStep { from: lo, to: hi, clearance: proven });
            }
            if hi == 1.0 {
                return EdgeVerdict::Free { clearance };
            }
            (lo, at_lo) = (hi, at_hi);
            h = contact.map_or(2.0 * h, |c| 0.5 * (c - lo));
            if contact.is_some_and(|c| width(motion, parts, lo, c) <= BRACKET) {
                return hit(lo, limit);
            }
            continue;
        }
        if contact != Some(hi) && in_contact(&at_hi) {
            contact = Some(hi);
        }
        let span = width(motion, parts, lo, hi);
        if contact == Some(hi) && span <= BRACKET {
            return hit(lo, hi);
        }
        let middle = lo + 0.5 * (hi - lo);
        if span <= finest || middle <= lo || middle >= hi {
            // Nothing finer can be told apart here. A contact known farther on still makes it a hit, in a wider bracket.
            return match contact {
                Some(c) => hit(lo, c),
                None => EdgeVerdict::Unresolved { free_until: lo, gap: reach, reason: UnresolvedReason::Tolerance },
            };
        }
        h = 0.5 * (hi - lo);
    }
}
