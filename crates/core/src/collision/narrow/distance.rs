//! The narrow phase: contact and distance between two placed shapes, closed forms for every pair.

use super::convex::{
    NearestPoints, cores_contact, cores_distance, edges, point_segment, polygon_contains, segments_contact,
};
use super::core_lanes::Measured;
use super::double_double::Dd;
use super::separating_line::{SureParting, parted_distance};
use crate::geometry::{Placed, Point2, Segment, largest_coordinate};
use crate::num::{greater, lesser, sqrt, ulp};
use std::cmp::Ordering;

/// The nearest points of `a` and `b`, both valid.
///
/// A shape with a radius is its core's exact distance minus the radius. Where the rounded distance cannot tell contact
/// from a gap, squares are compared in double-double arithmetic.
pub(crate) fn nearest(a: &Placed, b: &Placed) -> NearestPoints {
    nearest_within(a, b, f64::INFINITY).unwrap_or_else(|| {
        // reached only if a distance is NaN, which valid shapes never give
        let point = a.core()[0];
        NearestPoints { dist: 0.0, on_a: point, on_b: point }
    })
}

/// As [`nearest`]; `None` only where the distance is greater than `limit`.
pub(crate) fn nearest_within(a: &Placed, b: &Placed, limit: f64) -> Option<NearestPoints> {
    if let Some(point) = cores_contact(a.core(), b.core()) {
        return Some(NearestPoints { dist: 0.0, on_a: point, on_b: point });
    }
    nearest_apart(a, b, cores_distance(a.core(), b.core(), core_limit(a, b, limit))?)
}

/// As [`nearest_within`], for shapes whose cores a line certainly separates.
pub(crate) fn nearest_across(a: &Placed, b: &Placed, limit: f64, parting: &SureParting) -> Option<NearestPoints> {
    nearest_apart(a, b, parted_distance(a.core(), b.core(), core_limit(a, b, limit), parting)?)
}

/// As [`nearest_across`], for shapes whose cores were measured side by side.
pub(crate) fn nearest_measured(a: &Placed, b: &Placed, limit: f64, cores: &Measured) -> Option<NearestPoints> {
    nearest_apart(a, b, cores.nearest(core_limit(a, b, limit))?)
}

/// The limit for the cores' distance: the limit for the shapes' distance plus the radii, and more than rounding.
fn core_limit(a: &Placed, b: &Placed, limit: f64) -> f64 {
    (limit + (a.radius() + b.radius())) * (1.0 + 1e-9) + 1e-9
}

/// The nearest points of two shapes whose cores are disjoint, given those of the cores.
fn nearest_apart(a: &Placed, b: &Placed, cores: NearestPoints) -> Option<NearestPoints> {
    let NearestPoints { dist: core_dist, on_a: foot_a, on_b: foot_b } = cores;
    let reach = a.radius() + b.radius();
    let core_dist = greater(core_dist, f64::MIN_POSITIVE); // disjoint, whatever was lost to underflow
    if reach == 0.0 {
        return Some(NearestPoints { dist: core_dist, on_a: foot_a, on_b: foot_b });
    }
    let direction = (foot_b - foot_a) / core_dist;
    let margin = 64.0 * ulp(largest_coordinate([a, b]));
    let gap = core_dist - reach;
    let gap = if gap > margin {
        Some(gap)
    } else if gap < -margin {
        None
    } else {
        decided_gap(a, b)
    };
    Some(match gap {
        Some(dist) => NearestPoints {
            dist: greater(dist, f64::MIN_POSITIVE),
            on_a: foot_a + direction * a.radius(),
            on_b: foot_b - direction * b.radius(),
        },
        None => {
            // within a's radius of its foot, and within b's radius of the other foot
            let point = foot_a + direction * lesser(a.radius(), core_dist);
            NearestPoints { dist: 0.0, on_a: point, on_b: point }
        }
    })
}

/// Whether `a` and `b`, both valid, touch: exactly when [`nearest`] says 0.
pub(crate) fn touch(a: &Placed, b: &Placed) -> bool {
    if a.radius() + b.radius() == 0.0 {
        return cores_contact(a.core(), b.core()).is_some();
    }
    // what is farther than this is apart in spite of all rounding
    let apart = 128.0 * ulp(largest_coordinate([a, b]));
    nearest_within(a, b, apart).is_some_and(|near| near.dist == 0.0)
}

/// The gap between two shapes whose cores are disjoint, or `None` on contact: squares compared in double-double.
///
/// Exact while the products fit 106 bits; beyond that a difference below 2^-94 of the compared squares counts as
/// contact.
fn decided_gap(a: &Placed, b: &Placed) -> Option<f64> {
    let reach = Dd::sum(a.radius(), b.radius());
    let mut least = f64::INFINITY;
    for &p in a.core() {
        for edge in edges(b.core()) {
            least = lesser(point_segment_gap(p, edge, reach)?, least);
        }
    }
    for &q in b.core() {
        for edge in edges(a.core()) {
            least = lesser(point_segment_gap(q, edge, reach)?, least);
        }
    }
    Some(least)
}

