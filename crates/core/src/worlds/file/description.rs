//! A world file as written, in RON. Only its form is checked.

use serde::Deserialize;

use super::sizes::{ArmText, CarText, DiscText, given};
use crate::configuration::WrittenCoordinate;
use crate::geometry::{Point2, Pose2};
use crate::worlds::BeamModel;

/// A point as written: `(x, y)`, metres.
pub type Xy = (f64, f64);

#[derive(Deserialize)]
#[serde(rename = "World", deny_unknown_fields)]
pub(crate) struct WorldText {
    pub version: u64,
    pub name: String,
    pub bounds: BoundsText,
    #[serde(default)]
    pub walls: Vec<PolylineText>,
    #[serde(default)]
    pub obstacles: Vec<ObstacleText>,
    #[serde(default)]
    pub doors: Vec<DoorText>,
    #[serde(default)]
    pub routes: Vec<RouteText>,
    #[serde(default)]
    pub places: Vec<PlaceText>,
    #[serde(default)]
    pub marks: Vec<PolylineText>,
    #[serde(default)]
    pub robots: Vec<RobotText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoundsText {
    pub min: Xy,
    pub max: Xy,
}

/// A wall or a mark.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PolylineText {
    pub name: String,
    pub points: Vec<Xy>,
    /// Whether a last piece leads back to the first point.
    #[serde(default)]
    pub closed: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ObstacleText {
    pub name: String,
    pub shape: ShapeText,
}

/// The shape of an obstacle as a world file has it. Only its form is checked.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ShapeText {
    /// A disc.
    Disc {
        /// Its centre.
        center: Xy,
        /// Its radius, metres.
        radius: f64,
    },
    /// A box with sides along the axes.
    Box {
        /// Its lower left corner.
        min: Xy,
        /// Its upper right corner.
        max: Xy,
    },
    /// A simple polygon, convex or not, in either orientation.
    Polygon(Vec<Xy>),
    /// All points within `radius` of the convex hull of `points`.
    Rounded {
        /// Two points at least.
        points: Vec<Xy>,
        /// Metres.
        radius: f64,
    },
    /// All of several shapes.
    Union(Vec<ShapeText>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DoorText {
    pub name: String,
    pub hinge: Xy,
    pub end: Xy,
    pub open: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RouteText {
    pub name: String,
    pub points: Vec<Xy>,
    pub radius: f64,
    pub speed: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaceText {
    pub name: String,
    pub pose: PoseText,
}

/// A pose. Only its angle may be written in degrees.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "Pose2", deny_unknown_fields)]
pub(crate) struct PoseText {
    pub x: f64,
    pub y: f64,
    pub theta: WrittenCoordinate,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RobotText {
    pub name: String,
    pub kind: String,
    pub start: Vec<WrittenCoordinate>,
    #[serde(default, deserialize_with = "given")]
    pub disc: Option<DiscText>,
    #[serde(default, deserialize_with = "given")]
    pub arm: Option<ArmText>,
    #[serde(default, deserialize_with = "given")]
    pub car: Option<CarText>,
    #[serde(default, deserialize_with = "given")]
    pub sensor: Option<BeamModel>,
    #[serde(default)]
    pub sensors: Vec<SensorText>,
    #[serde(default, deserialize_with = "given")]
    pub route: Option<String>,
}

/// A range sensor of a robot.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SensorText {
    pub name: String,
    pub rays: u32,
    pub range: f64,
    /// Radians; a full turn when left out.
    #[serde(default, deserialize_with = "given")]
    pub field_of_view: Option<WrittenCoordinate>,
    #[serde(default, deserialize_with = "given")]
    pub mount: Option<PoseText>,
    #[serde(default, deserialize_with = "given")]
    pub noise: Option<BeamModel>,
}

impl From<Pose2> for PoseText {
    fn from(Pose2 { x, y, theta }: Pose2) -> Self {
        PoseText { x, y, theta: WrittenCoordinate::number(theta) }
    }
}

impl From<PoseText> for Pose2 {
    fn from(PoseText { x, y, theta }: PoseText) -> Self {
        Pose2 { x, y, theta: theta.value() }
    }
}

/// An item with a name.
pub(crate) trait Named {
    fn name(&self) -> &str;
}

macro_rules! named {
    ($($text:ty),*) => { $(impl Named for $text {
        fn name(&self) -> &str {
            &self.name
        }
    })* };
}
named!(PolylineText, ObstacleText, DoorText, RouteText, PlaceText, RobotText);

/// Converts a written point; a negative zero becomes a positive one.
pub(crate) fn point((x, y): Xy) -> Point2 {
    Point2::new(x + 0.0, y + 0.0)
}
