//! Why a file of another format is refused, and where in it.

use std::fmt;

use motion_lab_core::one_line::OneLine;
use motion_lab_core::worlds::{MAX_CELLS, WorldProblem};

/// A file that cannot be read as a world: where, which item, and why.
///
/// Prints as `maze.map:3: width: 0: it must be a whole number from 1 on`.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportError {
    /// The file, as the caller named it.
    pub file: String,
    /// The line, from 1; 0 if the file has no lines or the line is unknown.
    pub line: usize,
    /// The item, a key or an element; empty if the problem concerns no single item.
    pub item: String,
    /// The reason.
    pub problem: Box<ImportProblem>,
}

impl ImportError {
    /// An error in a file whose name is not known yet.
    pub fn at(line: usize, item: impl Into<String>, problem: impl Into<ImportProblem>) -> Self {
        ImportError { file: String::new(), line, item: item.into(), problem: Box::new(problem.into()) }
    }

    /// The error with the file's name.
    pub fn of(self, file: &str) -> Self {
        ImportError { file: file.to_owned(), ..self }
    }
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if self.line > 0 {
            write!(f, "{}:", self.line)?;
        }
        if !self.item.is_empty() {
            write!(f, " {}:", OneLine(&self.item))?;
        }
        write!(f, " {}", OneLine(&self.problem))
    }
}

impl std::error::Error for ImportError {}

/// A problem of the file as a whole.
impl From<ImportProblem> for ImportError {
    fn from(problem: ImportProblem) -> Self {
        ImportError::at(0, "", problem)
    }
}

/// Why a file of another format is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportProblem {
    /// Not of the format at all.
    #[error("{0}")]
    Syntax(String),
    /// A feature of the format that this reader does not support.
    #[error("not supported: {0}")]
    Unsupported(String),
    /// Something that must be there is not.
    #[error("`{0}` is missing")]
    Missing(&'static str),
    /// A value that is not of the expected kind.
    #[error("{found}: it must be {expected}")]
    Value {
        /// The value found.
        found: String,
        /// The value expected, in words.
        expected: &'static str,
    },
    /// Fewer or more cells, rows or pixels than the head of the file declares.
    #[error("{found} {what}: the head of the file tells {expected}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The number found.
        found: u64,
        /// The number declared.
        expected: u64,
    },
    /// A map of more cells than a grid may have.
    #[error("{columns} x {rows} cells: at most {MAX_CELLS} in all")]
    TooManyCells {
        /// The columns.
        columns: u64,
        /// The rows.
        rows: u64,
    },
    /// The file holds no obstacle.
    #[error("there is no obstacle in it")]
    Nothing,
    /// What the file holds is left out: the note that says so.
    #[error("there is no obstacle in it: {0}")]
    NothingLeft(String),
    /// Something that no world can hold.
    #[error(transparent)]
    World(#[from] WorldProblem),
}

/// An error for a value that is not of the expected kind.
pub fn wrong_value(found: impl fmt::Display, expected: &'static str) -> ImportProblem {
    let found: String = found.to_string().chars().take(60).collect();
    ImportProblem::Value { found: if found.is_empty() { "nothing".into() } else { found }, expected }
}
