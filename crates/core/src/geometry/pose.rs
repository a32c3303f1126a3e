//! `Pose2`, a rigid-body pose of the plane: the group SE(2).

use serde::{Deserialize, Serialize};

use super::{Point2, SinCos, Vector2};
use crate::num::{self, sinc, wrap};

/// A pose in SE(2): the frame's origin `(x, y)` in metres and its heading `theta` in radians, wrapped to `(-pi, pi]`.
///
/// Prints as its Rust type with three decimals: `Pose2 { x: 6.212, y: 4.466, theta: 0.100 }`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pose2 {
    /// The x coordinate of the frame's origin, metres.
    pub x: f64,
    /// The y coordinate of the frame's origin, metres.
    pub y: f64,
    /// The heading, radians.
    pub theta: f64,
}

/// A tangent vector of SE(2) in the body frame: `dx` ahead, `dy` to the left (metres), `dtheta` of turn (radians).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tangent2 {
    /// Displacement along the body's x axis, metres.
    pub dx: f64,
    /// Displacement along the body's y axis, metres.
    pub dy: f64,
    /// Turn, radians.
    pub dtheta: f64,
}

impl Tangent2 {
    /// The tangent vector with these components.
    pub const fn new(dx: f64, dy: f64, dtheta: f64) -> Self {
        Tangent2 { dx, dy, dtheta }
    }
}

impl Pose2 {
    /// The pose at the origin with heading 0.
    pub const IDENTITY: Pose2 = Pose2 { x: 0.0, y: 0.0, theta: 0.0 };

    /// The pose with its heading wrapped to `(-pi, pi]`.
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        Pose2 { x, y, theta: wrap(theta) }
    }

    /// The frame's origin.
    pub fn position(&self) -> Point2 {
        Point2::new(self.x, self.y)
    }

    /// Whether all three components are finite.
    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.theta.is_finite()
    }

    /// A point given in this frame, in world coordinates.
    pub fn transform(&self, p_in_frame: Point2) -> Point2 {
        self.transform_by(SinCos::of(self.theta), p_in_frame)
    }

    /// As [`transform`](Self::transform), given the sine and the cosine of the frame's angle.
    #[inline]
    pub(crate) fn transform_by(&self, sin_cos: SinCos, p_in_frame: Point2) -> Point2 {
        let SinCos { sin: s, cos: c } = sin_cos;
        Point2::new(self.x + (c * p_in_frame.x - s * p_in_frame.y), self.y + (s * p_in_frame.x + c * p_in_frame.y))
    }

    /// A displacement given in this frame, in world coordinates.
    pub fn rotate(&self, v_in_frame: Vector2) -> Vector2 {
        let (s, c) = num::sin_cos(self.theta);
        Vector2::new(c * v_in_frame.x - s * v_in_frame.y, s * v_in_frame.x + c * v_in_frame.y)
    }

    /// The composition `self * other`: `other` is given in this pose's frame.
    #[must_use]
    pub fn compose(&self, other: &Pose2) -> Pose2 {
        let p = self.transform(other.position());
        Pose2::new(p.x, p.y, self.theta + other.theta)
    }

    /// The inverse: `p.compose(&p.inverse())` is the identity up to rounding.
    #[must_use]
    pub fn inverse(&self) -> Pose2 {
        let (s, c) = num::sin_cos(self.theta);
        Pose2::new(-(c * self.x + s * self.y), s * self.x - c * self.y, -self.theta)
    }

    /// This pose times the exponential of a tangent vector given in the body frame: the exact end of the circular arc
    /// that a constant body velocity `tangent` drives in unit time.
    ///
    /// With `h = dtheta / 2` the displacement is `sinc(h)` times the tangent's translation turned by `h` (the chord of
    /// the arc). `sinc` is a series near 0, so no digits are lost there.
    ///
    /// ```
    /// use motion_lab_core::geometry::{Pose2, Tangent2};
    /// use std::f64::consts::FRAC_PI_2;
    /// let quarter = Pose2::IDENTITY.boxplus(&Tangent2::new(FRAC_PI_2, 0.0, FRAC_PI_2)); // unit circle
    /// assert!((quarter.x - 1.0).abs() < 1e-15 && (quarter.y - 1.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn boxplus(&self, tangent: &Tangent2) -> Pose2 {
        self.boxplus_along(tangent, sinc(0.5 * tangent.dtheta))
    }

    /// [`boxplus`](Self::boxplus) of a tangent vector whose chord is known: `sinc` of half its turn, the length of the
    /// chord as a part of the arc's. The same bits, and a sine less for whoever adds one vector again and again.
    pub(crate) fn boxplus_along(&self, tangent: &Tangent2, k: f64) -> Pose2 {
        let half = 0.5 * tangent.dtheta;
        let (s, c) = num::sin_cos(self.theta + half);
        Pose2::new(
            self.x + k * (c * tangent.dx - s * tangent.dy),
            self.y + k * (s * tangent.dx + c * tangent.dy),
            self.theta + tangent.dtheta,
        )
    }

    /// The inverse of [`boxplus`](Self::boxplus): the tangent vector at `base`, in its body frame, whose exponential
    /// leads to `self`, with `dtheta` taken the short way (a turn of exactly pi goes the positive way).
    #[must_use]
    pub fn boxminus(&self, base: &Pose2) -> Tangent2 {
        let dtheta = wrap(self.theta - base.theta);
        let half = 0.5 * dtheta;
        let (s, c) = num::sin_cos(base.theta + half);
        let k = sinc(half);
        let (dx, dy) = (self.x - base.x, self.y - base.y);
        Tangent2::new((c * dx + s * dy) / k, (c * dy - s * dx) / k, dtheta)
    }
}

