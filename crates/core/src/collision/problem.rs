//! `Problem`, what a planner is given.

use std::fmt::Debug;
use std::sync::Arc;

use super::Checker;
use crate::configuration::Configuration;
use crate::random::{Seed, Stream};
use crate::robots::{ConfigurationError, Robot};
use crate::worlds::OutsideError;

/// A set of configurations, any of which is good enough as a goal.
pub trait GoalRegion<C>: Debug + Send + Sync {
    /// Whether `q` lies in it.
    fn contains(&self, q: &C) -> bool;
}

/// A planning problem: a robot in a scene, from a start to a goal, with a seeded stream of samples.
///
/// Start, goal and every path between them lie within the scene's bounds, whose sides belong to them: the robot's
/// [position](Robot::position) does, all the way. Its footprint may reach over them. A robot without a position, as an
/// arm, is not held by them.
#[derive(Clone, Debug)]
pub struct Problem<R: Robot> {
    checker: Checker<R>,
    start: R::Configuration,
    goal: R::Configuration,
    region: Option<Arc<dyn GoalRegion<R::Configuration>>>,
    samples: Stream,
}

/// Why a problem is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// The start or the goal is not a configuration of the robot.
    #[error("the {end}: {source}")]
    Configuration {
        /// `start` or `goal`.
        end: &'static str,
        /// What is wrong with it.
        source: ConfigurationError,
    },
    /// The start or the goal lies outside the robot's own limits: the hitch folds too far.
    #[error("the {end} lies outside the robot's own limits")]
    Limit {
        /// `start` or `goal`.
        end: &'static str,
    },
    /// The start or the goal lies outside the scene's bounds.
    #[error(transparent)]
    Outside(#[from] OutsideError),
    /// The goal does not lie in its own region.
    #[error("the goal does not lie in its own region")]
    OutsideRegion,
    /// The start or the goal overlaps or touches an obstacle.
    #[error("the {end} would overlap {obstacle}")]
    Overlap {
        /// `start` or `goal`.
        end: &'static str,
        /// The name of the obstacle.
        obstacle: String,
    },
    /// The start or the goal is free, and not as far from an obstacle as is to be kept.
    #[error("the {end} has a clearance of {clearance} m from {obstacle}; it is to keep more than {kept} m")]
    Clearance {
        /// `start` or `goal`.
        end: &'static str,
        /// The name of the obstacle.
        obstacle: String,
        /// What it has, metres.
        clearance: f64,
        /// What is to be kept, metres.
        kept: f64,
    },
}

impl<R: Robot> Problem<R> {
    /// The problem of moving the robot from `start` to `goal`; samples come from the stream `planner` of `seed`.
    ///
    /// # Errors
    /// [`ProblemError`] when either end is not one of the robot's configurations, is not free, or lies outside the
    /// scene's bounds.
    pub fn try_new(
        checker: Checker<R>,
        start: R::Configuration,
        goal: R::Configuration,
        seed: Seed,
    ) -> Result<Self, ProblemError> {
        for (end, q) in [("start", &start), ("goal", &goal)] {
            if let Some(at) = checker.robot().position(q).filter(|at| at.x.is_finite() && at.y.is_finite()) {
                OutsideError::check(end, at, &checker.scene().bounds())?;
            }
            let witness = checker.witness(q).map_err(|source| ProblemError::Configuration { end, source })?;
            if let Some(w) = witness.filter(|w| w.dist == 0.0) {
                let obstacle = checker.scene().obstacle_name(w.obstacle).unwrap_or("an obstacle").to_owned();
                return Err(ProblemError::Overlap { end, obstacle });
            }
            if !checker.robot().is_within_limits(q) {
                return Err(ProblemError::Limit { end });
            }
        }
        Ok(Problem { checker, start, goal, region: None, samples: Stream::new(seed, "planner") })
    }

    /// The same problem, solved by reaching any configuration of a region. The goal stays the one to head for.
    ///
    /// # Errors
    /// [`ProblemError::OutsideRegion`] when the goal does not lie in the region.
    pub fn try_with_region(self, region: Arc<dyn GoalRegion<R::Configuration>>) -> Result<Self, ProblemError> {
        if !region.contains(&self.goal) {
            return Err(ProblemError::OutsideRegion);
        }
        Ok(Problem { region: Some(region), ..self })
    }

    /// Whether reaching `q` solves the problem: it is the goal, its angles in range, or lies in the goal's region.
    pub fn is_goal(&self, q: &R::Configuration) -> bool {
        q.in_chart() == self.goal.in_chart() || self.region.as_ref().is_some_and(|region| region.contains(q))
    }

    /// The region around the goal, where there is one.
    pub fn region(&self) -> Option<&dyn GoalRegion<R::Configuration>> {
        self.region.as_deref()
    }

    /// The robot in its scene.
    pub fn checker(&self) -> &Checker<R> {
        &self.checker
    }

    /// The start configuration.
    pub fn start(&self) -> R::Configuration {
        self.start
    }

    /// The goal configuration.
    pub fn goal(&self) -> R::Configuration {
        self.goal
    }

    /// The stream that the samples come from, for samples of a planner's own: near a configuration, toward the goal.
    pub fn stream(&mut self) -> &mut Stream {
        &mut self.samples
    }

    /// The next configuration of the stream, uniform over the scene's bounds and the circle; not necessarily free.
    pub fn sample(&mut self) -> R::Configuration {
        let bounds = self.checker.scene().bounds();
        self.checker.robot().sample(bounds.min, bounds.max, &mut self.samples)
    }

    /// The next free configuration of the stream; `None` when `tries` samples are all in contact.
    pub fn sample_free(&mut self, tries: u32) -> Option<R::Configuration> {
        for _ in 0..tries {
            let q = self.sample();
            if self.checker.is_free(&q) {
                return Some(q);
            }
        }
        None
    }
}
