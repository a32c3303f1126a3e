//! `Segment`, a closed line segment.

use super::{Point2, Vector2};
use crate::num;

/// The closed line segment from `a` to `b`, in metres. The two ends may be equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Point2,
    /// The other end.
    pub b: Point2,
}

impl Segment {
    /// The segment from `a` to `b`.
    pub const fn new(a: Point2, b: Point2) -> Self {
        Segment { a, b }
    }

    /// The displacement from `a` to `b`.
    pub fn direction(&self) -> Vector2 {
        self.b - self.a
    }

    /// The length, metres.
    pub fn length(&self) -> f64 {
        let d = self.direction();
        num::hypot(d.x, d.y)
    }

    /// The point of the segment nearest to `p`. The two ends are returned exactly.
    pub fn closest_point(&self, p: Point2) -> Point2 {
        let d = self.direction();
        let from_a = (p - self.a).dot(&d);
        let from_b = (self.b - p).dot(&d);
        let total = from_a + from_b;
        if from_a <= 0.0 || total <= 0.0 {
            self.a
        } else if from_b <= 0.0 {
            self.b
        } else if from_a <= from_b {
            // measured from the nearer end, so that the rounding is that of the shorter piece
            self.a + d * (from_a / total)
        } else {
            self.b - d * (from_b / total)
        }
    }
}
