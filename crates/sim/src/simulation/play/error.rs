//! `PlayError`, why a path can't be played.

use crate::run::ScriptError;
use crate::simulation::{InputRefusal, SpawnError};
use motion_lab_core::configuration::InputKind;
use motion_lab_core::robots::ConfigurationError;

/// Why a path can't be played.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlayError {
    /// The world has no robot of this name.
    #[error("no robot in {world} is called {robot:?}")]
    NoSuchRobot {
        /// The name.
        robot: String,
        /// The world's name.
        world: String,
    },
    /// The robot is of another kind than the path's.
    #[error("{robot} is a {kind}, but the path is one of a {wanted}")]
    OtherKind {
        /// The robot's name.
        robot: String,
        /// Its kind.
        kind: String,
        /// The path's kind.
        wanted: &'static str,
    },
    /// Another robot lives in the world. What it does is not known to the path.
    #[error("{other} lives in {world} too, and the path does not know what it does")]
    Company {
        /// The other robot.
        other: String,
        /// The world's name.
        world: String,
    },
    /// The robot can't be spawned.
    #[error(transparent)]
    Spawn(Box<SpawnError>),
    /// The robot can't be put where the path begins.
    #[error("the robot can't be put where the path begins: {input} is refused, {reason}")]
    Start {
        /// The input that would put it there.
        input: InputKind,
        /// Why it is refused.
        reason: InputRefusal,
    },
    /// An input along the path that the robot refuses.
    #[error("tick {tick}: {input} is refused, {reason}")]
    Refused {
        /// The tick.
        tick: u64,
        /// The kind of input.
        input: InputKind,
        /// Why it is refused.
        reason: InputRefusal,
    },
    /// A configuration that is not the robot's.
    #[error("tick {tick}: {source}")]
    Configuration {
        /// The tick.
        tick: u64,
        /// The reason.
        source: ConfigurationError,
    },
    /// A coordinate that no script can hold.
    #[error("a coordinate of {0} does not fit a script")]
    Coordinate(f64),
    /// A leg that the car can't drive: faster than it goes, or back in time.
    #[error("leg {leg} is driven at {speed} m/s, and the car goes at up to {most} m/s")]
    Speed {
        /// The number of the leg, from 0.
        leg: usize,
        /// The speed, metres per second.
        speed: f64,
        /// The car's greatest speed, metres per second.
        most: f64,
    },
    /// A car's path of straight lines in its chart, whatever the headings.
    #[error("the path consists of straight lines of the chart, which no car drives")]
    Undriven,
    /// The motion of a tick is not proven free.
    #[error("the motion of tick {tick} is not proven free")]
    NotFree {
        /// The tick.
        tick: u64,
    },
    /// The motion of a tick is free, but the simulator would hold the robot: it comes too near to an obstacle.
    #[error("in tick {tick} the robot comes so near to an obstacle that it is held")]
    Held {
        /// The tick.
        tick: u64,
    },
    /// The robot would stray from the path.
    #[error("in tick {tick} the robot strays {strayed} m from the path, and the tube is {tube} m")]
    LeavesTube {
        /// The tick.
        tick: u64,
        /// How far, metres.
        strayed: f64,
        /// The stage's tube, metres.
        tube: f64,
    },
    /// The path takes too long.
    #[error("the path takes more than {0} ticks")]
    TooLong(u64),
    /// The script itself would not be accepted.
    #[error(transparent)]
    Script(Box<ScriptError>),
}

// boxed, so that a result is not as large as the rarest of its reasons
impl From<SpawnError> for PlayError {
    fn from(error: SpawnError) -> Self {
        PlayError::Spawn(Box::new(error))
    }
}

impl From<ScriptError> for PlayError {
    fn from(error: ScriptError) -> Self {
        PlayError::Script(Box::new(error))
    }
}
