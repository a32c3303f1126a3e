//! `AvoidError`, why a contact cannot be explained.

use super::EvasionSetError;
use crate::recording::RunError;

/// Why a contact cannot be explained.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AvoidError {
    /// The run cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The set of inputs is refused.
    #[error(transparent)]
    Set(#[from] EvasionSetError),
    /// The run has no such contact.
    #[error("the run has no contact of {robot:?} that begins at tick {tick}")]
    NoContact {
        /// The robot.
        robot: String,
        /// The tick.
        tick: u64,
    },
    /// The whole run with the way out is in contact all the same, which cannot happen: what others do in other worlds
    /// is nothing to the robot.
    #[error("the way out of {robot:?} from tick {tick} is none in the whole run")]
    Unconfirmed {
        /// The robot.
        robot: String,
        /// The tick.
        tick: u64,
    },
    /// The explanation was given before, or has failed.
    #[error("the explanation is over")]
    Over,
}
