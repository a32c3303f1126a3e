//! `Affine`, a map of the plane that keeps straight lines straight.

use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num;

/// Takes (x, y) to (a x + c y + e, b x + d y + f), the order of SVG's `matrix(a b c d e f)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine(pub [f64; 6]);

impl Affine {
    pub const IDENTITY: Affine = Affine([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    pub fn translate(x: f64, y: f64) -> Self {
        Affine([1.0, 0.0, 0.0, 1.0, x, y])
    }

    pub fn scale(x: f64, y: f64) -> Self {
        Affine([x, 0.0, 0.0, y, 0.0, 0.0])
    }

    /// A turn about the origin; from the x axis towards the y axis if the angle is positive. Whole quarters of a turn
    /// are exact.
    pub fn rotate(degrees: f64) -> Self {
        let (sin, cos) = match (degrees % 360.0 + 360.0) % 360.0 {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            _ => num::sin_cos((degrees % 360.0).to_radians()),
        };
        Affine([cos, sin, -sin, cos, 0.0, 0.0])
    }

    /// The map without its displacement.
    pub fn linear(&self) -> Self {
        let [a, b, c, d, ..] = self.0;
        Affine([a, b, c, d, 0.0, 0.0])
    }

    /// The map that does `first`, then this one.
    pub fn after(&self, first: &Affine) -> Self {
        let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = (self.0, first.0);
        Affine([a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, a * k + c * l + e, b * k + d * l + f])
    }

    /// The image of a point.
    pub fn point(&self, p: Point2) -> Point2 {
        let [.., e, f] = self.0;
        Point2::from(self.vector(p.coords) + Vector2::new(e, f))
    }

    /// The image of a displacement.
    pub fn vector(&self, v: Vector2) -> Vector2 {
        let [a, b, c, d, ..] = self.0;
        Vector2::new(a * v.x + c * v.y, b * v.x + d * v.y)
    }

    /// The map back; `None` if this one flattens the plane, or its numbers are not finite.
    pub fn inverse(&self) -> Option<Self> {
        let [a, b, c, d, e, f] = self.0;
        let det = a * d - b * c;
        let inverse = Affine([d / det, -b / det, -c / det, a / det, (c * f - d * e) / det, (b * e - a * f) / det]);
        inverse.0.iter().all(|x| x.is_finite()).then_some(inverse)
    }
}
