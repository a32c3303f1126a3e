//! `Pose2` as a configuration: SE(2), whose chart is (x, y, theta) with theta on the circle.

use super::{ChartMismatch, Configuration, Coordinates};
use crate::geometry::Pose2;
use crate::num::{in_range, wrap};

impl Configuration for Pose2 {
    fn is_finite(&self) -> bool {
        Pose2::is_finite(self)
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        Ok(Coordinates::from([to.x - self.x, to.y - self.y, wrap(in_range(to.theta) - in_range(self.theta))]))
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        if s >= 1.0 {
            return Ok(*to);
        }
        let from = in_range(self.theta);
        let turn = wrap(in_range(to.theta) - from);
        Ok(Pose2 {
            x: self.x + s * (to.x - self.x),
            y: self.y + s * (to.y - self.y),
            theta: if s == 0.0 { self.theta } else { wrap(from + s * turn) },
        })
    }

    fn in_chart(&self) -> Self {
        Pose2 { theta: in_range(self.theta), ..*self }
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates::from([self.x, self.y, self.theta])
    }

    fn coordinate_names(&self) -> Vec<String> {
        vec!["x".into(), "y".into(), "theta".into()]
    }

    fn from_coordinates(coordinates: &[f64]) -> Option<Self> {
        match coordinates {
            [x, y, theta] => Some(Pose2 { x: *x, y: *y, theta: *theta }),
            _ => None,
        }
    }
}
