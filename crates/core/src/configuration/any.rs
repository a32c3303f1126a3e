//! `AnyConfiguration`, a configuration of one of the lab's robots, whichever it is.

use std::fmt;

use super::{ChartMismatch, Configuration, Coordinates, HitchCfg, R2, T2, Tn};
use crate::geometry::Pose2;

/// A configuration of one of the lab's robots as one type: for views, where the robot is chosen while the program runs.
/// It prints as the type that it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyConfiguration {
    /// Rusty's.
    Pose(Pose2),
    /// The two-link arm's.
    T2(T2),
    /// The three-link arm's.
    T3(Tn<3>),
    /// The car's.
    Hitch(HitchCfg),
}

impl From<Pose2> for AnyConfiguration {
    fn from(q: Pose2) -> Self {
        AnyConfiguration::Pose(q)
    }
}

/// A disc's place, with the heading 0.
impl From<R2> for AnyConfiguration {
    fn from(R2(p): R2) -> Self {
        AnyConfiguration::Pose(Pose2::new(p.x, p.y, 0.0))
    }
}

impl From<T2> for AnyConfiguration {
    fn from(q: T2) -> Self {
        AnyConfiguration::T2(q)
    }
}

impl From<Tn<3>> for AnyConfiguration {
    fn from(q: Tn<3>) -> Self {
        AnyConfiguration::T3(q)
    }
}

impl From<HitchCfg> for AnyConfiguration {
    fn from(q: HitchCfg) -> Self {
        AnyConfiguration::Hitch(q)
    }
}

/// Evaluates `$body` with `$q` bound to the configuration held.
macro_rules! each {
    ($any:expr, $q:ident => $body:expr) => {
        match $any {
            AnyConfiguration::Pose($q) => $body,
            AnyConfiguration::T2($q) => $body,
            AnyConfiguration::T3($q) => $body,
            AnyConfiguration::Hitch($q) => $body,
        }
    };
}

impl AnyConfiguration {
    /// The configuration of the same type with these coordinates, bit for bit; `None` when their number does not fit
    /// it.
    pub fn with_coordinates(&self, coordinates: &[f64]) -> Option<Self> {
        Some(match self {
            Self::Pose(_) => Self::Pose(Pose2::from_coordinates(coordinates)?),
            Self::T2(_) => Self::T2(T2::from_coordinates(coordinates)?),
            Self::T3(_) => Self::T3(Tn::from_coordinates(coordinates)?),
            Self::Hitch(_) => Self::Hitch(HitchCfg::from_coordinates(coordinates)?),
        })
    }

    /// The configuration with `value` as coordinate number `index`, an angle wrapped; itself when there is no such
    /// coordinate or the value is not finite.
    #[must_use]
    pub fn with(&self, index: usize, value: f64) -> Self {
        let mut coordinates = self.coordinates();
        match coordinates.get_mut(index) {
            Some(c) if value.is_finite() => *c = if self.is_angle(index) { crate::num::wrap(value) } else { value },
            _ => return *self,
        }
        self.with_coordinates(&coordinates).unwrap_or(*self)
    }

    /// The configuration moved by these steps in the chart, angles wrapped. Missing steps count as 0.
    #[must_use]
    pub fn plus(&self, steps: &[f64]) -> Self {
        let moved = self.coordinates().into_iter().zip(steps.iter().chain(std::iter::repeat(&0.0))).enumerate();
        moved.fold(*self, |q, (i, (c, step))| if *step == 0.0 { q } else { q.with(i, c + step) })
    }

    /// Whether coordinate number `index` is an angle, radians; otherwise it is a length, metres.
    pub fn is_angle(&self, index: usize) -> bool {
        match self {
            Self::T2(_) | Self::T3(_) => true,
            Self::Pose(_) | Self::Hitch(_) => index >= 2,
        }
    }
}

impl fmt::Display for AnyConfiguration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        each!(self, q => q.fmt(f))
    }
}

impl Configuration for AnyConfiguration {
    fn is_finite(&self) -> bool {
        each!(self, q => q.is_finite())
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        match (self, to) {
            (Self::Pose(a), Self::Pose(b)) => a.difference(b),
            (Self::T2(a), Self::T2(b)) => a.difference(b),
            (Self::T3(a), Self::T3(b)) => a.difference(b),
            (Self::Hitch(a), Self::Hitch(b)) => a.difference(b),
            _ => Err(ChartMismatch),
        }
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        match (self, to) {
            (Self::Pose(a), Self::Pose(b)) => a.interpolate(b, s).map(Self::Pose),
            (Self::T2(a), Self::T2(b)) => a.interpolate(b, s).map(Self::T2),
            (Self::T3(a), Self::T3(b)) => a.interpolate(b, s).map(Self::T3),
            (Self::Hitch(a), Self::Hitch(b)) => a.interpolate(b, s).map(Self::Hitch),
            _ => Err(ChartMismatch),
        }
    }

    fn in_chart(&self) -> Self {
        match self {
            Self::Pose(q) => Self::Pose(q.in_chart()),
            Self::T2(q) => Self::T2(q.in_chart()),
            Self::T3(q) => Self::T3(q.in_chart()),
            Self::Hitch(q) => Self::Hitch(q.in_chart()),
        }
    }

    fn coordinates(&self) -> Coordinates {
        each!(self, q => q.coordinates())
    }

    fn coordinate_names(&self) -> Vec<String> {
        each!(self, q => q.coordinate_names())
    }

    /// Always `None`: the coordinates alone do not say whose they are. See
    /// [`with_coordinates`](Self::with_coordinates).
    fn from_coordinates(_coordinates: &[f64]) -> Option<Self> {
        None
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn it_is_what_it_holds() {
        let (pose, arm) = (Pose2::new(1.0, 2.0, 3.0), Tn([1.0, 2.0, 3.0]));
        let held = [AnyConfiguration::Pose(pose), AnyConfiguration::T3(arm)];
        assert_eq!(held.map(|q| q.to_string()), [pose.to_string(), arm.to_string()]);
        assert_eq!(held[0].coordinates(), held[1].coordinates(), "three numbers alone don't tell them apart");
        assert_eq!(held[0].difference(&held[1]), Err(ChartMismatch));
        assert_eq!(held[1].with_coordinates(&[1.0, 2.0]), None);
    }

    #[test]
    fn angles_wrap_and_lengths_do_not() {
        let car = AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(9.0, 0.0, 3.0), trailer: Some(-3.0) });
        let moved = car.plus(&[1.0, 0.0, 1.0, -1.0]);
        let c = moved.coordinates();
        assert_eq!((c[0], c[1]), (10.0, 0.0));
        assert!((c[2] - (4.0 - 2.0 * PI)).abs() < 1e-15 && (c[3] - (2.0 * PI - 4.0)).abs() < 1e-15, "{c:?}");
        assert_eq!(car.plus(&[]), car);
        assert_eq!(car.with(7, 1.0), car);
        assert_eq!(car.with(0, f64::NAN), car);
    }
}
