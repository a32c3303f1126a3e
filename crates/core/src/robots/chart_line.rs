//! `ChartLine`, the straight line of a configuration chart as a motion.

use super::{ConfigurationError, Leaving, Motion, PartRates, Rates, Robot};
use crate::configuration::Configuration;
use crate::geometry::{Footprint, Segment};

/// The motion along the chart's straight line between two configurations, angles the short way round.
#[derive(Clone, Debug)]
pub struct ChartLine<R: Robot> {
    robot: R,
    from: R::Configuration,
    to: R::Configuration,
    rates: PartRates,
}

impl<R: Robot> ChartLine<R> {
    /// The line from `from` to `to`, angles outside `(-pi, pi]` wrapped.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of `robot`.
    pub fn try_new(robot: &R, from: &R::Configuration, to: &R::Configuration) -> Result<Self, ConfigurationError> {
        robot.check(from)?;
        robot.check(to)?;
        let (from, to) = (from.in_chart(), to.in_chart());
        let rates = robot.edge_rates(&from, &to)?;
        Ok(ChartLine { robot: robot.clone(), from, to, rates })
    }
}

impl<R: Robot> Motion for ChartLine<R> {
    type Configuration = R::Configuration;

    fn at(&self, s: f64) -> R::Configuration {
        // The ends were checked to lie in one space, so the fallback is never taken.
        self.from.interpolate(&self.to, s).unwrap_or(self.from)
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        self.robot.footprint(&self.at(s))
    }

    fn rates(&self, part: usize) -> Rates {
        self.rates[part]
    }

    fn disc_line(&self) -> Option<(Segment, f64)> {
        self.robot.disc_line(&self.from, &self.to)
    }

    fn leaves_limits(&self) -> Option<Leaving> {
        self.robot.edge_leaves(&self.from, &self.to)
    }
}
