//! `EllipticArc`, a part of an ellipse.

use super::affine::Affine;
use motion_lab_core::geometry::{Point2, Vector2, cross};
use motion_lab_core::num;

/// The points `center + u cos a + v sin a`, for the angle `a` from `from` on over `sweep`, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EllipticArc {
    center: Point2,
    u: Vector2,
    v: Vector2,
    from: f64,
    sweep: f64,
}

impl EllipticArc {
    /// A whole ellipse.
    pub fn whole(center: Point2, u: Vector2, v: Vector2) -> Self {
        EllipticArc { center, u, v, from: 0.0, sweep: std::f64::consts::TAU }
    }

    /// A quarter of an ellipse.
    pub fn quarter(center: Point2, u: Vector2, v: Vector2, from_degrees: f64) -> Self {
        EllipticArc { center, u, v, from: from_degrees.to_radians(), sweep: std::f64::consts::FRAC_PI_2 }
    }

    /// The point at a part of the sweep, from 0 to 1.
    pub fn point(&self, part: f64) -> Point2 {
        let (sin, cos) = num::sin_cos(self.from + part * self.sweep);
        self.center + self.u * cos + self.v * sin
    }

    pub fn mapped(&self, map: &Affine) -> Self {
        EllipticArc { center: map.point(self.center), u: map.vector(self.u), v: map.vector(self.v), ..*self }
    }

    /// The ellipse's centre and half-axes: of what size the numbers are that the arc's points are made of.
    pub fn frame(&self) -> [Point2; 3] {
        [self.center, Point2::from(self.u), Point2::from(self.v)]
    }

    /// Where the arc turns back along an axis, as parts of the sweep from 0 to 1.
    pub fn turning_points(&self) -> Vec<f64> {
        let [x, y] = [num::atan2(self.v.x, self.u.x), num::atan2(self.v.y, self.u.y)];
        let half_turn = std::f64::consts::PI;
        let part = |angle: f64| {
            let swept = num::wrap(angle - self.from) * self.sweep.signum();
            (if swept < 0.0 { swept + std::f64::consts::TAU } else { swept }) / self.sweep.abs()
        };
        // those at an end may be missed by rounding, and are ends
        [x, x + half_turn, y, y + half_turn].map(part).into_iter().filter(|t| *t < 1.0).collect()
    }

    /// The number of chords that stay within `tolerance` of the arc, not rounded. A chord over the angle d lies at most
    /// r (1 - cos(d / 2)) inside, where r is the ellipse's greater half-axis.
    pub fn chords(&self, tolerance: f64) -> f64 {
        let squares = self.u.norm_squared() + self.v.norm_squared();
        let area = cross(self.u, self.v);
        let gap = num::sqrt(num::greater(squares * squares - 4.0 * area * area, 0.0));
        let radius = num::sqrt(0.5 * (squares + gap));
        // at most a quarter of a turn each, so that a small ellipse keeps its shape
        let half = num::acos(num::greater(1.0 - tolerance / radius, std::f64::consts::FRAC_1_SQRT_2));
        // for a radius far above the tolerance, 1 - cos(h) is h^2 / 2 and the difference above has no digits left
        let half = if tolerance < 1e-6 * radius { num::sqrt(2.0 * tolerance / radius) } else { half };
        self.sweep.abs() / (2.0 * half)
    }
}

/// The arc of an SVG path between two points: with these half-axes, turned by an angle in degrees, the large one or
/// not, in the direction of growing angles or not. Half-axes that are too short are lengthened. `None` if the arc is a
/// straight line or nothing.
pub(crate) fn arc_between(ends: [Point2; 2], radii: Vector2, turn: f64, flags: [bool; 2]) -> Option<EllipticArc> {
    let [start, end] = ends;
    let (rx, ry) = (radii.x.abs(), radii.y.abs());
    // written so that NaN is a straight line
    if !(rx > 0.0 && ry > 0.0) || start == end {
        return None;
    }
    // to a frame in which the ellipse is the circle of radius 1: from there an isometry leads to both ends
    let axes = Affine::rotate(turn).after(&Affine::scale(rx, ry));
    let back = axes.inverse()?;
    let half = back.vector(end - start) * 0.5;
    let lengthened = num::greater(half.norm(), 1.0);
    let half = half / lengthened;
    let height = num::sqrt(num::greater(1.0 - half.norm_squared(), 0.0));
    let side = if flags[0] == flags[1] { -1.0 } else { 1.0 };
    let across = Vector2::new(-half.y, half.x) * (side * height / num::greater(half.norm(), f64::MIN_POSITIVE));
    // from the centre to both ends
    let (to_start, to_end) = (-half - across, half - across);
    let from = num::atan2(to_start.y, to_start.x);
    let swept = num::atan2(cross(to_start, to_end), to_start.dot(&to_end));
    let sweep = match flags[1] {
        true if swept <= 0.0 => swept + std::f64::consts::TAU,
        false if swept >= 0.0 => swept - std::f64::consts::TAU,
        _ => swept,
    };
    let (u, v) = (axes.vector(Vector2::x()) * lengthened, axes.vector(Vector2::y()) * lengthened);
    let center = nalgebra::center(&start, &end) + axes.vector(across) * lengthened;
    Some(EllipticArc { center, u, v, from, sweep })
}
