//! `Tn`, a point of the N-torus: the joint angles of an arm.

use std::fmt;

use super::{ChartMismatch, Configuration, Coordinates};
use crate::num::{in_range, wrap};

/// The configuration of Reach: a point of T^N, N joint angles in radians, each wrapped to `(-pi, pi]`.
///
/// Prints spelled out: `T2 { th1: 0.785, th2: 1.571 }` for N = 2, `Tn<3> { th1: .., th2: .., th3: .. }` otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tn<const N: usize>(pub [f64; N]);

/// A point of T^2: the two-link arm's configuration.
pub type T2 = Tn<2>;

impl<const N: usize> Tn<N> {
    /// The joint angles, each wrapped.
    #[must_use]
    pub fn wrapped(self) -> Self {
        Tn(self.0.map(wrap))
    }
}

impl T2 {
    /// The two joint angles, radians, wrapped.
    pub fn new(th1: f64, th2: f64) -> Self {
        Tn([th1, th2]).wrapped()
    }

    /// The first joint angle, radians.
    pub fn th1(&self) -> f64 {
        self.0[0]
    }

    /// The second joint angle, relative to the first link, radians.
    pub fn th2(&self) -> f64 {
        self.0[1]
    }
}

impl<const N: usize> fmt::Display for Tn<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let p = f.precision().unwrap_or(3);
        if N == 2 {
            write!(f, "T2 {{")?;
        } else {
            write!(f, "Tn<{N}> {{")?;
        }
        for (i, angle) in self.0.iter().enumerate() {
            let comma = if i == 0 { "" } else { "," };
            write!(f, "{comma} th{}: {angle:.p$}", i + 1)?;
        }
        write!(f, " }}")
    }
}

impl<const N: usize> Configuration for Tn<N> {
    fn is_finite(&self) -> bool {
        self.0.iter().all(|a| a.is_finite())
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        let turns: [f64; N] = std::array::from_fn(|k| wrap(in_range(to.0[k]) - in_range(self.0[k])));
        Ok(Coordinates::from_slice(&turns))
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        if s >= 1.0 {
            return Ok(*to);
        }
        if s == 0.0 {
            return Ok(*self);
        }
        let mut angles = self.0;
        for (angle, target) in angles.iter_mut().zip(&to.0) {
            let from = in_range(*angle);
            *angle = wrap(from + s * wrap(in_range(*target) - from));
        }
        Ok(Tn(angles))
    }

    fn in_chart(&self) -> Self {
        Tn(self.0.map(in_range))
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates::from_slice(&self.0)
    }

    fn coordinate_names(&self) -> Vec<String> {
        (1..=N).map(|i| format!("th{i}")).collect()
    }

    fn from_coordinates(coordinates: &[f64]) -> Option<Self> {
        coordinates.try_into().ok().map(Tn)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn the_chart_line_goes_the_short_way_and_pi_the_positive_way() {
        let a = T2::new(3.0, -PI / 2.0);
        let b = T2::new(-3.0, PI / 2.0);
        let d = a.difference(&b).unwrap();
        assert!((d[0] - (2.0 * PI - 6.0)).abs() < 1e-15);
        assert_eq!(d[1], PI);
        assert_eq!(b.difference(&a).unwrap()[1], PI, "a difference of exactly pi goes the positive way");
        assert_eq!(a.interpolate(&b, 1.0).unwrap(), b);
        assert_eq!(a.interpolate(&b, 0.0).unwrap(), a);
        assert!((a.interpolate(&b, 0.5).unwrap().0[1]).abs() < 1e-15);
    }

    #[test]
    fn prints_as_its_type() {
        assert_eq!(T2::new(0.785, 1.571).to_string(), "T2 { th1: 0.785, th2: 1.571 }");
        assert_eq!(Tn([0.1, 0.2, 0.3]).to_string(), "Tn<3> { th1: 0.100, th2: 0.200, th3: 0.300 }");
    }
}
