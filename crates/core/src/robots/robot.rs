//! `Robot` and `Drivable`, what planners and the simulator know of a robot.

use super::linkage::Linkage;
use super::motion::{Leaving, Motion, Rates};
use crate::configuration::{ChartMismatch, Configuration};
use crate::geometry::{Footprint, Point2, Segment, Vector2};
use crate::random::Stream;
use crate::short_list::ShortList;

/// The length of a tick, seconds: the simulator's time step, and that of the integration of a car's trailer.
pub const TICK: f64 = 0.05;

/// The units of a driver's channel, as scripts hold it, that stand for the maximum: a channel goes from -128 to 128.
pub const CHANNEL_UNITS: f64 = 128.0;

/// The rates of a footprint's parts, in the parts' order.
pub type PartRates = ShortList<Rates, 3>;

/// The velocity of a point of the robot per unit of each coordinate's rate, in the coordinates' order: metres per metre
/// and metres per radian. The columns of the point's Jacobian.
pub type PointJacobian = ShortList<Vector2, 4>;

/// Why a configuration or a control is not one of this robot's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigurationError {
    /// A coordinate that is NaN or infinite.
    #[error("the configuration is not finite")]
    NotFinite,
    /// A control or a time step that is NaN or infinite.
    #[error("the control or the time step is not finite")]
    ControlNotFinite,
    /// A time step of a car that is too long: more than an hour, 72,000 ticks.
    #[error("the time step is longer than an hour, 72000 ticks")]
    TooLong,
    /// A trailer heading for a car without a hitch.
    #[error("the configuration has a trailer heading, but the car has no hitch")]
    TrailerWithoutHitch,
    /// A car with a hitch, but no trailer heading.
    #[error("the car has a hitch, but the configuration has no trailer heading")]
    HitchWithoutTrailer,
    /// A configuration of another robot.
    #[error("the configuration is one of another robot")]
    OtherRobot,
    /// The two ends of an edge lie in different spaces.
    #[error(transparent)]
    ChartMismatch(#[from] ChartMismatch),
}

/// A robot: its configuration space, its footprint R(q), and the bound on how far an edge moves each part.
///
/// This is all that a planner, a collision checker and the certified march need; [`Drivable`] adds controls.
pub trait Robot: Clone + std::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The type of its configurations.
    type Configuration: Configuration;

    /// Checks that `q` is a configuration of this very robot.
    ///
    /// # Errors
    /// [`ConfigurationError`]: not finite, or in the wrong space (a trailer heading without a hitch).
    fn check(&self, q: &Self::Configuration) -> Result<(), ConfigurationError>;

    /// The footprint R(q). The number and order of the parts do not depend on `q`.
    ///
    /// A configuration that [`check`](Self::check) refuses gives a footprint that fails safe.
    fn footprint(&self, q: &Self::Configuration) -> Footprint;

    /// For each part, bounds on the speed and acceleration of its core's points along the chart's straight line
    /// from `a` to `b`, per unit of the line's parameter in `[0, 1]`.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of this robot.
    fn edge_rates(&self, a: &Self::Configuration, b: &Self::Configuration) -> Result<PartRates, ConfigurationError>;

    /// A configuration drawn uniformly: positions in the box from `min` to `max`, angles in `(-pi, pi]`. How many
    /// numbers are drawn does not depend on their values.
    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> Self::Configuration;

    /// The point by which the robot is somewhere, metres: a rover's centre, the middle of a car's rear axle. Planners
    /// keep it within the scene's bounds. `None` for a robot that moves on the spot, as an arm does, and for one that
    /// does not say.
    fn position(&self, _q: &Self::Configuration) -> Option<Point2> {
        None
    }

    /// The line that the footprint's centre follows along the chart's straight line from `a` to `b`, and the
    /// footprint's radius, metres; `None` where the robot is not a disc.
    fn disc_line(&self, _a: &Self::Configuration, _b: &Self::Configuration) -> Option<(Segment, f64)> {
        None
    }

    /// The chart's straight line from `a` to `b` as a linkage, where the robot moves as one. The checker takes it for
    /// what the footprints along the line say.
    #[doc(hidden)]
    fn edge_linkage(&self, _a: &Self::Configuration, _b: &Self::Configuration) -> Option<Linkage> {
        None
    }

    /// The Jacobian of the point that is at `point` in the world, metres, and moves with part number `part`, at `q`.
    /// `None` for a part that the robot does not have, and for a robot that does not say.
    fn jacobian(&self, _q: &Self::Configuration, _part: usize, _point: Point2) -> Option<PointJacobian> {
        None
    }

    /// Whether `q` lies within the robot's own limits, which no obstacle sets, such as the angle of a hitch. A
    /// configuration outside is not free. The limit itself lies within.
    ///
    /// A robot that overrides this overrides [`edge_leaves`](Self::edge_leaves) too, and
    /// [`Motion::leaves_limits`] of its drives.
    fn is_within_limits(&self, _q: &Self::Configuration) -> bool {
        true
    }

    /// Where the chart's straight line from `a` to `b` first leaves the robot's own limits; `None` where it stays
    /// within them.
    fn edge_leaves(&self, _a: &Self::Configuration, _b: &Self::Configuration) -> Option<Leaving> {
        None
    }

    /// The motion along the straight line of the configuration chart from `a` to `b`, angles the short way round.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of this robot.
    fn edge(&self, a: &Self::Configuration, b: &Self::Configuration) -> Result<ChartLine<Self>, ConfigurationError> {
        ChartLine::try_new(self, a, b)
    }
}

/// A robot with controls: a constant control over a time step drives it along a motion.
pub trait Drivable: Robot {
    /// The control held over a step.
    type Control: Copy + Default + PartialEq + std::fmt::Debug + Send + Sync + 'static;
    /// The motion of one step.
    type Drive: Motion<Configuration = Self::Configuration>;

    /// The motion from `q` under the constant control `u` for `dt` seconds.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this robot, or `u` or `dt` is not finite.
    fn drive(&self, q: &Self::Configuration, u: &Self::Control, dt: f64) -> Result<Self::Drive, ConfigurationError>;
}

/// The velocity of a point that turns about another at a radian per second, counter-clockwise.
pub(super) fn turning(point: Point2, about: Point2) -> Vector2 {
    Vector2::new(about.y - point.y, point.x - about.x)
}

/// An angle drawn uniformly from `(-pi, pi]`.
pub(super) fn sample_angle(stream: &mut Stream) -> f64 {
    use std::f64::consts::PI;
    PI - 2.0 * PI * stream.unit()
}

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

    fn linkage(&self) -> Option<Linkage> {
        self.robot.edge_linkage(&self.from, &self.to)
    }

    fn leaves_limits(&self) -> Option<Leaving> {
        self.robot.edge_leaves(&self.from, &self.to)
    }
}
