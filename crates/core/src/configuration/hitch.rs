//! `HitchCfg`, the car's configuration: SE(2), or SE(2) x S^1 with a trailer.

use std::fmt;

use super::{ChartMismatch, Configuration, Coordinates};
use crate::geometry::Pose2;
use crate::num::{in_range, wrap};

/// The configuration of Hitch: a point of SE(2) x S^1, or of SE(2) when there is no trailer.
///
/// The steering angle is a control and not part of the configuration: it does not move the footprint. Prints as
/// `HitchCfg { body: Pose2 { .. }, trailer: Some(0.100) }` or `trailer: None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitchCfg {
    /// The pose of the rear axle's midpoint, x axis ahead.
    pub body: Pose2,
    /// The trailer's absolute heading psi in radians, wrapped to `(-pi, pi]`; `None` without a trailer.
    pub trailer: Option<f64>,
}

impl fmt::Display for HitchCfg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let p = f.precision().unwrap_or(3);
        write!(f, "HitchCfg {{ body: {:.p$}, trailer: ", self.body)?;
        match self.trailer {
            Some(psi) => write!(f, "Some({psi:.p$}) }}"),
            None => write!(f, "None }}"),
        }
    }
}

impl HitchCfg {
    /// The angle of the hitch, from the car's heading to the trailer's: psi - theta in `(-pi, pi]`, radians. 0 with the
    /// trailer straight behind, pi with the two on each other. `None` without a trailer.
    pub fn hitch_angle(&self) -> Option<f64> {
        Some(wrap(in_range(self.trailer?) - in_range(self.body.theta)))
    }
}

impl Configuration for HitchCfg {
    fn is_finite(&self) -> bool {
        self.body.is_finite() && self.trailer.is_none_or(f64::is_finite)
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        let mut d = self.body.difference(&to.body)?;
        match (self.trailer, to.trailer) {
            (Some(a), Some(b)) => d.push(wrap(in_range(b) - in_range(a))),
            (None, None) => {}
            _ => return Err(ChartMismatch),
        }
        Ok(d)
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        let trailer = match (self.trailer, to.trailer) {
            (Some(a), Some(b)) if s > 0.0 && s < 1.0 => {
                let from = in_range(a);
                Some(wrap(from + s * wrap(in_range(b) - from)))
            }
            (Some(a), Some(b)) => Some(if s >= 1.0 { b } else { a }),
            (None, None) => None,
            _ => return Err(ChartMismatch),
        };
        Ok(HitchCfg { body: self.body.interpolate(&to.body, s)?, trailer })
    }

    fn in_chart(&self) -> Self {
        HitchCfg { body: self.body.in_chart(), trailer: self.trailer.map(in_range) }
    }

    fn coordinates(&self) -> Coordinates {
        self.body.coordinates().into_iter().chain(self.trailer).collect()
    }

    fn coordinate_names(&self) -> Vec<String> {
        self.body.coordinate_names().into_iter().chain(self.trailer.map(|_| "psi".into())).collect()
    }

    fn from_coordinates(coordinates: &[f64]) -> Option<Self> {
        let body = Pose2::from_coordinates(coordinates.get(..3)?)?;
        match coordinates {
            [_, _, _] => Some(HitchCfg { body, trailer: None }),
            [_, _, _, psi] => Some(HitchCfg { body, trailer: Some(*psi) }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_joins_with_and_without_a_trailer() {
        let body = Pose2::new(1.0, 2.0, 3.0);
        let (with, without) = (HitchCfg { body, trailer: Some(0.1) }, HitchCfg { body, trailer: None });
        assert_eq!(with.difference(&without), Err(ChartMismatch));
        assert_eq!(without.interpolate(&with, 0.5), Err(ChartMismatch));
        assert_eq!(HitchCfg::from_coordinates(&with.coordinates()), Some(with));
        assert_eq!(HitchCfg::from_coordinates(&without.coordinates()), Some(without));
        assert_eq!(with.coordinate_names().len(), with.coordinates().len());
    }

    #[test]
    fn prints_as_its_type() {
        let q = HitchCfg { body: Pose2::new(1.0, 2.0, 0.5), trailer: Some(0.1) };
        assert_eq!(
            q.to_string(),
            "HitchCfg { body: Pose2 { x: 1.000, y: 2.000, theta: 0.500 }, trailer: Some(0.100) }"
        );
    }
}