impl std::fmt::Display for Pose2 {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let p = f.precision().unwrap_or(3);
        write!(f, "Pose2 {{ x: {:.p$}, y: {:.p$}, theta: {:.p$} }}", self.x, self.y, self.theta)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::random::{Seed, Stream};

    fn random_pose(s: &mut Stream) -> Pose2 {
        Pose2::new(s.uniform(-5.0, 5.0), s.uniform(-5.0, 5.0), s.uniform(-PI, PI))
    }

    #[test]
    fn inverse_and_composition_form_a_group() {
        let mut s = Stream::new(Seed(1), "pose");
        for _ in 0..500 {
            let (a, b, c) = (random_pose(&mut s), random_pose(&mut s), random_pose(&mut s));
            let unit = a.compose(&a.inverse());
            assert_abs_diff_eq!(unit.position(), Point2::origin(), epsilon = 1e-14);
            let left = a.compose(&b).compose(&c);
            let right = a.compose(&b.compose(&c));
            assert_abs_diff_eq!(left.position(), right.position(), epsilon = 1e-14);
            assert!(wrap(left.theta - right.theta).abs() < 1e-14);
        }
    }

    #[test]
    fn boxminus_undoes_boxplus_at_every_turn() {
        let mut s = Stream::new(Seed(2), "pose");
        for i in 0..500 {
            let a = random_pose(&mut s);
            let scale = [1e-12, 1e-6, 1e-3, 1.0, 3.0][i % 5];
            let t = Tangent2::new(s.uniform(-1.0, 1.0), s.uniform(-1.0, 1.0), scale * s.uniform(-1.0, 1.0));
            let back = a.boxplus(&t).boxminus(&a);
            assert!((back.dx - t.dx).abs() < 1e-13 && (back.dy - t.dy).abs() < 1e-13, "{t:?} {back:?}");
            assert!((back.dtheta - t.dtheta).abs() < 1e-14);
        }
    }

    #[test]
    fn boxplus_is_the_limit_of_many_small_steps() {
        // an oracle that shares no formula: Euler steps along the body velocity, midpoint heading
        let start = Pose2::new(0.3, -0.2, 0.7);
        let t = Tangent2::new(0.8, 0.3, 1.9);
        let n = 20_000;
        let (mut x, mut y) = (start.x, start.y);
        for i in 0..n {
            let heading = start.theta + t.dtheta * (f64::from(i) + 0.5) / f64::from(n);
            let (s, c) = num::sin_cos(heading);
            x += (c * t.dx - s * t.dy) / f64::from(n);
            y += (s * t.dx + c * t.dy) / f64::from(n);
        }
        let end = start.boxplus(&t);
        assert_abs_diff_eq!(end.position(), Point2::new(x, y), epsilon = 1e-9);
    }

    #[test]
    fn prints_as_its_type() {
        assert_eq!(Pose2::new(6.212, 4.466, 0.1).to_string(), "Pose2 { x: 6.212, y: 4.466, theta: 0.100 }");
    }
}
