//! An assignment as written in its file, and where its items stand.

use ron::error::SpannedError;
use ron::value::RawValue;
use serde::Deserialize;

use super::seeds::Seeds;
use super::{Points, Stay};
use motion_lab_core::configuration::{WrittenCoordinate, WrittenCoordinateError};
use motion_lab_core::text_position::{Position, byte_at, offset_of, position_at};
use motion_lab_core::worlds::begin_of;

/// The configuration to reach, with tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// The coordinates of its configuration: metres and radians.
    pub at: Vec<f64>,
    /// The tolerance of each coordinate, 0 or more; angles compare the short way round.
    pub within: Vec<f64>,
    /// Number of ticks in a row that the robot has to be there; 1 when left out. The older way to say [`Stay::hold`].
    pub ticks: u64,
}

/// A goal as written.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename = "Goal", deny_unknown_fields)]
pub(super) struct WrittenGoal {
    pub at: Vec<WrittenCoordinate>,
    pub within: Vec<WrittenCoordinate>,
    #[serde(default = "one")]
    pub ticks: u64,
}

impl WrittenGoal {
    /// The goal of a robot whose coordinates begin with this many lengths.
    pub fn goal(&self, lengths: usize) -> Result<Goal, WrittenCoordinateError> {
        let [at, within] = [&self.at, &self.within].map(|written| WrittenCoordinate::values(written, lengths));
        Ok(Goal { at: at?, within: within?, ticks: self.ticks })
    }
}

fn one() -> u64 {
    1
}

/// The limits of an attempt, each inclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// The last tick at which the goal may be reached.
    pub ticks: u64,
    /// Largest number of contact episodes until then; any number when left out.
    #[serde(default)]
    pub contacts: Option<u32>,
    /// Largest number of changes between forward and backward until then, for a robot that drives; any number when left
    /// out.
    #[serde(default)]
    pub reversals: Option<u32>,
}

/// The assignment, with its items.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename = "Assignment", deny_unknown_fields)]
pub(super) struct AssignmentText {
    pub version: u64,
    pub world: String,
    pub robot: String,
    #[serde(default)]
    pub start: Option<Vec<WrittenCoordinate>>,
    pub goal: WrittenGoal,
    #[serde(default)]
    pub stay: Option<Stay>,
    pub limits: Limits,
    #[serde(default)]
    pub points: Option<Points>,
    #[serde(default)]
    pub set_trailer: bool,
    pub seeds: Seeds,
}

/// The version alone, for files of other versions.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
pub(super) struct AssignmentVersion {
    pub version: u64,
}

/// The items as raw text, for their lines in the file.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
struct RawAssignment<'a> {
    #[serde(borrow, default)]
    version: Option<&'a RawValue>,
    #[serde(borrow, default)]
    world: Option<&'a RawValue>,
    #[serde(borrow, default)]
    robot: Option<&'a RawValue>,
    #[serde(borrow, default)]
    start: Option<&'a RawValue>,
    #[serde(borrow, default)]
    goal: Option<&'a RawValue>,
    #[serde(borrow, default)]
    stay: Option<&'a RawValue>,
    #[serde(borrow, default)]
    limits: Option<&'a RawValue>,
    #[serde(borrow, default)]
    points: Option<&'a RawValue>,
    #[serde(borrow, default)]
    set_trailer: Option<&'a RawValue>,
    #[serde(borrow, default)]
    seeds: Option<&'a RawValue>,
}

/// The RON options of assignments: an optional value is written plainly, as in `contacts: 0`.
pub(super) fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// The texts of the items of a file, with the blanks and comments around them; none of a text that is not RON.
pub(super) fn items(text: &str) -> impl Iterator<Item = (&'static str, &RawValue)> {
    let places: Option<RawAssignment> = options().from_str(text).ok();
    let items =
        places.map(|RawAssignment { version, world, robot, start, goal, stay, limits, points, set_trailer, seeds }| {
            [
                ("version", version),
                ("world", world),
                ("robot", robot),
                ("start", start),
                ("goal", goal),
                ("stay", stay),
                ("limits", limits),
                ("points", points),
                ("set_trailer", set_trailer),
                ("seeds", seeds),
            ]
        });
    items.into_iter().flatten().filter_map(|(item, part)| Some((item, part?)))
}

/// Where an item begins; the beginning of the text for a missing item.
pub(super) fn place_of(text: &str, item: &str) -> Position {
    let part = items(text).find(|(name, _)| *name == item);
    position_at(text, part.map_or(0, |(_, part)| offset_of(text, part.trim().get_ron())))
}

/// The item in which the reader found an error; empty where it is in none.
pub(super) fn item_of(text: &str, error: &SpannedError) -> &'static str {
    let byte = byte_at(text, begin_of(error));
    let holds = |part: &RawValue| {
        let begin = offset_of(text, part.get_ron());
        // an error in an item's first word begins at the colon before it, one of its whole may begin at its end
        (begin.saturating_sub(1)..=begin + part.get_ron().len()).contains(&byte)
    };
    let found = items(text).find(|(_, part)| holds(part)).map_or("", |(item, _)| item);
    match &error.code {
        // what is missing of the whole is noticed at its end, which may be in the last item's blanks
        ron::Error::MissingStructField { outer: Some(outer), .. } if outer == "Assignment" => "",
        _ => found,
    }
}
