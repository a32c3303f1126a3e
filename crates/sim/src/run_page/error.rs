//! `TemplateError` and `RunPageError`: why no page came of a run.

use super::PageValue;
use crate::recording::RunError;
use crate::run::{Difference, LogError};

/// Why bytes are no template of a page.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TemplateError {
    /// The page's part is no UTF-8.
    #[error("it is no page: byte {0} begins no character")]
    NotText(usize),
    /// A value has no place, or not where it belongs among the others.
    #[error("it is no template of a run's page: it has no place for {}", .0.name())]
    Missing(PageValue),
    /// A value has two places.
    #[error("it is no template of a run's page: it has two places for {}", .0.name())]
    Twice(PageValue),
    /// Neither the bytes of a module nor a packed one.
    #[error("it is a template without a simulator")]
    NoSimulator,
    /// A simulator that is not this program's.
    #[error("it holds another simulator ({found}), and this program's is {own}: a page of it might not verify")]
    OtherSimulator {
        /// The print of the one that it holds.
        found: String,
        /// That of the program's own.
        own: String,
    },
    /// The run of this program's own print does not start: a fault of the library.
    #[error(transparent)]
    Print(#[from] RunError),
}

/// Why a run has no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunPageError {
    /// The run cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
    /// It cannot be logged.
    #[error(transparent)]
    Log(#[from] LogError),
    /// It is not the recorded one when it is simulated again, and its page would not verify.
    #[error("the run is another when it is simulated again: {0}")]
    Differs(Box<Difference>),
}
