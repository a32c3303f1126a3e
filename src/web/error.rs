//! `PageError`, why the lab could not do what the page asked.

use super::link::{LinkError, MAX_LINK_TICK};
use crate::app::SessionError;
use crate::run::ScriptError;

/// Why the lab could not do what the page asked. The lab goes on as it was.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// The session refused.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// What is shown has no link.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// egui knows no key of this name.
    #[error("{0} is no key")]
    Key(String),
    /// No role has this name.
    #[error("{0} is no role")]
    Role(String),
    /// A tick farther than a page simulates.
    #[error("tick {0}: at most {MAX_LINK_TICK}")]
    Tick(u64),
    /// Not a number from 0 to 2^64 - 1.
    #[error("{0}: not a seed")]
    Seed(String),
    /// No widget has this id.
    #[error("{0} is no widget")]
    Widget(String),
    /// No lesson has this id.
    #[error("{0} is no lesson: docs/web/course.md lists them")]
    Lesson(String),
    /// No question of Query has this name.
    #[error("{0} is no tab: it is one of intersects, distance, witness and swept")]
    Tab(String),
    /// Not a configuration of Query's robot.
    #[error("configuration: {0}")]
    Configuration(String),
    /// An input that no robot of the run takes.
    #[error(transparent)]
    Input(#[from] ScriptError),
    /// A coordinate that no script holds.
    #[error("{0}: a coordinate is beyond what an input holds")]
    Coordinate(String),
    /// No theme has this name.
    #[error("{0} is no theme")]
    Theme(String),
    /// No control of the canvas has this id.
    #[error("{0} is no widget of the canvas")]
    Control(String),
    /// Not a finite number.
    #[error("{0}: not a number")]
    Number(String),
    /// More was asked than frames were drawn.
    #[error("the lab is still busy with what was asked before: this is lost")]
    Busy,
    /// A value is missing.
    #[error("there is nothing to set it to")]
    NoValue,
}
