//! Exact contact and accurate distance between two convex cores (points, segments, polygons) without radii.

use crate::geometry::{Aabb, Point2, Segment, cross, orientation};
use crate::num::{greater, lesser, sqrt};

/// The nearest points of two shapes, or of two cores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NearestPoints {
    /// The distance, metres. Of two shapes it is exactly 0 on contact, and only then.
    pub(crate) dist: f64,
    /// The point of the first shape or core.
    pub(crate) on_a: Point2,
    /// The point of the second shape or core; on contact the same point.
    pub(crate) on_b: Point2,
}

/// The boundary edges of a core: a point is one edge of length 0, a segment one edge, a polygon all its sides.
pub(crate) fn edges(core: &[Point2]) -> impl Iterator<Item = Segment> {
    let n = core.len();
    (0..if n <= 2 { 1 } else { n }).map(move |i| Segment { a: core[i], b: core[(i + 1) % n] })
}

/// Whether `p` lies in the closed box around a segment.
fn in_box(segment: Segment, p: Point2) -> bool {
    let Segment { a, b } = segment;
    let between = |a: f64, b: f64, x: f64| if a <= b { a <= x && x <= b } else { b <= x && x <= a };
    between(a.x, b.x, p.x) && between(a.y, b.y, p.y)
}

/// The point of the closed box around a segment that is nearest to `p`.
fn into_box(segment: Segment, p: Point2) -> Point2 {
    let Segment { a, b } = segment;
    let clamp = |x: f64, a: f64, b: f64| if a <= b { x.clamp(a, b) } else { x.clamp(b, a) };
    Point2::new(clamp(p.x, a.x, b.x), clamp(p.y, a.y, b.y))
}

/// A common point of two closed segments, decided exactly; an end point itself where an end touches.
pub(crate) fn segments_contact(p: Segment, q: Segment) -> Option<Point2> {
    let (p0, p1) = (orientation(q.a, q.b, p.a), orientation(q.a, q.b, p.b));
    if (p0 > 0.0 && p1 > 0.0) || (p0 < 0.0 && p1 < 0.0) {
        return None;
    }
    let (q0, q1) = (orientation(p.a, p.b, q.a), orientation(p.a, p.b, q.b));
    if (q0 > 0.0 && q1 > 0.0) || (q0 < 0.0 && q1 < 0.0) {
        return None;
    }
    let ends = [(p0, q, p.a), (p1, q, p.b), (q0, p, q.a), (q1, p, q.b)];
    for (side, other, end) in ends {
        if side == 0.0 && in_box(other, end) {
            return Some(end);
        }
    }
    if p0 != 0.0 && p1 != 0.0 && q0 != 0.0 && q1 != 0.0 {
        // They cross properly: the sides have opposite signs, so the weight is in (0, 1). Measured along the shorter
        // one, and kept in both boxes, the point stays near both even when they are all but collinear.
        let along_p = (p.b - p.a).norm_squared() <= (q.b - q.a).norm_squared();
        let (Segment { a, b }, weight) = if along_p { (p, p0 / (p0 - p1)) } else { (q, q0 / (q0 - q1)) };
        return Some(into_box(q, into_box(p, a + (b - a) * weight)));
    }
    None
}

/// Whether `p` lies in the closed polygon, decided exactly (crossing number); the polygon need only be simple.
pub(crate) fn polygon_contains(polygon: &[Point2], p: Point2) -> bool {
    if polygon.len() < 3 {
        return false;
    }
    let mut inside = false;
    for edge in edges(polygon) {
        let Segment { a, b } = edge;
        if (a.y > p.y) != (b.y > p.y) {
            let side = orientation(a, b, p);
            if side == 0.0 {
                return true;
            }
            if (side > 0.0) == (b.y > a.y) {
                inside = !inside;
            }
        } else if orientation(a, b, p) == 0.0 && in_box(edge, p) {
            return true;
        }
    }
    inside
}

/// A separation test for two cores: by the boxes around them, then by the lines through their sides. `false` is
/// inconclusive.
fn plainly_apart(a: &[Point2], b: &[Point2]) -> bool {
    box_around(a).is_apart(&box_around(b)) || separates(a, b) || separates(b, a)
}

/// The cross product of an edge and the displacement from its first end to `v`, positive to the left. It is 0 where it
/// does not exceed several times the rounding it may hold, so that its sign is certain.
#[inline]
fn plain_side(edge: Segment, v: &Point2) -> f64 {
    let (u, w) = (edge.b - edge.a, v - edge.a);
    let (left, right) = (u.x * w.y, u.y * w.x);
    let area = left - right;
    let rounding = 16.0 * f64::EPSILON * (left.abs() + right.abs()) + f64::MIN_POSITIVE;
    if area.abs() <= rounding { 0.0 } else { area }
}