/// How much farther than `reach` the point is from the segment; `None` when it is not farther.
fn point_segment_gap(p: Point2, segment: Segment, reach: Dd) -> Option<f64> {
    let Segment { a, b } = segment;
    let vector = |to: Point2, from: Point2| (Dd::difference(to.x, from.x), Dd::difference(to.y, from.y));
    let dot = |u: (Dd, Dd), v: (Dd, Dd)| u.0.mul(v.0).add(u.1.mul(v.1));
    let (u, from_a, from_b) = (vector(b, a), vector(p, a), vector(p, b));
    let reach_squared = reach.mul(reach);
    // distance^2 * scale against reach^2 * scale
    let (square, scale) = if dot(from_a, u).sign() != Ordering::Greater {
        (dot(from_a, from_a), Dd::sum(1.0, 0.0))
    } else if dot(from_b, u).sign() != Ordering::Less {
        (dot(from_b, from_b), Dd::sum(1.0, 0.0))
    } else {
        let area = u.0.mul(from_a.1).sub(u.1.mul(from_a.0));
        (area.mul(area), dot(u, u))
    };
    let difference = square.sub(reach_squared.mul(scale));
    if difference.hi <= square.hi * 5e-29 {
        return None;
    }
    let dist = sqrt(square.hi / scale.hi);
    Some(difference.hi / scale.hi / (dist + reach.hi))
}

/// A lower bound on how far every point of `a` may have to move before it can be free of `b`; 0 when they are apart.
///
/// Two bounds, each valid for any displacement that moves no point of `a` by more than it:
/// - a point of one core at signed distance `sd` from the other core (negative inside): radii minus `sd`;
/// - two crossing edges: the least distance from an end of either to the other edge, plus the radii.
pub(crate) fn depth(a: &Placed, b: &Placed) -> f64 {
    if nearest(a, b).dist > 0.0 {
        return 0.0;
    }
    let radii = a.radius() + b.radius();
    let inside = |p: Point2, core: &[Point2]| {
        let boundary = edges(core).fold(f64::INFINITY, |d, e| lesser(point_segment(p, e).0, d));
        radii + if polygon_contains(core, p) { boundary } else { -boundary }
    };
    let mut bound = 0.0;
    for (from, to) in [(a.core(), b.core()), (b.core(), a.core())] {
        for Segment { a: p, b: q } in edges(from) {
            for weight in [0.0, 0.25, 0.5, 0.75] {
                bound = greater(inside(p + (q - p) * weight, to), bound);
            }
            bound = greater(inside(q, to), bound);
        }
    }
    for p in edges(a.core()) {
        for q in edges(b.core()) {
            if segments_contact(p, q).is_some() {
                let ends = [(p.a, q), (p.b, q), (q.a, p), (q.b, p)];
                let least = ends.iter().fold(f64::INFINITY, |d, (end, e)| lesser(point_segment(*end, *e).0, d));
                bound = greater(least + radii, bound);
            }
        }
    }
    greater(bound - 64.0 * ulp(largest_coordinate([a, b])), 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(x: f64, y: f64, r: f64) -> Placed {
        Placed::new([Point2::new(x, y)], r)
    }

    #[test]
    fn discs_that_touch_are_in_contact_and_one_ulp_apart_are_not() {
        // 3-4-5: exactly tangent
        assert_eq!(nearest(&disc(0.0, 0.0, 2.0), &disc(3.0, 4.0, 3.0)).dist, 0.0);
        let wider = f64::from_bits(4.0_f64.to_bits() + 1);
        let apart = nearest(&disc(0.0, 0.0, 2.0), &disc(3.0, wider, 3.0));
        assert!(apart.dist > 0.0 && apart.dist < 1e-15, "{apart:?}");
    }

    /// Beside the middle of a long segment the rounding of a distance is far more than a nanometre.
    #[test]
    fn what_touches_has_no_distance_however_long_it_is() {
        let mut touching = 0;
        for (long, k) in [1.0, 1e3, 1e9].into_iter().flat_map(|long| (0..4000).map(move |k| (long, f64::from(k)))) {
            let a = Placed::new([Point2::origin(), Point2::new(long, 0.37 * long)], 0.0625);
            // beyond the middle by a radius of either, and by a few roundings
            let (along, across) = (0.4 * long + k * 1e-3, 0.125 + (k % 7.0 - 3.0) * 0.25 * ulp(long));
            let unit = 1.0 / sqrt(1.0 + 0.37 * 0.37);
            let b = disc(along - 0.37 * unit * across, 0.37 * along + unit * across, 0.0625);
            assert_eq!(touch(&a, &b), nearest(&a, &b).dist == 0.0, "{long} {k}");
            touching += u32::from(touch(&a, &b));
        }
        assert!(touching > 3000 && touching < 9000, "{touching}");
    }

    #[test]
    fn the_common_point_lies_in_both() {
        let (a, b) = (disc(0.0, 0.0, 0.5), disc(1.0, 0.0, 2.0));
        let n = nearest(&a, &b);
        assert_eq!((n.dist, n.on_a), (0.0, n.on_b));
        assert!((n.on_a - a.core()[0]).norm() <= 0.5 && (n.on_a - b.core()[0]).norm() <= 2.0);
    }

    #[test]
    fn depth_of_a_disc_in_a_box_is_its_way_out_at_least() {
        let square = Placed::new(
            [Point2::new(-1.0, -1.0), Point2::new(1.0, -1.0), Point2::new(1.0, 1.0), Point2::new(-1.0, 1.0)],
            0.0,
        );
        let d = depth(&disc(0.5, 0.0, 0.25), &square);
        assert!((d - 0.75).abs() < 1e-12, "out to the right takes 0.5 + 0.25, got {d}");
        assert_eq!(depth(&disc(2.0, 0.0, 0.25), &square), 0.0);
    }
}
