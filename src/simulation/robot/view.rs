//! `RobotView`, a robot's state for views that do not know its type.

use crate::configuration::{Coordinates, RobotKind};
use crate::geometry::{Footprint, Point2};
use crate::robots::{AnyRobot, EncoderCounts};

/// A robot as a view shows it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotView {
    /// The id.
    pub id: u32,
    /// The unique name.
    pub name: String,
    /// The kind, as worlds name it.
    pub kind: String,
    /// The kind's description, if it has one.
    pub about: Option<&'static RobotKind>,
    /// The robot with its own sizes, if it is one of the lab's. [`AnyRobot::fitted`] fits it to a configuration.
    pub model: Option<AnyRobot>,
    /// The number of the world it lives in.
    pub world: u32,
    /// The configuration as its type prints, three decimals.
    pub configuration: String,
    /// The configuration with every digit, for copying.
    pub configuration_in_full: String,
    /// The configuration's coordinates in its chart.
    pub coordinates: Coordinates,
    /// The footprint.
    pub footprint: Footprint,
    /// The footprint before the last tick's motion, for drawing between ticks.
    pub previous_footprint: Footprint,
    /// The tip of an arm, in the world; `None` for other robots.
    pub tip: Option<Point2>,
    /// Whether the last tick was in contact.
    pub in_contact: bool,
    /// Contact episodes since tick 0.
    pub contacts: u32,
    /// Ticks for which the flash still holds; above 0 the robot shows red.
    pub flash: u32,
    /// Whether a person drives.
    pub manual: bool,
    /// The channels the driver holds, -128 to 128 of the maximum.
    pub channels: [i16; 2],
    /// Inputs refused since tick 0.
    pub refusals: u32,
    /// The readings of the wheels' encoders; `None` without encoders.
    pub encoders: Option<EncoderCounts>,
    /// The distance travelled according to the encoders, metres; `None` without encoders.
    pub odometer: Option<f64>,
}
