//! Goal regions: what is near enough to a goal.

use super::Metric;
use crate::collision::GoalRegion;
use crate::configuration::{Chart, Tn};
use crate::geometry::Point2;
use crate::robots::Reach;

/// The configurations within a distance of a centre, that distance included.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<C> {
    /// The centre.
    pub centre: C,
    /// The radius, by the metric.
    pub radius: f64,
    /// The metric.
    pub metric: Metric,
}

impl<C: Chart> GoalRegion<C> for Ball<C> {
    fn contains(&self, q: &C) -> bool {
        self.metric.distance(&self.centre, q) <= self.radius
    }
}

/// The configurations of an arm whose tip lies in a disc of the workspace.
///
/// ```
/// use std::sync::Arc;
/// use motion_lab_core::planning::{Bounds, Rrt, TipDisc, solve};
/// use motion_lab_core::prelude::*;
/// let (scene, arm) = (Scene::workbench(), Reach::<2>::workbench());
/// let goal = T2::new(3.1, 0.0);
/// let region = TipDisc { arm, centre: arm.tip(&goal), radius: 0.2 };
/// let problem = Problem::try_new(Checker::new(scene, arm), T2::new(2.0, 0.0), goal, Seed(1))?;
/// let path = solve(&mut Rrt::new(problem.try_with_region(Arc::new(region))?), &Bounds::default())?;
/// assert!((arm.tip(&path.goal()) - region.centre).norm() <= 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipDisc<const N: usize> {
    /// The arm.
    pub arm: Reach<N>,
    /// The centre of the disc, metres.
    pub centre: Point2,
    /// Its radius, metres; its edge belongs to it.
    pub radius: f64,
}

impl<const N: usize> GoalRegion<Tn<N>> for TipDisc<N> {
    fn contains(&self, q: &Tn<N>) -> bool {
        (self.arm.tip(q) - self.centre).norm() <= self.radius
    }
}
