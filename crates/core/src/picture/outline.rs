//! Outlines: shapes as polygons to draw, and the line around a union of convex pieces.

use std::ops::Range;

use std::f64::consts::PI;

use crate::geometry::{Placed, Point2, Vector2, cross};
use crate::num::{self, greater, lesser};

/// The polygon to draw for a placed shape, counter-clockwise. The round corners become chords, which stray from the arc
/// by less than a four-hundredth of the radius. A segment without a radius gives its two ends, a point itself.
pub fn polygon_of(placed: &Placed) -> Vec<Point2> {
    let (core, radius) = (placed.core(), placed.radius());
    let n = core.len();
    if radius == 0.0 || n == 0 {
        return core.to_vec();
    }
    let mut out = Vec::new();
    for i in 0..n {
        let (before, after) = (core[i] - core[(i + n - 1) % n], core[(i + 1) % n] - core[i]);
        let start = if n == 1 { 0.0 } else { num::atan2(-before.x, before.y) };
        let turn = match n {
            1 => 2.0 * PI,
            2 => PI,
            _ => num::wrap(num::atan2(-after.x, after.y) - start),
        };
        let steps = (turn / (2.0 * PI) * 48.0).abs().ceil() as u32;
        let last = if n == 1 { steps } else { steps + 1 };
        for k in 0..last {
            let (s, c) = num::sin_cos(start + turn * f64::from(k) / f64::from(steps));
            out.push(core[i] + Vector2::new(c, s) * radius);
        }
    }
    out
}

/// The lines around the union of convex counter-clockwise polygons: their edges, without the parts that lie in another
/// piece.
///
/// An edge that two pieces share is drawn by neither, so the seams of a decomposed polygon vanish.
pub fn outline(pieces: &[Vec<Point2>]) -> Vec<Vec<Point2>> {
    let mut edges = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        for (k, &a) in piece.iter().enumerate() {
            let b = piece[(k + 1) % piece.len()];
            let mut left = vec![0.0..1.0];
            for (j, other) in pieces.iter().enumerate() {
                if let Some(hidden) = (i != j).then(|| covered(a, b, other)).flatten() {
                    left = left.into_iter().flat_map(|span| subtract(span, &hidden)).collect();
                }
            }
            let at = |s: f64| if s == 1.0 { b } else { a + (b - a) * s };
            edges.extend(left.into_iter().map(|span| (at(span.start), at(span.end))));
        }
    }
    chains(&edges)
}

/// The part of the segment inside the closed convex polygon.
fn covered(a: Point2, b: Point2, polygon: &[Point2]) -> Option<Range<f64>> {
    let d = b - a;
    let (mut from, mut to) = (0.0, 1.0);
    for (k, &p) in polygon.iter().enumerate() {
        let edge = polygon[(k + 1) % polygon.len()] - p;
        let (inside, rate) = (cross(edge, a - p), cross(edge, d));
        if rate > 0.0 {
            from = greater(from, -inside / rate);
        } else if rate < 0.0 {
            to = lesser(to, -inside / rate);
        } else if inside < 0.0 {
            return None;
        }
    }
    (from < to).then_some(from..to)
}

/// What is left of a span after another is removed.
fn subtract(span: Range<f64>, cut: &Range<f64>) -> impl Iterator<Item = Range<f64>> + use<> {
    let pieces = [span.start..lesser(span.end, cut.start), greater(span.start, cut.end)..span.end];
    pieces.into_iter().filter(|piece| piece.end - piece.start > 1e-9)
}

/// Joins segments end to end into lines, so that their corners are drawn as corners. A closed line repeats its first
/// point.
pub fn chains(segments: &[(Point2, Point2)]) -> Vec<Vec<Point2>> {
    let mut lines: Vec<Vec<Point2>> = Vec::new();
    for &(a, b) in segments {
        let continues = lines.last().and_then(|line| line.last()) == Some(&a);
        match lines.last_mut() {
            Some(line) if continues => line.push(b),
            _ => lines.push(vec![a, b]),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose2, Shape};

    fn rect(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<Point2> {
        [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| Point2::new(x, y)).to_vec()
    }

    fn length(lines: &[Vec<Point2>]) -> f64 {
        lines.iter().flat_map(|l| l.windows(2)).map(|w| (w[1] - w[0]).norm()).sum()
    }

    #[test]
    fn the_seam_of_an_ell_vanishes() {
        let ell = [rect(0.0, 0.0, 3.0, 1.0), rect(0.0, 1.0, 1.0, 3.0)];
        // once around the six-cornered L: 3 + 1 + 2 + 2 + 1 + 3
        assert_eq!(length(&outline(&ell)), 12.0);
        let crossing = [rect(0.0, 1.0, 3.0, 2.0), rect(1.0, 0.0, 2.0, 3.0)];
        assert!((length(&outline(&crossing)) - 12.0).abs() < 1e-12, "a plus of five unit squares");
        let apart = [rect(0.0, 0.0, 1.0, 1.0), rect(2.0, 0.0, 3.0, 1.0)];
        assert_eq!(length(&outline(&apart)), 8.0);
        assert_eq!(outline(&apart).len(), 2, "each is one closed line");
    }

    #[test]
    fn round_shapes_stay_within_their_radius() {
        let shapes =
            [Shape::try_disc(0.5).unwrap(), Shape::try_capsule(Point2::origin(), Point2::new(2.0, 0.0), 0.5).unwrap()];
        for shape in shapes {
            let placed = shape.place(&Pose2::new(1.0, 2.0, 0.7));
            let core = crate::geometry::Segment::new(placed.core()[0], *placed.core().last().unwrap());
            let polygon = polygon_of(&placed);
            for (i, &p) in polygon.iter().enumerate() {
                let middle = p + (polygon[(i + 1) % polygon.len()] - p) * 0.5;
                for q in [p, middle] {
                    let d = (q - core.closest_point(q)).norm();
                    assert!((0.5 * (1.0 - 0.0025)..0.5 + 1e-12).contains(&d), "{d}");
                }
            }
        }
        assert_eq!(polygon_of(&Shape::try_disc(0.5).unwrap().place(&Pose2::IDENTITY)).len(), 48);
    }
}