/// A separation test: whether the line through a side of `a` has all of `b` to its right and the rest of `a` to its
/// left, or, where `a` is a segment, all of `b` on one side. A cross product counts only where its sign is certain.
/// `false` is inconclusive.
fn separates(a: &[Point2], b: &[Point2]) -> bool {
    edges(a).any(|edge| {
        let Segment { a: p, b: q } = edge;
        let side = |v: &Point2| plain_side(edge, v);
        let right = b.iter().all(|v| side(v) < 0.0) && a.iter().all(|v| *v == p || *v == q || side(v) > 0.0);
        right || (a.len() == 2 && b.iter().all(|v| side(v) > 0.0))
    })
}

/// A conservative test for overlap: whether a vertex of one polygon is certainly inside the other. `false` is
/// inconclusive.
pub(crate) fn plainly_overlap(a: &[Point2], b: &[Point2]) -> bool {
    let inside = |polygon: &[Point2], p: &Point2| edges(polygon).all(|edge| plain_side(edge, p) > 0.0);
    (a.len() > 2 && b.iter().any(|p| inside(a, p))) || (b.len() > 2 && a.iter().any(|p| inside(b, p)))
}

/// A common point of two cores, or `None` when they are disjoint; exact.
pub(crate) fn cores_contact(a: &[Point2], b: &[Point2]) -> Option<Point2> {
    if plainly_apart(a, b) {
        return None;
    }
    for p in edges(a) {
        for q in edges(b) {
            if let Some(point) = segments_contact(p, q) {
                return Some(point);
            }
        }
    }
    if polygon_contains(b, a[0]) {
        Some(a[0])
    } else if polygon_contains(a, b[0]) {
        Some(b[0])
    } else {
        None
    }
}

/// The distance from `p` to the segment and the nearest point of it.
///
/// The distance to the segment's line is a cross product with the displacement from the nearer end, so its rounding is
/// a few ulps of that displacement; where it cancels, the adaptive predicate gives its value.
pub(crate) fn point_segment(p: Point2, segment: Segment) -> (f64, Point2) {
    point_segment_within(p, segment, f64::INFINITY).unwrap_or((f64::INFINITY, segment.a))
}

/// As [`point_segment`]; `None` where the square of the distance exceeds `square`. The distance to the line through the
/// segment has to exceed it by more than its rounding.
#[inline]
fn point_segment_within(p: Point2, segment: Segment, square: f64) -> Option<(f64, Point2)> {
    let Segment { a, b } = segment;
    let (u, from_a, from_b) = (b - a, p - a, p - b);
    let (along, rest) = (from_a.dot(&u), -from_b.dot(&u));
    if along <= 0.0 || rest <= 0.0 {
        let (apart, foot) = if along <= 0.0 { (from_a.norm_squared(), a) } else { (from_b.norm_squared(), b) };
        return (apart <= square).then(|| (sqrt(apart), foot));
    }
    let length_squared = u.norm_squared();
    let near_a = along <= rest;
    let w = if near_a { from_a } else { from_b };
    let mut area = cross(u, w);
    let rounding = 16.0 * f64::EPSILON * (u.x.abs() + u.y.abs()) * (w.x.abs() + w.y.abs());
    let plain = greater(area.abs() - 2.0 * rounding, 0.0);
    if plain * plain > square * length_squared {
        return None;
    }
    let foot = if near_a { a + u * (along / length_squared) } else { b - u * (rest / length_squared) };
    if area.abs() <= rounding {
        area = orientation(a, b, p);
    }
    Some((area.abs() / sqrt(length_squared), foot))
}

/// The distance between two disjoint cores and a pair of nearest points, if it is less than `limit`. It is attained at
/// a vertex of one of them.
pub(crate) fn cores_distance(a: &[Point2], b: &[Point2], limit: f64) -> Option<NearestPoints> {
    let mut closest = Closest::new(limit, between_vertices(a, b));
    let around = box_around(b);
    for &p in a {
        if around.is_farther(p, closest.square) {
            continue;
        }
        for edge in edges(b) {
            closest.look(p, edge, |p, foot| (p, foot));
        }
    }
    if a.len() > 1 {
        let around = box_around(a);
        for &q in b {
            if around.is_farther(q, closest.square) {
                continue;
            }
            for edge in edges(a) {
                closest.look(q, edge, |q, foot| (foot, q));
            }
        }
    }
    closest.found()
}

