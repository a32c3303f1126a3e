//! Follows curves by chains of straight pieces, and finds those that are circles.

use super::part::{CurvedPart, PathPiece};
use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num::{self, greater, lesser};
use motion_lab_core::worlds::MAX_ITEMS;

/// One part of a path, as straight pieces, in metres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathOutline {
    /// The points. A closed part does not repeat its first point.
    pub points: Vec<Point2>,
    pub closed: bool,
}

/// Follows a part within `tolerance`, metres. `room` counts the points that may still be made: curves have many, most
/// of which lie too close together and are left out later. `None` if it does not suffice, or a curve takes more pieces
/// than a world may have shapes.
pub(crate) fn outline(part: &CurvedPart, tolerance: f64, room: &mut usize) -> Option<PathOutline> {
    let mut points = vec![part.start];
    let mut from = part.start;
    for piece in &part.pieces {
        let pieces = piece_count(from, piece, tolerance)?;
        *room = room.checked_sub(pieces as usize)?;
        points.extend((1..=pieces).map(|k| along(from, piece, f64::from(k) / f64::from(pieces))));
        from = end_of(piece);
    }
    let mut closed = part.closed;
    // a part that ends where it began counts as closed
    while points.len() > 3 && points.first() == points.last() {
        points.pop();
        closed = true;
    }
    Some(PathOutline { points, closed })
}

/// Where a piece ends.
pub(super) fn end_of(piece: &PathPiece) -> Point2 {
    match *piece {
        PathPiece::Line(end) | PathPiece::Cubic(_, _, end) | PathPiece::Arc(_, end) => end,
    }
}

/// The point at a part of a piece, from 0 to 1. The end is exact.
pub(super) fn along(from: Point2, piece: &PathPiece, t: f64) -> Point2 {
    let u = 1.0 - t;
    match *piece {
        _ if t == 1.0 => end_of(piece),
        PathPiece::Line(end) => from + (end - from) * t,
        PathPiece::Arc(arc, _) => arc.point(t),
        PathPiece::Cubic(a, b, end) => {
            // measured from the beginning, so that far from the origin no digits are lost
            let sum: Vector2 =
                (a - from) * (3.0 * u * u * t) + (b - from) * (3.0 * u * t * t) + (end - from) * (t * t * t);
            from + sum
        }
    }
}

/// The number of equal pieces that follow a piece within the tolerance. `None` if they are too many, or not finite. The
/// second derivative of a cubic is at most 6 `bend`, so `n` equal pieces deviate from it by at most 6/8 `bend` / n^2.
fn piece_count(from: Point2, piece: &PathPiece, tolerance: f64) -> Option<u32> {
    let pieces = match *piece {
        PathPiece::Line(_) => 1.0,
        PathPiece::Arc(arc, _) => arc.chords(tolerance),
        PathPiece::Cubic(a, b, end) => {
            let second = |a: Point2, b: Point2, c: Point2| ((a - b) - (b - c)).norm();
            let bend = greater(second(from, a, b), second(a, b, end));
            num::sqrt(0.75 * bend / tolerance)
        }
    };
    let pieces = greater(pieces.ceil(), 1.0);
    // written so that NaN is refused
    (pieces <= MAX_ITEMS as f64).then_some(pieces as u32)
}

/// Points of a part in which it is compared with a circle: 16 a piece.
fn samples(part: &CurvedPart) -> Vec<Point2> {
    let mut points = Vec::new();
    let mut from = part.start;
    let closing = PathPiece::Line(part.start);
    for piece in part.pieces.iter().chain([&closing]) {
        if !matches!(piece, PathPiece::Line(end) if (*end - from).norm() < 1e-9) {
            points.extend((1..=SAMPLES).map(|k| along(from, piece, f64::from(k) / f64::from(SAMPLES))));
        }
        from = end_of(piece);
    }
    points
}

const SAMPLES: u32 = 16;

/// Largest number of pieces of a circle.
const MAX_CIRCLE_PIECES: usize = 64;

/// The centre and radius of the disc with this border; `None` if there is none. Drawn circles are curves that are
/// nearly round: points may lie off the circle by the tolerance or a thousandth of the radius, whichever is less.
pub(crate) fn disc(part: &CurvedPart, tolerance: f64) -> Option<(Point2, f64)> {
    let is_curved = part.pieces.iter().any(|piece| !matches!(piece, PathPiece::Line(_)));
    if !is_curved || part.pieces.len() > MAX_CIRCLE_PIECES {
        return None;
    }
    let points = samples(part);
    let center = fitted_center(&points)?;
    let start = (f64::INFINITY, 0.0_f64);
    let reach = |p: &Point2| num::hypot(p.x - center.x, p.y - center.y);
    let (least, most) = points.iter().map(reach).fold(start, |(l, m), r| (lesser(r, l), greater(r, m)));
    let radius = 0.5 * (least + most);
    let allowed = lesser(tolerance, 1e-3 * radius);
    (most - radius <= allowed && winds_once(&points, center)).then_some((center, radius))
}

/// The centre of the circle that fits the points best (Kasa, 1976). `None` if they lie on a line.
fn fitted_center(points: &[Point2]) -> Option<Point2> {
    let count = points.len() as f64;
    let first = *points.first()?;
    let mean = points.iter().fold(Vector2::zeros(), |sum, p| sum + (p - first)) / count;
    let origin = first + mean;
    let [mut xx, mut xy, mut yy, mut xr, mut yr] = [0.0; 5];
    for d in points.iter().map(|p| p - origin) {
        let square = d.norm_squared();
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        xr += d.x * square;
        yr += d.y * square;
    }
    let det = 2.0 * (xx * yy - xy * xy);
    let offset = Vector2::new((xr * yy - yr * xy) / det, (yr * xx - xr * xy) / det);
    (offset.x.is_finite() && offset.y.is_finite()).then(|| origin + offset)
}

/// Whether closed points lead around a place once, each by less than a quarter of a turn, always in one direction.
fn winds_once(points: &[Point2], center: Point2) -> bool {
    let n = points.len();
    let step = |i: usize| {
        let (a, b) = (points[i] - center, points[(i + 1) % n] - center);
        num::atan2(a.x * b.y - a.y * b.x, a.dot(&b))
    };
    let steps: Vec<f64> = (0..n).map(step).collect();
    let total: f64 = steps.iter().sum();
    let along = |step: &f64| step.abs() < 0.5 && step * total >= 0.0;
    (total.abs() - std::f64::consts::TAU).abs() < 1e-6 && steps.iter().all(along)
}
