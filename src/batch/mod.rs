//! Many runs as values. Parameter sweeps: a study, its axes, the run of each row, the rows as tables, and shards of
//! them; problems as data, and planners compared by them.
//!
//! A row is a function of the study and its number alone, so that any number of jobs, shards and machines makes the
//! same bytes. A study file is RON:
//!
//! ```ron
//! Sweep(
//!     version: 1,
//!     worlds: ["apartment"],
//!     robots: ["Rusty"],
//!     ticks: 600,
//!     goal: (robot: "Rusty", at: [2.25, 6.25, 0], within: [0.5, 0.5, 3.2]),
//!     axes: [
//!         (vary: "seed", over: Range(0, 100)),
//!         (vary: "Rusty.start.x", over: Steps(2.5, 3.5, 5)),
//!         (vary: "Rusty.noise.sigma_hit", over: Values([0, 0.02, 0.1])),
//!     ],
//! )
//! ```

mod axis;
mod columns;
mod comparison;
mod csv;
mod error;
mod failure_kind;
mod gatherer;
mod parameter;
mod part;
mod planning;
mod points;
mod problem_set;
mod row;
mod shard;
mod study;
mod study_file;
mod study_text;
mod table;
#[cfg(test)]
mod tests;
mod values;

pub use columns::{CellKind, Column, MAX_ROBOT_COLUMNS};
pub use comparison::{
    AskedPath, ComparedAttempt, MixedKinds, NoProblem, PathCost, PlanCase, PlannerComparison, PlannerMedians,
};
pub use error::{MAX_RUNS, PLAN_VERSION, StudyError, SweepProblem};
pub use failure_kind::{FailureKind, RunFailure};
pub use gatherer::RowGatherer;
pub use part::{PartError, PartHead, PartReader, PartWriter, sealed_line, unsealed_line};
pub use planning::{PlannedPath, Planning, PlanningResult, RunLength};
pub use problem_set::{KnownProblem, ProblemBundle, ProblemFile, ProblemFileError, ProblemSet, SetProblem};
pub use row::{RowValue, RunRow};
pub use shard::{Shard, ShardError};
pub use study::{RunInputs, RunSetup, Study, VariedAxis};
pub use study_file::StudyFile;
pub use table::{TableError, TableFile, TableWriter, VerifiedTable};