/// The square of the distance between the nearest vertices: an upper bound on the square of the cores' distance.
pub(crate) fn between_vertices(a: &[Point2], b: &[Point2]) -> f64 {
    a.iter().flat_map(|p| b.iter().map(move |q| (p - q).norm_squared())).fold(f64::INFINITY, lesser)
}

/// The box around a core, which has a vertex.
fn box_around(core: &[Point2]) -> Aabb {
    Aabb::around(core).unwrap_or(Aabb { min: core[0], max: core[0] })
}

/// The factor that makes up for the rounding of a square, and more.
const ROUNDED_UP: f64 = 1.0 + 1e-8;

/// The nearest pair of points so far.
pub(crate) struct Closest {
    pub(crate) least: f64,
    /// The square of the distance beyond which a pair cannot be the nearest, rounded up.
    square: f64,
    pair: Option<(Point2, Point2)>,
}

impl Closest {
    /// No pair yet. Only pairs nearer than `limit` count. Some pair is known to be no farther apart than the root of
    /// `between`.
    pub(crate) fn new(limit: f64, between: f64) -> Self {
        Closest { least: limit, square: lesser(between, limit * limit) * ROUNDED_UP, pair: None }
    }

    /// Takes a vertex and the nearest point of an edge, if no pair so far is nearer. Passes over an edge that is
    /// certainly too far to matter.
    #[inline]
    pub(crate) fn look(&mut self, p: Point2, edge: Segment, pair: impl Fn(Point2, Point2) -> (Point2, Point2)) {
        if let Some((d, foot)) = point_segment_within(p, edge, self.square)
            && d < self.least
        {
            (self.least, self.pair) = (d, Some(pair(p, foot)));
            self.square = lesser(self.square, d * d * ROUNDED_UP);
        }
    }

    /// The distance and the two points; `None` where no pair was nearer than the limit.
    pub(crate) fn found(self) -> Option<NearestPoints> {
        self.pair.map(|(on_a, on_b)| NearestPoints { dist: self.least, on_a, on_b })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    #[test]
    fn segments_meet_exactly_or_not_at_all() {
        let of = Segment::new;
        let base = of(p(0.0, 0.0), p(3.0, 1.0));
        assert_eq!(segments_contact(base, of(p(3.0, 1.0), p(4.0, 9.0))), Some(p(3.0, 1.0)), "shared end");
        assert_eq!(segments_contact(base, of(p(6.0, 2.0), p(9.0, 3.0))), None, "collinear, apart");
        assert!(segments_contact(base, of(p(1.5, 0.5), p(9.0, 3.0))).is_some(), "collinear, overlapping");
        assert!(segments_contact(base, of(p(1.0, -5.0), p(1.0, 5.0))).is_some(), "proper crossing");
        // parallel, one ulp apart
        let level = |y: f64| of(p(0.0, y), p(3.0, y));
        assert_eq!(segments_contact(level(1.0), level(f64::from_bits(1.0_f64.to_bits() + 1))), None);
        // degenerate: a point on the segment, a point beside it
        let point = |x: f64, y: f64| of(p(x, y), p(x, y));
        assert_eq!(segments_contact(point(1.5, 0.5), base), Some(p(1.5, 0.5)));
        assert_eq!(segments_contact(point(1.5, 0.6), base), None);
        assert_eq!(segments_contact(point(6.0, 2.0), base), None, "on its line, beyond its end");
    }

    #[test]
    fn containment_is_closed() {
        let square = [p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)];
        for q in [p(1.0, 1.0), p(0.0, 0.0), p(2.0, 1.0), p(1.0, 2.0), p(1.0, 0.0)] {
            assert!(polygon_contains(&square, q), "{q}");
        }
        for q in [p(-1.0, 0.0), p(3.0, 2.0), p(2.0, 2.0 + 1e-15), p(1.0, -1e-300)] {
            assert!(!polygon_contains(&square, q), "{q}");
        }
    }

    #[test]
    fn a_short_far_segment_keeps_its_digits() {
        // 1 mm long, 10 m away, seen from beside its middle: the exact distance is 10
        let (d, _) = point_segment(p(0.0005, 0.0), Segment::new(p(0.0, 10.0), p(0.001, 10.0)));
        assert!((d - 10.0).abs() <= 4.0 * f64::EPSILON * 10.0, "{d}");
    }
}
