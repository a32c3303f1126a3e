//! `CommandError`, why a command to the run could not be carried out.

use bevy::prelude::*;

use super::{ChangeRefused, RestoreError, SpawnError};
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
    /// An entity that no world file could hold as an obstacle.
    #[error("{name:?} is no obstacle that world {world:?} could have, and is left out")]
    NoObstacle {
        /// The world's name.
        world: String,
        /// The name of the entity's shape.
        name: String,
    },
    /// An obstacle that was changed past the script, in a run under way.
    #[error(
        "obstacle {name:?} was changed in a run under way: only the run's script changes obstacles, so this one stays"
    )]
    ObstacleInRun {
        /// The obstacle's name.
        name: String,
    },
}

/// A command that could not be carried out, as a message to whoever shows the run.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct CommandRefused(pub CommandError);
