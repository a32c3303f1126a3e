//! `SamplingSettings`, what sampling planners take beside the problem.

use super::Metric;
use crate::collision::Problem;
use crate::configuration::Chart;
use crate::num::{greater, sqrt};
use crate::robots::Robot;

/// The greatest length of a new edge, as a share of the space's radius.
const STEP: f64 = 0.2;

/// The settings of sampling planners.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplingSettings {
    /// The metric by which nodes are near.
    pub metric: Metric,
    /// The greatest length of a new edge, by the metric.
    pub step: f64,
    /// The share of samples that are the goal, for planners that grow from the start alone.
    pub goal_bias: f64,
}

impl SamplingSettings {
    /// The configuration at most a step from `from` on the way to `to`; `None` where no edge joins them.
    pub fn toward<C: Chart>(&self, from: &C, to: &C) -> Option<C> {
        let share = self.step / self.metric.distance(from, to);
        if share >= 1.0 { Some(*to) } else { from.interpolate(to, share).ok() }
    }

    /// The usual settings for a problem: metres and radians count alike, a step is a fifth of the space's radius, and
    /// one sample in twenty is the goal.
    pub fn of<R: Robot<Configuration: Chart>>(problem: &Problem<R>) -> Self {
        let bounds = problem.checker().scene().bounds();
        let half = 0.5 * greater(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let metric = Metric::unit(&problem.start());
        let radius = |is_angle| if is_angle { std::f64::consts::PI } else { half };
        let squares = metric.axes().iter().map(|axis| radius(axis.is_angle) * radius(axis.is_angle));
        let step = STEP * sqrt(squares.sum());
        SamplingSettings { metric, step, goal_bias: 0.05 }
    }
}
