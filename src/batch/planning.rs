//! `Planning`, the path that a run is to follow, and `PlanningResult`, what came of it.
//!
//! The planners are those of `motion-lab plan`, by their names; the program resolves them, as it does files.

use super::row::RowValue;

/// What is planned for a run. The robot is the only one of the run; it goes from its start.
#[derive(Clone, Debug, PartialEq)]
pub struct Planning {
    /// The planner's name; the usual one of the robot for `None`.
    pub planner: Option<String>,
    /// The configuration to go to.
    pub goal: Vec<f64>,
    /// The greatest number of iterations; the planner's usual one for `None`.
    pub iterations: Option<u64>,
    /// How much larger a rover is planned, metres, so that it may stray from the path by as much.
    pub tube: f64,
    /// The clearance that the path is to keep, metres; what the planner usually keeps for `None`.
    pub clearance: Option<f64>,
}

/// How long a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunLength {
    /// This many ticks.
    Ticks(u64),
    /// As many as the script that plays the planner's path.
    Planned,
    /// There is a path alone, and no run that plays it.
    Unsimulated,
}

impl RunLength {
    /// The number of ticks that is said; `None` where a path says it, or nothing is run.
    pub fn ticks(self) -> Option<u64> {
        match self {
            RunLength::Ticks(ticks) => Some(ticks),
            RunLength::Planned | RunLength::Unsimulated => None,
        }
    }
}

/// What came of planning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanningResult {
    /// The iterations done.
    pub iterations: u64,
    /// The edges asked about.
    pub edges: u64,
    /// The path, if there is one.
    pub path: Option<PlannedPath>,
}

/// A path that a planner has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedPath {
    /// Its length: metres, or an arm's in the chart, radians.
    pub length: f64,
    /// The clearance proven along it, metres; infinity in an empty world.
    pub clearance: f64,
    /// When the robot stands at its end, seconds; `None` where it can't be played, or is not.
    pub time: Option<f64>,
}

impl PlanningResult {
    /// The cells of a row, in the order of the columns.
    pub(super) fn cells(&self) -> [RowValue; 6] {
        let PlanningResult { iterations, edges, path } = *self;
        let whole = [u64::from(path.is_some()), iterations, edges].map(RowValue::Whole);
        let numbers =
            [path.map(|p| p.length), path.map(|p| p.clearance), path.and_then(|p| p.time)].map(RowValue::finite);
        let ([solved, iterations, edges], [length, clearance, time]) = (whole, numbers);
        [solved, iterations, edges, length, clearance, time]
    }
}
