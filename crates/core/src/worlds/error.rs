//! Why a world file is refused, and where in it.

use std::fmt;

use super::{AllRaysError, BeamError, OutlineError, OutsideError, ResidentSensorError, RouteError};
use crate::configuration::{SizesError, WrittenCoordinateError};
use crate::geometry::ShapeError;
use crate::one_line::OneLine;

/// An item of a world file: `obstacles[1] "the post"`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldItem {
    /// The list it stands in: `walls`, `obstacles`, `doors`, `routes`, `places`, `marks` or `robots`.
    pub list: &'static str,
    /// Its index in that list, from 0.
    pub index: usize,
    /// Its name; empty when it has none that can be read.
    pub name: String,
}

impl fmt::Display for WorldItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", self.list, self.index)?;
        if self.name.is_empty() { Ok(()) } else { write!(f, " {:?}", self.name) }
    }
}

/// A world file that is refused: where, which item, and why.
///
/// Prints as `lot.ron:17:9: obstacles[0] "the west pillar": length 0 m: the smallest feature is 0.001 m`.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldError {
    /// The file, as the caller named it.
    pub file: String,
    /// The line, from 1: where the item begins, or where reading stopped.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// The item; `None` if the error lies outside the lists or the file is not RON.
    pub item: Option<Box<WorldItem>>,
    /// The reason.
    pub problem: Box<WorldProblem>,
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        match &self.item {
            Some(item) => write!(f, "{}", OneLine(format_args!("{item}: {}", self.problem))),
            None => write!(f, "{}", OneLine(&self.problem)),
        }
    }
}

impl std::error::Error for WorldError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        std::error::Error::source(self.problem.as_ref())
    }
}

/// Why a world file is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WorldProblem {
    /// Not RON, or not of the expected form: an unknown or missing field, a text where a number belongs.
    #[error("{0}")]
    Syntax(String),
    /// A version of the format that this program does not read.
    #[error("version {0}: this program reads version {version}", version = super::WORLD_VERSION)]
    Version(u64),
    /// A name that is empty, longer than 200 bytes, padded with blanks, or has a control character.
    #[error("name {0:?}: it must be 1 to 200 bytes without control characters and without blanks at its ends")]
    Name(String),
    /// A name that an earlier item has.
    #[error("the name is taken by {item} in line {line}")]
    NameTaken {
        /// The earlier item.
        item: WorldItem,
        /// The line it begins in.
        line: usize,
    },
    /// Too many items in a list, or too many shapes, corners of concave polygons or corners of routes in all.
    #[error("too many {what}: at most {most}", most = super::MAX_ITEMS)]
    TooMany {
        /// What there are too many of.
        what: &'static str,
    },
    /// A polyline with too few points.
    #[error("{found} points: it needs at least {least}")]
    TooFewPoints {
        /// How many points it has.
        found: usize,
        /// How many it needs.
        least: usize,
    },
    /// A piece of a polyline that is not a segment.
    #[error("from points[{index}] on: {source}")]
    Segment {
        /// The index of the piece's first point, from 0.
        index: usize,
        /// What is wrong with it.
        source: ShapeError,
    },
    /// A shape, position or bounds with bad numbers.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A box, or the bounds, with a greatest corner that is left of the least one or below it.
    #[error(
        "the box's corners are swapped: min ({}, {}) must lie left of and below max ({}, {})", min[0], min[1], max[0], max[1]
    )]
    SwappedBox {
        /// The corner that the file calls `min`, metres.
        min: [f64; 2],
        /// The corner that the file calls `max`, metres.
        max: [f64; 2],
    },
    /// A polygon with an invalid outline.
    #[error("polygon: {0}")]
    Outline(#[from] OutlineError),
    /// A union without members.
    #[error("a union of nothing")]
    EmptyUnion,
    /// A heading or start coordinate that is not finite.
    #[error("{0} is not a finite number")]
    NotFinite(&'static str),
    /// A robot of an unknown kind.
    #[error(
        "kind {0:?}: it must be `rusty`, `reach`, `reach3`, `hitch`, or begin with `x-` when a program registers its own"
    )]
    Kind(String),
    /// A start with the wrong number of coordinates.
    #[error("{found} start coordinate{}: a {kind} starts with {expected}", if *found == 1 { "" } else { "s" })]
    Start {
        /// The robot's kind.
        kind: String,
        /// The coordinates that it needs, in words.
        expected: &'static str,
        /// How many it has.
        found: usize,
    },
    /// A length of a robot's start in degrees.
    #[error(transparent)]
    Degrees(#[from] WrittenCoordinateError),
    /// A robot that is not within the world's bounds.
    #[error(transparent)]
    Outside(#[from] OutsideError),
    /// Sizes out of range, or of another sort of robot.
    #[error(transparent)]
    Sizes(#[from] SizesError),
    /// A sensor for a robot of a kind that has none.
    #[error("a {0} has no range sensor: leave out `sensor`")]
    NoSensor(String),
    /// Sensor noise that is not a probability distribution.
    #[error("sensor: {0}")]
    Beam(#[from] BeamError),
    /// One of a robot's own sensors that is refused.
    #[error(transparent)]
    Sensors(#[from] ResidentSensorError),
    /// Sensors with too many rays in all, up to this robot's.
    #[error(transparent)]
    AllRays(#[from] AllRaysError),
    /// A line that is no route.
    #[error(transparent)]
    Route(#[from] RouteError),
    /// A robot on a route that the world does not have.
    #[error("there is no route {0:?}")]
    NoSuchRoute(String),
    /// A route for a robot of a kind that does not drive.
    #[error("a {0} does not drive: leave out `route`")]
    NotRouted(String),
    /// A route with corners that a car cannot take.
    #[error("its turning circle has a radius of {least} m, and the corners of the route {route:?} have {radius} m")]
    TightRoute {
        /// The route.
        route: String,
        /// The radius of the route's corners, metres.
        radius: f64,
        /// The least radius that the car can drive, metres.
        least: f64,
    },
}
