//! `FailureKind`, what sort of failure a run had, by which failures are counted.

use super::row::RowValue;
use motion_lab_core::planning::NoPath;

/// What sort of failure a run had. The column `failure` says it in words, with names and numbers; these are few.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum FailureKind {
    /// There is no such run: a start outside the world, sizes that can't be, a script that it does not take.
    Setup,
    /// The start or the goal of the path is in contact, outside, or none of the robot's.
    NoProblem,
    /// The planner's bound was reached first.
    Exhausted,
    /// The planner's own graph, of a finite number of configurations, has no path.
    NoneInGraph,
    /// Cells decide nothing.
    Undecided,
    /// It is proven that there is no path.
    Unreachable,
    /// The planner went all the way round an obstacle, and the goal lies behind it.
    Enclosed,
    /// The planner gave up.
    GaveUp,
    /// The planner is stuck in a local minimum.
    LocalMinimum,
    /// The planner does not work for this robot.
    Unsuited,
    /// The planner's path does not stand its check.
    PathRefused,
    /// There is no path, for another reason.
    NoPath,
    /// The path can't be played.
    Unplayable,
    /// The run refused inputs of its script.
    InputsRefused,
    /// The run ended without having been at the goal.
    GoalNotReached,
    /// The goal's robot is not in the run.
    NoGoalRobot,
}

impl FailureKind {
    /// The kind of a planner that has no path.
    pub fn of(reason: &NoPath) -> Self {
        match reason {
            NoPath::Problem(_) => FailureKind::NoProblem,
            NoPath::Exhausted { .. } => FailureKind::Exhausted,
            NoPath::NoneInGraph { .. } => FailureKind::NoneInGraph,
            NoPath::Undecided { .. } | NoPath::JoinedByCells { .. } => FailureKind::Undecided,
            NoPath::Unreachable { .. } => FailureKind::Unreachable,
            NoPath::Enclosed { .. } => FailureKind::Enclosed,
            NoPath::GaveUp(_) => FailureKind::GaveUp,
            NoPath::LocalMinimum { .. } => FailureKind::LocalMinimum,
            NoPath::Unsuited(_) => FailureKind::Unsuited,
            NoPath::Refused(_) => FailureKind::PathRefused,
            _ => FailureKind::NoPath,
        }
    }

    /// Its name in the column `failure_kind`.
    pub fn name(self) -> &'static str {
        match self {
            FailureKind::Setup => "setup",
            FailureKind::NoProblem => "no-problem",
            FailureKind::Exhausted => "exhausted",
            FailureKind::NoneInGraph => "none-in-graph",
            FailureKind::Undecided => "undecided",
            FailureKind::Unreachable => "unreachable",
            FailureKind::Enclosed => "enclosed",
            FailureKind::GaveUp => "gave-up",
            FailureKind::LocalMinimum => "local-minimum",
            FailureKind::Unsuited => "unsuited",
            FailureKind::PathRefused => "path-refused",
            FailureKind::NoPath => "no-path",
            FailureKind::Unplayable => "unplayable",
            FailureKind::InputsRefused => "inputs-refused",
            FailureKind::GoalNotReached => "goal-not-reached",
            FailureKind::NoGoalRobot => "no-goal-robot",
        }
    }
}

/// A failure: its kind, and the reason in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunFailure {
    /// What sort of failure it is.
    pub kind: FailureKind,
    /// Why, with names and numbers.
    pub reason: String,
}

impl RunFailure {
    /// A failure of a kind for a reason.
    pub fn new(kind: FailureKind, reason: impl Into<String>) -> Self {
        RunFailure { kind, reason: reason.into() }
    }

    /// The cells of a row, in the order of the columns; empty ones without a reason.
    pub(in crate::batch) fn cells(&self) -> [RowValue; 2] {
        let reason = RowValue::text(self.reason.as_str());
        let kind = if reason == RowValue::Empty { RowValue::Empty } else { RowValue::text(self.kind.name()) };
        [reason, kind]
    }
}

impl From<NoPath> for RunFailure {
    fn from(reason: NoPath) -> Self {
        RunFailure::new(FailureKind::of(&reason), reason.to_string())
    }
}
