//! `ScriptError`, why a script is refused, and the limits of scripts.

use super::script::{SCRIPT_VERSION, SCRIPT_VERSION_WITH_CHANGES};
use crate::tour::MAX_TICKS;
use motion_lab_core::configuration::{InputKind, RobotKind, Space};
use motion_lab_core::geometry::MAX_COORDINATE;
use motion_lab_core::one_line::OneLine;
use motion_lab_core::worlds::MAX_ITEMS;

/// Largest number of events in a script.
pub const MAX_EVENTS: usize = 1_000_000;
/// Largest number of coordinates in a `MoveTo` or `Teleport`.
pub const MAX_COORDINATES: usize = 64;
/// Largest number of shapes that are placed for a script's changes: those of a world at each tick that changes it,
/// whose scene is made anew, and those of each thing that changes after the first of its tick.
pub const MAX_CHANGED_SHAPES: u64 = 1_000_000_000;
/// The greatest absolute value of a control channel: the robot's maximum.
pub const MAX_CHANNEL: i16 = motion_lab_core::robots::CHANNEL_UNITS as i16;

/// A script that is refused: where, which event, and why.
///
/// Prints as `drive.ron:7: events[3]: channel 129: it must be in -128 to 128`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// The file, as the caller named it; empty for a script that was not read from text.
    pub file: String,
    /// The line, from 1: where the event begins, or where reading stopped; 0 for a script that was not read from text.
    pub line: usize,
    /// The list that the error lies in, `events` or `changes`; empty if it lies in neither.
    pub list: &'static str,
    /// The index in that list, from 0; `None` if the error lies outside the lists.
    pub event: Option<usize>,
    /// The reason.
    pub problem: ScriptProblem,
}

impl std::fmt::Display for ScriptError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.line > 0 {
            write!(f, "{}:{}: ", self.file, self.line)?;
        }
        if let Some(event) = self.event {
            write!(f, "{}[{event}]: ", self.list)?;
        }
        write!(f, "{}", OneLine(&self.problem))
    }
}

impl std::error::Error for ScriptError {}

/// Why a script is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScriptProblem {
    /// Not RON, or not of the expected form: an unknown or missing field, a number that doesn't fit its type.
    #[error("{0}")]
    Syntax(String),
    /// A version of the format that this program does not read.
    #[error("version {0}: this program reads versions {SCRIPT_VERSION} and {SCRIPT_VERSION_WITH_CHANGES}")]
    Version(u64),
    /// Changes of a world in a script of version 1.
    #[error("changes need version {SCRIPT_VERSION_WITH_CHANGES}")]
    Changes,
    /// More than [`MAX_EVENTS`] events and changes together.
    #[error("{0} events: at most {MAX_EVENTS}")]
    TooMany(usize),
    /// A tick that is 0 or beyond the longest run.
    #[error("tick {0}: it must be in 1 to {MAX_TICKS}")]
    Tick(u64),
    /// A tick before that of the event before it.
    #[error("tick {tick} comes after tick {before}: ticks must ascend")]
    Order {
        /// The event's tick.
        tick: u64,
        /// The tick of the event before it.
        before: u64,
    },
    /// A control channel beyond the maximum.
    #[error("channel {0}: it must be in -{MAX_CHANNEL} to {MAX_CHANNEL}")]
    Channel(i16),
    /// A coordinate that is too large.
    #[error("coordinate {0} (in units of 2^-20): its size must be at most {MAX_COORDINATE} m or rad")]
    Coordinate(i64),
    /// Too few or too many coordinates.
    #[error("{0} coordinates: there must be 1 to {MAX_COORDINATES}")]
    Coordinates(usize),
    /// A robot that the run does not have.
    #[error("there is no robot {0:?}")]
    Robot(String),
    /// An input that no robot of this kind takes.
    #[error(
        "tick {}: robot {:?} is a {} and takes no {}: it takes {}",
        .0.tick, .0.robot, .0.kind, .0.input, InputKind::listed(.0.about.takes)
    )]
    NotTaken(Box<UnfitInput>),
    /// A `MoveTo` or `Teleport` with a number of coordinates that no configuration of the robot has.
    #[error(
        "tick {}: {} of robot {:?} has {} coordinates: a {} has {}",
        .0.tick, .0.input, .0.robot, .0.coordinates, .0.kind, counts(.0.about.spaces)
    )]
    NoConfiguration(Box<UnfitInput>),
    /// A `Teleport` to a place outside the robot's world.
    #[error("tick {tick}: Teleport of robot {robot:?}: {reason}")]
    Outside {
        /// The event's tick.
        tick: u64,
        /// The robot.
        robot: String,
        /// The place and the world's bounds, in the words of [`OutsideError`](motion_lab_core::worlds::OutsideError).
        reason: String,
    },
    /// A world that the run does not have.
    #[error("there is no world {0:?}")]
    World(String),
    /// A world's name that two worlds of the run have.
    #[error("two worlds are named {0:?}: a script can't tell them apart")]
    SameWorld(String),
    /// A name that no door of the world has.
    #[error("there is no door {name:?} in world {world:?}")]
    Door {
        /// The world.
        world: String,
        /// The name.
        name: String,
    },
    /// A name that no obstacle of the world has by then.
    #[error("there is no obstacle {name:?} in world {world:?}")]
    Obstacle {
        /// The world.
        world: String,
        /// The name.
        name: String,
    },
    /// The name of a new obstacle that something in the world has, or an earlier new one.
    #[error("the name {name:?} is taken in world {world:?}")]
    Taken {
        /// The world.
        world: String,
        /// The name.
        name: String,
    },
    /// A new obstacle that the world has no room for.
    #[error("world {0:?} would have more than {MAX_ITEMS} shapes, with those that the script adds")]
    Shapes(String),
    /// A tick at which a world changes too often for its size.
    #[error(
        "the worlds change too often for their size: the shapes of a changed world, over all ticks that change it, and \
         those of what changes again within a tick are at most {MAX_CHANGED_SHAPES} in all"
    )]
    ChangedShapes,
    /// A new obstacle whose name no world file could hold.
    #[error("name {0:?}: it must be 1 to 200 bytes without control characters and without blanks at its ends")]
    Name(String),
    /// A new obstacle whose points and radius make no shape.
    #[error("no shape: {0}")]
    Shape(String),
}

/// An input that robots of a kind can never apply.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnfitInput {
    /// The event's tick.
    pub tick: u64,
    /// The robot.
    pub robot: String,
    /// The name of its kind, as its world says it.
    pub kind: String,
    /// The kind of input.
    pub input: InputKind,
    /// The number of the input's coordinates; 0 for one without any.
    pub coordinates: usize,
    /// What is known of the kind: which inputs it takes, and its spaces.
    pub about: &'static RobotKind,
}

/// The numbers of coordinates of configurations, as a sentence names them: `3 or 4`.
fn counts(spaces: &[Space]) -> String {
    spaces.iter().map(|space| space.coordinates.to_string()).collect::<Vec<_>>().join(" or ")
}

impl ScriptProblem {
    /// The problem of a script that was not read from text, outside its lists.
    pub(crate) fn anywhere(self) -> ScriptError {
        ScriptError { file: String::new(), line: 0, list: "", event: None, problem: self }
    }

    /// The problem of item number `index` of a list of such a script.
    pub(crate) fn at(self, list: &'static str, index: usize) -> ScriptError {
        ScriptError { list, event: Some(index), ..self.anywhere() }
    }
}
