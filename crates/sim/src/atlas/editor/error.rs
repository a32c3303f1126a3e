//! `EditError`, why a change of a world is refused.

use motion_lab_core::worlds::{OutlineError, WorldError};

/// Why a change is refused. The world stays as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// Nothing has this name.
    #[error("nothing here is called {0:?}")]
    NoSuchName(String),
    /// The thing can't be changed in this way.
    #[error("{0:?} has no shape to change")]
    NoShape(String),
    /// The thing has fewer numbers.
    #[error("{0:?} has no number {1}")]
    NoNumber(String, usize),
    /// The thing is no door.
    #[error("{0:?} is no door")]
    NoDoor(String),
    /// The robot's start would be no configuration of its kind.
    #[error("{0:?} can't start there")]
    NoConfiguration(String),
    /// An invalid outline of a polygon.
    #[error("polygon: {0}")]
    Outline(#[from] OutlineError),
    /// The world would be refused as a file.
    #[error("{0}")]
    World(#[from] WorldError),
}
