//! Robots: the footprint at each configuration, and bounds on how far a motion moves it.
//!
//! The lab's robots in numbers:
//!
//! | robot | number | value |
//! |---|---|---|
//! | Rusty, [`RUSTY`] | radius of the disc | 0.11 m |
//! | | distance between the wheels, radius of a wheel | 0.16 m, 0.033 m |
//! | | encoder counts a turn, greatest slip of a wheel | 360, 5 % |
//! | | greatest speed, greatest turn rate | 0.6 m/s, 2.5 rad/s |
//! | Reach, [`workbench`](Reach::workbench) | base | at the origin |
//! | | lengths and radius of the two links | 1 m and 1 m, 0.03 m |
//! | | joint limits, greatest joint speed | none |
//! | Reach with bare links, [`choset`](Reach::choset) | lengths and radius | 1 m and 1 m, 0 |
//! | Reach with three links, [`redundant`](Reach::redundant) | lengths and radius | 0.6, 0.5 and 0.4 m, 0.03 m |
//! | Hitch, [`HITCH`] | length and width of the chassis | 3.9 m, 1.7 m |
//! | | distance between the axles, overhang at either end | 2.5 m, 0.7 m |
//! | | greatest speed, greatest steering angle | 1.5 m/s, 0.6 rad |
//! | | least radius of the rear axle's path | 3.654 m |
//! | its trailer, [`with_trailer`](Hitch::with_trailer) | length and width of the box | 1.8 m, 1.5 m |
//! | | the box ahead of its axle, and behind | 1 m, 0.8 m |
//! | | from the hitch, at the car's rear axle, to the trailer's axle | 2 m |
//!
//! Speeds, rates and steering angles are limits either way. An arm is where its command puts it; its tour turns no
//! joint faster than 2 rad/s.
//!
//! ```
//! use motion_lab_core::robots::{HITCH, RUSTY, Reach};
//! // the numbers are public
//! assert_eq!((RUSTY.body_radius, RUSTY.track, RUSTY.wheel_radius), (0.11, 0.16, 0.033));
//! let (arm, longer, towing) = (Reach::<2>::workbench(), Reach::<3>::redundant(), HITCH.with_trailer());
//! assert_eq!((arm.lengths, arm.link_radius, longer.lengths), ([1.0, 1.0], 0.03, [0.6, 0.5, 0.4]));
//! assert_eq!((towing.body.length, towing.body.width, towing.wheelbase), (3.9, 1.7, 2.5));
//! assert_eq!((towing.trailer_body.width, towing.hitch_len), (1.5, Some(2.0)));
//! assert!((1.0 / towing.curvature(towing.max_steer) - 3.654).abs() < 5e-4);
//! ```

mod any;
mod chart_line;
mod check_rates;
mod hitch;
mod hitch_arc;
mod jackknife;
mod motion;
mod reach;
mod rusty;
mod sizes;

pub use any::AnyRobot;
pub use chart_line::ChartLine;
pub use check_rates::{Bound, RatesError, RatesUse, check_drive_rates, check_rates};
pub use hitch::{CarBody, CarCmd, HITCH, Hitch, TrailerBody};
pub use hitch_arc::HitchArc;
#[doc(hidden)]
pub use motion::Beginning;
pub use motion::{Leaving, Motion, Rates};
pub use reach::{JointPoints, Reach, ReachError};
pub use rusty::{EncoderCounts, RUSTY, Rusty, RustyArc, RustyCmd, RustyDisc, WheelSlip, WheelTurns};

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

    /// The line that the footprint's centre follows along the chart's straight line from `a` to `b`, and the
    /// footprint's radius, metres; `None` where the robot is not a disc.
    fn disc_line(&self, _a: &Self::Configuration, _b: &Self::Configuration) -> Option<(Segment, f64)> {
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
fn turning(point: Point2, about: Point2) -> Vector2 {
    Vector2::new(about.y - point.y, point.x - about.x)
}

/// An angle drawn uniformly from `(-pi, pi]`.
fn sample_angle(stream: &mut Stream) -> f64 {
    use std::f64::consts::PI;
    PI - 2.0 * PI * stream.unit()
}
