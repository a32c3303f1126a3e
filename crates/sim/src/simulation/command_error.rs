//! `CommandError`, why a command to the run could not be carried out.

use bevy::prelude::*;

use super::{ChangeRefused, ForeignChange, RestoreError, RobotRefusal, SpawnError};
use crate::run::ScriptError;

/// Why a command could not be carried out. The run under way stays.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CommandError {
    /// A kept frame does not fit the run.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// The new run cannot start.
    #[error(transparent)]
    Spawn(#[from] SpawnError),
    /// A change that no script of this run could hold.
    #[error("{}", .0.problem)]
    Script(#[from] ScriptError),
    /// A change of a world that a robot is in the way of.
    #[error(transparent)]
    Change(ChangeRefused),
    /// An entity that is not taken as the robot that it says it is.
    #[error("robot {name:?} (entity {entity}) {}: {reason}", if *.stays { "stays as it was" } else { "is left out" })]
    NoRobot {
        /// The entity.
        entity: Entity,
        /// The name that it gives itself.
        name: String,
        /// The reason.
        reason: Box<RobotRefusal>,
        /// Whether it stays in the run as it was. Otherwise it is no robot of the run.
        stays: bool,
    },
    /// An entity that no world file could hold as an obstacle.
    #[error("{name:?} is no obstacle that world {world:?} could have, and is left out")]
    NoObstacle {
        /// The world's name.
        world: String,
        /// The name of the entity's shape.
        name: String,
    },
    /// A change of the run's entities past its commands, in a run under way. It was put back.
    #[error("{0}")]
    Foreign(ForeignChange),
}

/// A command that could not be carried out, as a message to whoever shows the run.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct CommandRefused(pub CommandError);
