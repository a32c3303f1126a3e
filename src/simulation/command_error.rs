//! `CommandError`, why a command to the run could not be carried out.

use bevy::prelude::*;

use super::{RestoreError, SpawnError};

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
}

/// A command that could not be carried out, as a message to whoever shows the run.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct CommandRefused(pub CommandError);
