//! The errors of an assignment file, with file, line and item.

use std::fmt;

use crate::recording::RunError;
use crate::tour::MAX_TICKS;
use motion_lab_core::one_line::OneLine;

/// Largest number of seeds in an assignment.
pub const MAX_SEEDS: usize = 10_000;

/// Why an assignment file is refused, with the line, the column and the item.
///
/// Prints as `exam.ron:5:11: goal: 2 coordinates, 3 tolerances: there must be one for each`.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignmentError {
    /// The file, as the caller named it.
    pub file: String,
    /// The line, from 1: where the item begins, or where reading stopped.
    pub line: usize,
    /// The column of that line, from 1, in characters.
    pub column: usize,
    /// The item; empty where the error is in none of them.
    pub item: &'static str,
    /// The reason.
    pub problem: Box<AssignmentProblem>,
}

impl fmt::Display for AssignmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.item.is_empty() {
            write!(f, "{}: ", self.item)?;
        }
        write!(f, "{}", OneLine(&self.problem))
    }
}

impl std::error::Error for AssignmentError {}

/// Why an assignment file is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssignmentProblem {
    /// Not RON, or not of the expected form: an unknown or missing field, a text where a number belongs.
    #[error("{0}")]
    Syntax(String),
    /// A version of the format that this program does not read.
    #[error("version {0}: this program reads version 1")]
    Version(u64),
    /// A robot that does not live in the world.
    #[error("there is no robot {robot:?} in the world; it has {there}")]
    Robot {
        /// The robot asked for.
        robot: String,
        /// The robots that are there.
        there: String,
    },
    /// Coordinates that are no configuration of the robot.
    #[error("no configuration of the robot: {0}")]
    Configuration(RunError),
    /// Coordinates that a world file may not give a robot: too few, or too far out.
    #[error("{0}")]
    Place(motion_lab_core::worlds::WorldProblem),
    /// The robot would be in contact at the start, or at the goal.
    #[error("there the robot touches {0}")]
    Touches(String),
    /// A start or a goal outside the world, or a robot that is larger than it.
    #[error(transparent)]
    Outside(#[from] motion_lab_core::worlds::OutsideError),
    /// A length in degrees.
    #[error(transparent)]
    Degrees(#[from] motion_lab_core::configuration::WrittenCoordinateError),
    /// A start that lies within the goal's tolerances.
    #[error("the robot is there at the start: whoever does nothing would pass")]
    AtStart,
    /// The numbers of coordinates and tolerances differ.
    #[error("{coordinates} coordinates, {tolerances} tolerances: there must be one for each")]
    Tolerances {
        /// The coordinates.
        coordinates: usize,
        /// The tolerances.
        tolerances: usize,
    },
    /// A tolerance that is negative or not a number.
    #[error("tolerance {0}: it must be 0 or more")]
    Tolerance(f64),
    /// A number of ticks out of range.
    #[error("{0} ticks: there must be 1 to {MAX_TICKS}")]
    Ticks(u64),
    /// A number of ticks to stay that is 0, or longer than the attempt.
    #[error("hold {hold}: it must be 1 to {ticks}, the ticks of the limits")]
    Hold {
        /// The ticks to stay.
        hold: u64,
        /// The ticks of the limits.
        ticks: u64,
    },
    /// Both the goal and `stay` say for how long.
    #[error("hold, and the goal's ticks: leave one of them out")]
    HeldTwice,
    /// Points that are negative, too many or not a number.
    #[error("{0} points: there must be 0 to 1000000 for a criterion")]
    Points(f64),
    /// No points for anything.
    #[error("no points for anything: give some for the goal")]
    NoPoints,
    /// Points for a limit that is not there.
    #[error("points for {0}, which the limits do not limit")]
    Unlimited(&'static str),
    /// A limit of reversals for a robot that has no forward direction, or of a kind that nobody described.
    #[error("only a robot that drives has a direction to reverse")]
    Reversals,
    /// Seeds in parentheses, which could stand for a list or for a range.
    #[error("in parentheses they are neither a list, as [0, 10], nor a range, as \"0..10\"")]
    SeedsInParentheses,
    /// No seed, or too many.
    #[error("{0} seeds: there must be 1 to {MAX_SEEDS}")]
    Seeds(usize),
}
