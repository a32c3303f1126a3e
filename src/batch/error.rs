//! The errors of a sweep's study, with file, line, column and item.

use std::fmt;

use motion_lab_core::one_line::OneLine;

/// The version of the study format that is read.
pub const PLAN_VERSION: u64 = 1;

/// Largest number of runs of a sweep.
pub const MAX_RUNS: u64 = 10_000_000;

/// Why a study is refused, with its place.
///
/// Prints as `study.ron:5:9: axes[1] "Rusty.start.z": there is no such parameter: ...`.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyError {
    /// The file, as the caller named it.
    pub file: String,
    /// The line, from 1: where the item begins, or where reading stopped.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
    /// The item; empty when the file is not of the format's form.
    pub item: String,
    /// The reason.
    pub problem: SweepProblem,
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.item.is_empty() {
            write!(f, "{}: ", OneLine(&self.item))?;
        }
        write!(f, "{}", OneLine(&self.problem))
    }
}

impl std::error::Error for StudyError {}

/// Why a study is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SweepProblem {
    /// Not RON, or not of the expected form.
    #[error("{0}")]
    Syntax(String),
    /// A version of the format that this program does not read.
    #[error("version {0}: this program reads version {PLAN_VERSION}")]
    Version(u64),
    /// A robot that lives in none of the worlds.
    #[error("there is no robot {robot:?} in the worlds; they have {there}")]
    Robot {
        /// The robot asked for.
        robot: String,
        /// The robots that are there.
        there: String,
    },
    /// A run that cannot be as the study has it, whatever the axes.
    #[error("{0}")]
    Run(String),
    /// The goal's numbers of coordinates and tolerances are not those of its robot.
    #[error("{coordinates} coordinates and {tolerances} tolerances: the robot starts with {expected} coordinates")]
    Goal {
        /// The coordinates.
        coordinates: usize,
        /// The tolerances.
        tolerances: usize,
        /// The coordinates of the robot's start.
        expected: usize,
    },
    /// Degrees for something that is no angle.
    #[error("degrees are for angles, and this is none")]
    Degrees,
    /// A length of a goal in degrees.
    #[error(transparent)]
    Length(motion_lab_core::configuration::WrittenCoordinateError),
    /// A goal outside the world of its robot.
    #[error(transparent)]
    Outside(motion_lab_core::worlds::OutsideError),
    /// A planner in a study that gives it nothing to do, with the reason.
    #[error("{0}")]
    Planner(&'static str),
    /// An axis whose ends are too far apart for a number.
    #[error("from {0:?} to {1:?}: the ends are too far apart")]
    Span(f64, f64),
    /// A tolerance that is negative.
    #[error("tolerance {0}: it must be 0 or more")]
    Tolerance(f64),
    /// A parameter that nothing has.
    #[error("there is no such parameter: vary {0}")]
    Parameter(String),
    /// A parameter that changes nothing in any run of the study.
    #[error("it would change nothing: {0}")]
    Idle(String),
    /// A start or a goal with other coordinates than any robot of its name has.
    #[error("{end} {index}: {reason}")]
    End {
        /// `start` or `goal`.
        end: &'static str,
        /// Its number in the list, from 0.
        index: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// A study none of whose runs can be.
    #[error("{}, because: {reason}", none_of(*runs))]
    NoRun {
        /// The number of runs.
        runs: u64,
        /// The reason against the first one.
        reason: String,
    },
    /// Two axes that vary the same.
    #[error("axes[{0}] varies the same")]
    Twice(usize),
    /// Values of another form than the parameter's.
    #[error("{found} do not fit: it takes {expected}")]
    Values {
        /// The form that was found.
        found: &'static str,
        /// What the parameter takes.
        expected: &'static str,
    },
    /// A value that the parameter cannot have.
    #[error("{0} does not fit: it takes whole numbers from 0 on, without a point from 2^53 on")]
    NotWhole(f64),
    /// A number that is infinite or none at all.
    #[error("{0} is no finite number")]
    NotFinite(f64),
    /// An axis without values.
    #[error("it has no values")]
    Empty,
    /// Steps between two ends, fewer than two.
    #[error("{0} steps: there must be at least 2, the two ends")]
    Steps(u64),
    /// A range without points where every value is wanted.
    #[error("a range without steps has no list of values: use it with points: Sample(...), or write Steps")]
    Continuous,
    /// Axes of different lengths where they are gone through side by side.
    #[error("{found} values, where axes[0] has {expected}: the axes of a list are equally long")]
    Lengths {
        /// The axis's own number of values.
        found: u64,
        /// That of the first axis.
        expected: u64,
    },
    /// No run, or too many.
    #[error("{0} runs: there must be 1 to {MAX_RUNS}")]
    Runs(u64),
}

/// A study's runs that cannot be, before the reason of the first one.
fn none_of(runs: u64) -> String {
    if runs == 1 { "its one run can't be".into() } else { format!("none of its {runs} runs can be; the first one") }
}
