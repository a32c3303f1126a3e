//! `PageError`, why the lab could not do what the page asked.

use crate::web::link::{LinkError, MAX_LINK_TICK, cited};
use crate::window::for_page::SessionError;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::run::ScriptError;

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
    #[error("{} is no key", cited(.0))]
    Key(String),
    /// No role has this name.
    #[error("{} is no role", cited(.0))]
    Role(String),
    /// A tick farther than a page simulates.
    #[error("tick {0}: at most {MAX_LINK_TICK}")]
    Tick(u64),
    /// Not a number from 0 to 2^64 - 1.
    #[error("{}: not a seed", cited(.0))]
    Seed(String),
    /// No widget has this id.
    #[error("{} is no widget", cited(.0))]
    Widget(String),
    /// No lesson has this id.
    #[error("{} is no lesson: docs/web/course.md lists them", cited(.0))]
    Lesson(String),
    /// No question of Query has this name.
    #[error("{} is no tab: it is one of {}", cited(.0), Tab::ALL.map(Tab::name).join(", "))]
    Tab(String),
    /// Not a configuration of Query's robot.
    #[error("configuration: {0}")]
    Configuration(String),
    /// An input that no robot of the run takes.
    #[error(transparent)]
    Input(#[from] ScriptError),
    /// A coordinate that no script holds.
    #[error("{}: a coordinate is beyond what an input holds", cited(.0))]
    Coordinate(String),
    /// No theme has this name.
    #[error("{} is no theme", cited(.0))]
    Theme(String),
    /// No control of the canvas has this id.
    #[error("{} is no widget of the canvas", cited(.0))]
    Control(String),
    /// Not a finite number.
    #[error("{}: not a number", cited(.0))]
    Number(String),
    /// More was asked than frames were drawn.
    #[error("the lab is still busy with what was asked before: this is lost")]
    Busy,
    /// A value is missing.
    #[error("there is nothing to set it to")]
    NoValue,
}
