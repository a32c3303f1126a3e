//! Closed forms for a point that runs along a line or a circle: when it first comes near a core, and how near it gets.

use crate::collision::narrow::convex::{edges, point_segment, polygon_contains};
use crate::geometry::{CircularArc, Placed, Point2, Segment, Vector2, cross};
use crate::num::{hypot, lesser, sqrt};

/// The earlier of `best` and `s`; an `s` outside `[0, 1]` does not count.
fn earlier(best: Option<f64>, s: f64) -> Option<f64> {
    if (0.0..=1.0).contains(&s) && best.is_none_or(|b| s < b) { Some(s) } else { best }
}

/// The first `s` in `[0, 1]` at which `p + s v` comes within `reach` of the segment, for a start farther away; rounded.
///
/// The set within `reach` of a segment is bounded by two sides, where |(p + s v - a) x u| = reach |u|, and by two
/// circles about its ends, where |p + s v - a|^2 = reach^2.
fn line_meets(p: Point2, v: Vector2, segment: Segment, reach: f64) -> Option<f64> {
    let Segment { a, b } = segment;
    let u = b - a;
    let length = sqrt(u.norm_squared());
    let mut best = None;
    let (side, closing) = (cross(u, p - a), cross(u, v));
    if side.abs() > reach * length && side * closing < 0.0 {
        let s = (side.abs() - reach * length) / closing.abs();
        let along = (p + v * s - a).dot(&u);
        if (0.0..=length * length).contains(&along) {
            best = earlier(best, s);
        }
    }
    let speed_squared = v.norm_squared();
    for end in [a, b] {
        let w = p - end;
        let (half, rest) = (w.dot(&v), w.norm_squared() - reach * reach);
        let discriminant = half * half - speed_squared * rest;
        if half < 0.0 && discriminant >= 0.0 {
            // the smaller root of |v|^2 s^2 + 2 half s + rest, in the form that keeps its digits
            best = earlier(best, rest / (sqrt(discriminant) - half));
        }
    }
    best
}

/// The first `s` in `[0, 1]` at which `p + s v` comes within `reach` of the core, for a start farther away; rounded.
pub(crate) fn point_meets(p: Point2, v: Vector2, core: &[Point2], reach: f64) -> Option<f64> {
    edges(core).filter_map(|edge| line_meets(p, v, edge, reach)).fold(None, earlier)
}

/// The first `s` in `[0, 1]` at which `part`, moved by `s v` without turning, touches `piece`, for a start that is
/// free; rounded. Two convex cores first come within a distance at a vertex of one of them.
pub(crate) fn translation_meets(part: &Placed, v: Vector2, piece: &Placed) -> Option<f64> {
    let reach = part.radius() + piece.radius();
    let mut best = None;
    for &p in part.core() {
        best = point_meets(p, v, piece.core(), reach).map_or(best, |s| earlier(best, s));
    }
    if part.core().len() > 1 {
        for &q in piece.core() {
            for edge in edges(part.core()) {
                best = line_meets(q, -v, edge, reach).map_or(best, |s| earlier(best, s));
            }
        }
    }
    best
}

/// The angle whose cosine is `x / r`, for `|x| <= r`.
fn arc_cosine(x: f64, r: f64) -> f64 {
    crate::num::atan2(sqrt((r - x) * (r + x)), x)
}

/// The bearings at which the circle crosses the edge, moved by `offset` to its left.
fn crossings(arc: &CircularArc, edge: Segment, offset: f64) -> impl Iterator<Item = f64> {
    let Segment { a, b } = edge;
    let u = b - a;
    let length = hypot(u.x, u.y);
    // the line's distance from the centre, along the unit normal to the left of the edge
    let far = cross(u, a - arc.centre) / length + offset;
    let normal = crate::num::atan2(u.x, -u.y);
    let half = if far.abs() <= arc.radius { Some(arc_cosine(far, arc.radius)) } else { None };
    let arc = *arc;
    half.into_iter()
        .flat_map(move |half| [normal - half, normal + half])
        .filter(move |&bearing| (0.0..=length * length).contains(&(arc.on_circle(bearing) - a).dot(&u)))
}

/// The first parameter in `[0, 1]` at which a point on the arc comes within `reach` of the core, for a start farther
/// away; rounded.
pub(crate) fn arc_meets(arc: &CircularArc, core: &[Point2], reach: f64) -> Option<f64> {
    let mut best = None;
    for edge in edges(core) {
        for offset in [-reach, reach] {
            for bearing in crossings(arc, edge, offset) {
                best = earlier(best, arc.passes(bearing));
            }
        }
        for end in [edge.a, edge.b] {
            let d = hypot(end.x - arc.centre.x, end.y - arc.centre.y);
            // law of cosines in the triangle of the centre, the end and the place at `reach` from it
            let (x, r) = (d * d + arc.radius * arc.radius - reach * reach, 2.0 * d * arc.radius);
            if r > 0.0 && x.abs() <= r {
                let (at, half) = (arc.bearing_of(end), arc_cosine(x, r));
                best = earlier(earlier(best, arc.passes(at - half)), arc.passes(at + half));
            }
        }
    }
    best
}

/// The least distance between the core and the arc as far as `until`; 0 where they meet. Rounded.
///
/// It is attained at an end of the arc, on the ray from the centre through an end of an edge, on the normal of an edge
/// through the centre, or it is 0 at a crossing.
pub(crate) fn arc_distance(arc: &CircularArc, until: f64, core: &[Point2]) -> f64 {
    let (first, last) = (arc.at(0.0), arc.at(until));
    if polygon_contains(core, first) {
        return 0.0;
    }
    let passed = |bearing: f64| arc.passes(bearing) <= until;
    let mut least = f64::INFINITY;
    for edge in edges(core) {
        least = lesser(point_segment(first, edge).0, least);
        least = lesser(point_segment(last, edge).0, least);
        for end in [edge.a, edge.b] {
            let d = hypot(end.x - arc.centre.x, end.y - arc.centre.y);
            if d == 0.0 || passed(arc.bearing_of(end)) {
                least = lesser((d - arc.radius).abs(), least);
            }
        }
        if edge.a == edge.b {
            continue;
        }
        if crossings(arc, edge, 0.0).any(passed) {
            return 0.0;
        }
        let u = edge.b - edge.a;
        let normal = crate::num::atan2(u.x, -u.y);
        for bearing in [normal, normal + std::f64::consts::PI] {
            if passed(bearing) {
                least = lesser(point_segment(arc.on_circle(bearing), edge).0, least);
            }
        }
    }
    least
}
