//! `EpisodesError`, why episodes cannot begin or go on.

use crate::recording::RunError;
use crate::simulation::{CommandError, SpawnError};
use motion_lab_core::worlds::WarehouseError;

/// Why episodes cannot begin or go on. What the caller gave is checked before anything changes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EpisodesError {
    /// The task's run cannot start.
    #[error(transparent)]
    Spawn(#[from] SpawnError),
    /// An episode's run cannot be recorded.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The warehouse cannot be generated.
    #[error(transparent)]
    Warehouse(#[from] WarehouseError),
    /// The run takes no more inputs.
    #[error(transparent)]
    Command(#[from] Box<CommandError>),
    /// Numbers that are not as many as there are places for.
    #[error("{numbers} {what}, but {right} are needed: {each} for each of {episodes} episodes")]
    Count {
        /// What they are.
        what: &'static str,
        /// How many were given.
        numbers: usize,
        /// How many are needed.
        right: usize,
        /// How many belong to an episode.
        each: usize,
        /// The number of episodes.
        episodes: usize,
    },
    /// An action that is not finite.
    #[error("the action of episode {0} is not finite")]
    NotFinite(usize),
    /// An episode that has ended, and was to go on.
    #[error("episode {0} has ended; begin it anew first")]
    Ended(usize),
    /// No such episode.
    #[error("there is no episode {index}; there are {count}")]
    NoEpisode {
        /// The number asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
}
