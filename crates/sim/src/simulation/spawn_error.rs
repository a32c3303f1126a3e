//! `SpawnError`, why a run cannot start.

use crate::run::ScriptError;
use crate::tour::ConfigError;
use motion_lab_core::configuration::SizesError;
use motion_lab_core::sensors::BeamError;

/// Why a run cannot start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpawnError {
    /// A kind of robot that is not registered.
    #[error("robot {robot:?} in world {world:?}: there is no kind {kind:?}")]
    UnknownKind {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The kind.
        kind: String,
    },
    /// Start coordinates that are no configuration of the robot.
    #[error("robot {robot:?} in world {world:?}: {start:?} is no configuration of a {kind}")]
    Start {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// Its kind.
        kind: String,
        /// The coordinates.
        start: Vec<f64>,
    },
    /// Sizes that are out of range, or that the robot does not take.
    #[error("robot {robot:?} in world {world:?}: {source}")]
    Sizes {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The reason.
        source: SizesError,
    },
    /// A route that the world does not have. World files are checked for this; a world made in code may have one.
    #[error("robot {robot:?} in world {world:?}: there is no route {route:?}")]
    NoSuchRoute {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The route.
        route: String,
    },
    /// A route that the robot cannot follow: its kind follows none, or it asks for more than nine tenths of its speed.
    #[error("robot {robot:?} in world {world:?}: a {kind} cannot follow the route {route:?} at {speed} m/s")]
    Route {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// Its kind.
        kind: String,
        /// The route.
        route: String,
        /// The route's speed, metres per second.
        speed: f64,
    },
    /// The configuration is out of range.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The script cannot be run with these robots.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A sensor whose noise parameters give no distribution. World files are checked for this; a
    /// world made in code may have one.
    #[error("robot {robot:?} in world {world:?}: sensor: {source}")]
    Noise {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The reason.
        source: BeamError,
    },
}
