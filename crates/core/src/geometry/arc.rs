//! `CircularArc`, the path of a point on a circle.

use std::f64::consts::TAU;

use super::Point2;
use crate::num::{atan2, sin_cos, wrap};

/// The path of a point that runs along a circle at constant speed, over the parameter s in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircularArc {
    /// The circle's centre.
    pub centre: Point2,
    /// The circle's radius, metres.
    pub radius: f64,
    /// The bearing from the centre at which the path begins, radians.
    pub start: f64,
    /// The angle that the path turns through, radians, counter-clockwise positive; never 0.
    pub turn: f64,
}

impl CircularArc {
    /// The point of the circle at a bearing from its centre.
    pub fn on_circle(&self, bearing: f64) -> Point2 {
        let (sin, cos) = sin_cos(bearing);
        Point2::new(self.centre.x + self.radius * cos, self.centre.y + self.radius * sin)
    }

    /// The point at `s`.
    pub fn at(&self, s: f64) -> Point2 {
        self.on_circle(self.start + s * self.turn)
    }

    /// The first `s`, 0 or more, at which the path passes this bearing; it may lie beyond 1.
    pub fn passes(&self, bearing: f64) -> f64 {
        let ahead = wrap(if self.turn > 0.0 { bearing - self.start } else { self.start - bearing });
        (if ahead < 0.0 { ahead + TAU } else { ahead }) / self.turn.abs()
    }

    /// The bearing of `p` from the centre.
    pub fn bearing_of(&self, p: Point2) -> f64 {
        atan2(p.y - self.centre.y, p.x - self.centre.x)
    }

    /// The length of the path, metres.
    pub fn length(&self) -> f64 {
        self.radius * self.turn.abs()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn a_bearing_is_passed_in_the_direction_of_the_turn() {
        let left = CircularArc { centre: Point2::new(1.0, 2.0), radius: 2.0, start: FRAC_PI_2, turn: PI };
        assert!((left.passes(PI) - 0.5).abs() < 1e-15);
        assert!((left.passes(0.0) - 1.5).abs() < 1e-15, "three quarters of the circle on, beyond its end");
        let right = CircularArc { turn: -PI, ..left };
        assert!((right.passes(0.0) - 0.5).abs() < 1e-15);
        for arc in [left, right] {
            assert_eq!(arc.passes(arc.start), 0.0);
            let p = arc.at(0.3);
            assert!((arc.passes(arc.bearing_of(p)) - 0.3).abs() < 1e-15);
        }
        assert!((left.at(0.5) - Point2::new(-1.0, 2.0)).norm() < 1e-15);
        assert!((right.at(0.5) - Point2::new(3.0, 2.0)).norm() < 1e-15);
    }
}
