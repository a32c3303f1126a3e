//! `Metric`, how far apart two configurations are.

use crate::configuration::{Chart, gap};
use crate::num::sqrt;
use crate::short_list::ShortList;

/// One coordinate of a chart, as a metric measures it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MetricAxis {
    pub(super) weight: f64,
    pub(super) is_angle: bool,
}

/// A weighted metric of a configuration space: the root of the sum of the squared differences, each times its weight,
/// angles the short way round. It is [`Chart::distance`] with its weights kept.
///
/// ```
/// use motion_lab_core::planning::Metric;
/// use motion_lab_core::prelude::*;
/// let (a, b) = (Pose2::new(0.0, 0.0, 3.0), Pose2::new(0.3, 0.4, -3.0));
/// let metric = Metric::try_weighted(&a, &[1.0, 1.0, 0.0])?; // a disc: its heading does not matter
/// assert_eq!(metric.distance(&a, &b), 0.5);
/// # Ok::<(), motion_lab_core::planning::MetricError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    axes: ShortList<MetricAxis, 4>,
}

/// Why a metric is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricError {
    /// Another number of weights than coordinates.
    #[error("{found} weights for {expected} coordinates")]
    Count {
        /// How many there are.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// A weight that is negative or not finite.
    #[error("weight {number} is {weight}: it must be finite and not negative")]
    Weight {
        /// The number of the weight, from 0.
        number: usize,
        /// The weight.
        weight: f64,
    },
}

impl Metric {
    /// The metric of the space of `like` in which a metre counts as much as a radian.
    pub fn unit<C: Chart>(like: &C) -> Self {
        let axis = |i| MetricAxis { weight: 1.0, is_angle: like.is_angle(i) };
        Metric { axes: (0..like.coordinates().len()).map(axis).collect() }
    }

    /// The metric of the space of `like` with these weights: of an angle in metres per radian, say. A weight of 0
    /// leaves a coordinate out.
    ///
    /// # Errors
    /// [`MetricError`]: another number of weights, or one that is negative or not finite.
    pub fn try_weighted<C: Chart>(like: &C, weights: &[f64]) -> Result<Self, MetricError> {
        let mut metric = Metric::unit(like);
        if weights.len() != metric.axes.len() {
            return Err(MetricError::Count { found: weights.len(), expected: metric.axes.len() });
        }
        for (number, &weight) in weights.iter().enumerate() {
            if !(weight >= 0.0 && weight.is_finite()) {
                return Err(MetricError::Weight { number, weight });
            }
            metric.axes[number].weight = weight;
        }
        Ok(metric)
    }

    /// The weights, one for each coordinate.
    pub fn weights(&self) -> ShortList<f64, 4> {
        self.axes.iter().map(|axis| axis.weight).collect()
    }

    /// The distance of two configurations; infinity where one does not lie in the metric's space.
    pub fn distance<C: Chart>(&self, a: &C, b: &C) -> f64 {
        sqrt(self.squared(&a.coordinates(), &b.coordinates()))
    }

    pub(super) fn axes(&self) -> &[MetricAxis] {
        &self.axes
    }

    /// The squared distance of two points by their coordinates.
    pub(super) fn squared(&self, a: &[f64], b: &[f64]) -> f64 {
        self.squared_or_more(a, b, f64::INFINITY)
    }

    /// The squared distance of two points by their coordinates; any number above `most` where it is above `most`, for
    /// the sum of the first squares may be so already.
    #[inline]
    pub(super) fn squared_or_more(&self, a: &[f64], b: &[f64], most: f64) -> f64 {
        let axes = self.axes();
        if a.len() != axes.len() || b.len() != axes.len() {
            return f64::INFINITY;
        }
        let mut sum = 0.0;
        for (axis, (a, b)) in axes.iter().zip(a.iter().zip(b)) {
            let d = axis.weight * gap(*a, *b, axis.is_angle);
            sum += d * d;
            if sum > most {
                break;
            }
        }
        sum
    }
}
