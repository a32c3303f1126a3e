//! `LinkError`, why an address is refused.

use super::cited::{cited, requoted};
use super::limits::{LINK_VERSION_WITH_FILES, MAX_COORDINATES, MAX_LINK, MAX_LINK_WORK, MAX_NAME};
use motion_lab_core::worlds::WorldError;
use motion_lab_sim::run::ScriptError;

/// Why an address is refused, or a run does not fit in one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// The link has another version.
    #[error("v: this lab reads links of versions 1 to {LINK_VERSION_WITH_FILES}, not {}", cited(.0))]
    Version(String),
    /// A field that is no whole number, or too large.
    #[error("{field}: it must be a whole number up to {most}, not {}", cited(.text))]
    Number {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The largest number allowed.
        most: u64,
    },
    /// A field that holds none of its known words.
    #[error("{field}: it must be one of {known}, not {}", cited(.text))]
    Word {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The words allowed.
        known: String,
    },
    /// An id that no lesson has.
    #[error("lesson: no lesson has the id {}", cited(.0))]
    Lesson(String),
    /// Not the coordinates of a configuration.
    #[error("{field}: it must be up to {MAX_COORDINATES} numbers, joined by commas, not {}", cited(.text))]
    Coordinates {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
    },
    /// Not a robot of a built-in world.
    #[error("plan: it must be a built-in world and a robot of it that the lab can plan for, as apartment,Rusty, not {}", cited(.0))]
    Plan(String),
    /// An end of a plan that is no configuration of its robot.
    #[error("{field}: {count} numbers are no configuration of {}, as it is planned", cited(.robot))]
    Place {
        /// The field.
        field: &'static str,
        /// How many numbers it has.
        count: usize,
        /// The robot's name.
        robot: String,
    },
    /// A digest that is not 32 hexadecimal digits.
    #[error("digest: it must be 32 hexadecimal digits, not {}", cited(.0))]
    Digest(String),
    /// Text that is not UTF-8 once its escapes are undone.
    #[error("{0}: not valid UTF-8")]
    Text(&'static str),
    /// A script that is refused.
    #[error("script: {}", requoted(.0))]
    Script(#[from] ScriptError),
    /// Inputs that make no sense from this byte on.
    #[error("inputs: they make no sense at byte {0}")]
    Inputs(usize),
    /// A world file that is refused.
    #[error("file: {}", requoted(.0))]
    World(#[from] WorldError),
    /// A name in a link that is long enough for a sentence of the link's maker, or has marks that turn text about.
    #[error("the name {} has more than {MAX_NAME} characters, or marks of direction: it is one for a file", cited(.0))]
    Name(String),
    /// More work than whoever opens a link waits for.
    #[error(
        "the run is too much work for a link, {work} rays and pairs of robots and shapes, the limit is \
         {MAX_LINK_WORK}: it is one for a file"
    )]
    Work {
        /// The work.
        work: u64,
    },
    /// Not a range sensor.
    #[error("sensor: it must be none, or a number of rays and a range in metres, as 360,4, not {}", cited(.0))]
    Sensor(String),
    /// Too long for an address.
    #[error("the link would have {0} characters; the limit is {MAX_LINK}: save the run as a file instead")]
    TooLong(usize),
}
