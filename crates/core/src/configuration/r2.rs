//! `R2`, a point of the plane: the configuration of a disc.

use std::fmt;

use super::{ChartMismatch, Configuration, Coordinates};
use crate::geometry::Point2;

/// The configuration of Rusty as a planner sees it: a point of R^2, the disc's centre, metres.
///
/// Prints as `R2 { x: 2.000, y: 1.000 }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct R2(pub Point2);

impl R2 {
    /// The point `(x, y)`.
    pub const fn new(x: f64, y: f64) -> Self {
        R2(Point2::new(x, y))
    }
}

impl fmt::Display for R2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let p = f.precision().unwrap_or(3);
        write!(f, "R2 {{ x: {:.p$}, y: {:.p$} }}", self.0.x, self.0.y)
    }
}

impl Configuration for R2 {
    fn is_finite(&self) -> bool {
        self.0.x.is_finite() && self.0.y.is_finite()
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        Ok(Coordinates::from([to.0.x - self.0.x, to.0.y - self.0.y]))
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        Ok(if s >= 1.0 { *to } else { R2(self.0 + (to.0 - self.0) * s) })
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates::from([self.0.x, self.0.y])
    }

    fn coordinate_names(&self) -> Vec<String> {
        vec!["x".into(), "y".into()]
    }

    fn from_coordinates(coordinates: &[f64]) -> Option<Self> {
        match coordinates {
            [x, y] => Some(R2::new(*x, *y)),
            _ => None,
        }
    }
}
