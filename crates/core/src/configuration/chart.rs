//! `Chart`, the exponential, the logarithm and the metric of a configuration space.

use std::f64::consts::TAU;

use super::{AnyConfiguration, ChartMismatch, Configuration, Coordinates, HitchCfg, R2, Tn};
use crate::geometry::Pose2;
use crate::num::{in_range, lesser, sqrt, wrap};

/// A configuration space with its chart: what planners add to a [`Configuration`].
///
/// The chart is the one in which edges are straight. Its tangent vectors are differences of coordinates, metres and
/// radians. A configuration type of one's own says which of its coordinates are angles; the rest is provided.
///
/// ```
/// use motion_lab_core::configuration::Chart;
/// use motion_lab_core::prelude::*;
/// let (a, b) = (T2::new(3.0, 0.0), T2::new(-3.0, 0.5));
/// let v = a.log(&b)?;
/// assert!(v[0] > 0.0 && v[0] < 0.3); // across pi, the short way round
/// assert!(a.exp(&v).unwrap().distance(&b, &[1.0, 1.0]) < 1e-15);
/// # Ok::<(), motion_lab_core::configuration::ChartMismatch>(())
/// ```
pub trait Chart: Configuration {
    /// Whether coordinate number `index` is an angle, radians; otherwise it is a length, metres.
    fn is_angle(&self, index: usize) -> bool;

    /// The logarithm: the tangent vector at `self` that leads to `to`, angles the short way round.
    ///
    /// # Errors
    /// [`ChartMismatch`] when the two lie in different spaces.
    fn log(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        self.difference(to)
    }

    /// The exponential: the configuration that a tangent vector at `self` leads to, angles wrapped. `None` when the
    /// vector has another number of components than the chart, or the result is not finite.
    fn exp(&self, tangent: &[f64]) -> Option<Self> {
        moved(self, tangent).and_then(|c| Self::from_coordinates(&c))
    }

    /// The distance to another configuration: the length of the logarithm with each component times its weight. A
    /// missing weight counts as 1. Infinity between different spaces.
    ///
    /// It is symmetric to the last bit. With weights in metres per radian for angles its unit is the metre.
    fn distance(&self, to: &Self, weights: &[f64]) -> f64 {
        let (a, b) = (self.coordinates(), to.coordinates());
        if a.len() != b.len() {
            return f64::INFINITY;
        }
        let weights = weights.iter().copied().chain(std::iter::repeat(1.0));
        let squares = a.iter().zip(&b).zip(weights).enumerate().map(|(i, ((a, b), weight))| {
            let d = weight * gap(*a, *b, self.is_angle(i));
            d * d
        });
        sqrt(squares.sum())
    }
}

/// How far apart two values of a coordinate are: for angles the short way round.
pub(crate) fn gap(a: f64, b: f64, is_angle: bool) -> f64 {
    if !is_angle {
        return (a - b).abs();
    }
    let d = (in_range(a) - in_range(b)).abs();
    lesser(d, TAU - d)
}

/// The coordinates of `q` moved by a tangent vector, if that fits and the result is finite.
fn moved<C: Chart>(q: &C, tangent: &[f64]) -> Option<Coordinates> {
    let at = q.coordinates();
    if at.len() != tangent.len() {
        return None;
    }
    let along = |(i, (c, step)): (usize, (&f64, &f64))| if q.is_angle(i) { wrap(c + step) } else { c + step };
    let moved: Coordinates = at.iter().zip(tangent).enumerate().map(along).collect();
    moved.iter().all(|c| c.is_finite()).then_some(moved)
}

impl Chart for R2 {
    fn is_angle(&self, _index: usize) -> bool {
        false
    }
}

impl Chart for Pose2 {
    fn is_angle(&self, index: usize) -> bool {
        index >= 2
    }
}

impl<const N: usize> Chart for Tn<N> {
    fn is_angle(&self, _index: usize) -> bool {
        true
    }
}

impl Chart for HitchCfg {
    fn is_angle(&self, index: usize) -> bool {
        index >= 2
    }
}

impl Chart for AnyConfiguration {
    fn is_angle(&self, index: usize) -> bool {
        AnyConfiguration::is_angle(self, index)
    }

    fn exp(&self, tangent: &[f64]) -> Option<Self> {
        moved(self, tangent).and_then(|c| self.with_coordinates(&c))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::random::{Seed, Stream};

    #[test]
    fn distances_by_hand() {
        let weights = [1.0, 1.0, 0.5, 2.0];
        // 3-4-5 in the plane
        assert_eq!(R2::new(1.0, 2.0).distance(&R2::new(4.0, -2.0), &[]), 5.0);
        // 2 m and 3 m, and a quarter turn across pi times 0.5
        let (a, b) = (Pose2::new(0.0, 0.0, 0.875 * PI), Pose2::new(2.0, 3.0, -0.875 * PI));
        assert!((a.distance(&b, &weights) - sqrt(13.0 + PI * PI / 64.0)).abs() < 1e-15);
        // the trailer half a turn round, weight 2
        let car = |psi| HitchCfg { body: Pose2::IDENTITY, trailer: Some(psi) };
        assert_eq!(car(0.0).distance(&car(PI), &weights), 2.0 * PI);
        assert_eq!(car(0.0).distance(&HitchCfg { body: Pose2::IDENTITY, trailer: None }, &weights), f64::INFINITY);
        assert!((Tn([3.0, 0.0]).distance(&Tn([-3.0, 0.0]), &[]) - (2.0 * PI - 6.0)).abs() < 1e-15);
        assert!(Tn([100.0 * PI]).distance(&Tn([0.0]), &[]) < 1e-13, "fifty turns on");
    }

    #[test]
    fn exp_undoes_log_and_refuses_what_does_not_fit() {
        let mut s = Stream::new(Seed(25), "chart");
        for _ in 0..2000 {
            let mut draw = || {
                let body = Pose2::new(s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0), s.uniform(-PI, PI));
                HitchCfg { body, trailer: Some(s.uniform(-PI, PI)) }
            };
            let (a, b) = (draw(), draw());
            let v = a.log(&b).unwrap();
            assert!(v[2].abs() <= PI && v[3].abs() <= PI, "the short way: {v:?}");
            assert!(a.exp(&v).unwrap().distance(&b, &[]) < 1e-14, "{a} {b}");
            let any = AnyConfiguration::Hitch(a);
            assert_eq!(any.exp(&v), a.exp(&v).map(AnyConfiguration::Hitch));
            assert_eq!(a.distance(&b, &[0.3, 2.0, 0.7]), b.distance(&a, &[0.3, 2.0, 0.7]));
        }
        assert_eq!(Tn([0.0, 0.0]).exp(&[1.0]), None);
        assert_eq!(R2::new(0.0, 0.0).exp(&[f64::INFINITY, 0.0]), None);
    }
}
