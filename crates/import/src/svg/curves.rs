//! Converts the parts of a drawn path to chains of straight pieces.

use usvg::tiny_skia_path::{Path, PathSegment};

use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num::{self, greater, lesser};
use motion_lab_core::worlds::MAX_ITEMS;

/// One part of a path, in metres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathOutline {
    /// The points. A closed part does not repeat its first point.
    pub points: Vec<Point2>,
    pub closed: bool,
    /// Whether any of it is curved.
    pub curved: bool,
}

/// Returns the parts of a path. `place` maps its points into the world and must keep straight lines straight. A curve's
/// straight pieces lie within `tolerance` of it, metres. `None` if a curve takes more pieces than a world may have
/// shapes, or all parts together more than ten times as many. The second limit is higher because most points of a fine
/// curve lie too close together and are left out later.
pub(crate) fn outlines(path: &Path, place: impl Fn(f32, f32) -> Point2, tolerance: f64) -> Option<Vec<PathOutline>> {
    let mut parts: Vec<PathOutline> = Vec::new();
    let mut points = 0;
    let begin = |at: Point2| PathOutline { points: vec![at], closed: false, curved: false };
    for segment in path.segments() {
        if let PathSegment::MoveTo(p) = segment {
            parts.push(begin(place(p.x, p.y)));
            continue;
        }
        // after a closed part the next one begins at its first point
        if let Some(again) = parts.last().filter(|part| part.closed).map(|part| begin(part.points[0])) {
            parts.push(again);
        }
        let Some(part) = parts.last_mut() else { continue };
        let Some(&from) = part.points.last() else { continue };
        let before = part.points.len();
        match segment {
            PathSegment::MoveTo(_) => {}
            PathSegment::LineTo(p) => part.points.push(place(p.x, p.y)),
            PathSegment::QuadTo(a, b) => {
                // the same curve as a cubic
                let (a, b) = (place(a.x, a.y), place(b.x, b.y));
                part.curve(from, from + (a - from) * (2.0 / 3.0), b + (a - b) * (2.0 / 3.0), b, tolerance)?;
            }
            PathSegment::CubicTo(a, b, c) => {
                part.curve(from, place(a.x, a.y), place(b.x, b.y), place(c.x, c.y), tolerance)?;
            }
            PathSegment::Close => part.closed = true,
        }
        points += part.points.len() - before;
        if points > 10 * MAX_ITEMS {
            return None;
        }
    }
    for part in &mut parts {
        // a part that ends where it began counts as closed
        while part.points.len() > 3 && part.points.first() == part.points.last() {
            part.points.pop();
            part.closed = true;
        }
    }
    parts.retain(|part| part.points.len() > 1);
    Some(parts)
}

impl PathOutline {
    /// Appends a cubic curve. Its second derivative is at most 6 `bend`, so `n` equal pieces deviate from it by at most
    /// 6/8 `bend` / n^2.
    fn curve(&mut self, p0: Point2, p1: Point2, p2: Point2, p3: Point2, tolerance: f64) -> Option<()> {
        let second = |a: Point2, b: Point2, c: Point2| ((a - b) - (b - c)).norm();
        let bend = greater(second(p0, p1, p2), second(p1, p2, p3));
        let pieces = greater(num::sqrt(0.75 * bend / tolerance).ceil(), 1.0);
        // written so that NaN is refused
        let pieces = (pieces <= MAX_ITEMS as f64).then_some(pieces as u32)?;
        for k in 1..=pieces {
            let t = f64::from(k) / f64::from(pieces);
            let u = 1.0 - t;
            let sum: Vector2 = p0.coords * (u * u * u)
                + p1.coords * (3.0 * u * u * t)
                + p2.coords * (3.0 * u * t * t)
                + p3.coords * (t * t * t);
            self.points.push(if k == pieces { p3 } else { Point2::from(sum) });
        }
        self.curved |= bend > 0.0;
        Some(())
    }

    /// The centre and radius of the disc with this border; `None` if there is none. Drawn circles are curves that are
    /// nearly round: points may lie off the circle by the tolerance or a thousandth of the radius, whichever is less.
    pub fn disc(&self, tolerance: f64) -> Option<(Point2, f64)> {
        if !self.curved || self.points.len() < 8 {
            return None;
        }
        let start = (self.points[0], self.points[0]);
        let (min, max) = self.points.iter().fold(start, |(min, max), p| {
            (Point2::new(lesser(p.x, min.x), lesser(p.y, min.y)), Point2::new(greater(p.x, max.x), greater(p.y, max.y)))
        });
        let (center, radius) = (nalgebra::center(&min, &max), 0.5 * (max.x - min.x));
        let off = |p: &Point2| ((p - center).norm() - radius).abs();
        let allowed = lesser(tolerance, 1e-3 * radius);
        // all the way round: neighbours are less than 0.7 of the radius apart, about a ninth of a turn
        let n = self.points.len();
        let gap = |i: usize| (self.points[(i + 1) % n] - self.points[i]).norm();
        ((0..n).all(|i| gap(i) < 0.7 * radius) && self.points.iter().all(|p| off(p) <= allowed))
            .then_some((center, radius))
    }
}
