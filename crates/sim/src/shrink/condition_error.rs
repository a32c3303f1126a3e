//! Why a condition is refused.

use crate::run::{DigestError, StatsColumn};
use motion_lab_core::names::hint;

/// Why a condition is refused, and where. Prints as `character 1: no column "contact"; did you mean "contacts"?`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("character {at}: {problem}")]
#[non_exhaustive]
pub struct ConditionError {
    /// The character of the text, from 1.
    pub at: usize,
    /// The reason.
    pub problem: ConditionProblem,
}

/// The reason to refuse a condition.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ConditionProblem {
    /// Nothing where a comparison should begin.
    #[error("a comparison is missing: ROBOT.COLUMN > NUMBER, or digest == DIGEST")]
    Missing,
    /// A name that no relation follows.
    #[error("a relation is missing: <, <=, ==, !=, > or >=")]
    Relation,
    /// Something behind a comparison that joins no other one.
    #[error("comparisons are joined by && or ||")]
    Join,
    /// A name that neither is `digest` nor ends with a column.
    #[error("{0:?} is no number of a run: write ROBOT.COLUMN, or digest")]
    Name(String),
    /// A quote that is not closed.
    #[error("the quote is not closed")]
    Quote,
    /// A column that there is not.
    #[error("no column {name:?}{}", columns(.meant.as_deref()))]
    Column {
        /// The name.
        name: String,
        /// The column that was meant.
        meant: Option<String>,
    },
    /// A robot that the run does not have.
    #[error("the run has no robot {name:?}{}", hint(.meant.as_deref()))]
    Robot {
        /// The name.
        name: String,
        /// The robot that was meant.
        meant: Option<String>,
    },
    /// What is no finite number.
    #[error("{0:?} is no number")]
    Number(String),
    /// What is no digest.
    #[error(transparent)]
    Digest(#[from] DigestError),
    /// Digests compared by size.
    #[error("digests are compared by == or !=")]
    DigestRelation,
}

/// The column that was meant, else all that there are.
fn columns(meant: Option<&str>) -> String {
    match meant {
        Some(_) => hint(meant),
        None => format!("; the columns are {}", StatsColumn::ALL.map(|column| column.name).join(", ")),
    }
}

impl ConditionProblem {
    /// The problem at a character of the text, from 1.
    pub(super) fn at(self, at: usize) -> ConditionError {
        ConditionError { at, problem: self }
    }
}
