//! How a command ends: an [`Outcome`] when it did its work, a [`Failure`] when it could not.

use std::fmt::Display;
use std::io;
use std::path::Path;

/// What came of a command that did its work. Each has its exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It succeeded.
    Done,
    /// Some of several inputs were wrong; each has had its message, the others their answers.
    BadInput,
    /// A replay differs from its recording.
    Differs,
    /// A submission does not do what its assignment asks for.
    NotPassed,
    /// A planner has found no path, or its path can't be played.
    NoPath,
    /// A planner has proven that there is no path.
    Unreachable,
    /// A damaged or unfinished file was used as far as it is sealed.
    Recovered,
    /// Stopped early, and resumable.
    Stopped,
}

/// Why a command could not do its work: what went wrong, where, and what to do next. Each kind has its exit code.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A fault of this program.
    #[error("{0:#}\nThis is a fault of motion-lab itself: please report it with the command and its input.")]
    Internal(anyhow::Error),
    /// An output that can't be written.
    #[error("{file}: {reason}\n{next}")]
    Output {
        /// The file, or what else was written to.
        file: String,
        /// What is wrong.
        reason: String,
        /// What to do next.
        next: String,
    },
    /// A command line that clap accepts and that still makes no sense.
    #[error("{reason}\n{next}")]
    Usage {
        /// What is wrong.
        reason: String,
        /// What to do next.
        next: String,
    },
    /// An input that is missing or wrong.
    #[error("{reason}\n{next}")]
    Input {
        /// What is wrong, and where: file, line or offset, item.
        reason: String,
        /// What to do next.
        next: String,
    },
    /// No display for the window.
    #[error("{0}")]
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only the window needs a display"))]
    NoDisplay(String),
}

impl Failure {
    /// A fault of this program.
    pub fn internal(error: impl Into<anyhow::Error>) -> Self {
        Failure::Internal(error.into())
    }

    /// A wrong input: what is wrong where, and what to do next.
    pub fn input(reason: impl Display, next: impl Display) -> Self {
        Failure::Input { reason: reason.to_string(), next: next.to_string() }
    }

    /// The same failure; a wrong input is named by this place of another file.
    #[must_use]
    pub fn named_at(self, place: &str) -> Self {
        match self {
            Failure::Input { reason, next } => Failure::Input { reason: format!("{place}: {reason}"), next },
            failure => failure,
        }
    }

    /// A wrong command line: what is wrong, and what to do next.
    pub fn usage(reason: impl Display, next: impl Display) -> Self {
        Failure::Usage { reason: reason.to_string(), next: next.to_string() }
    }

    /// An output file that can't be written. An older file of that name is as it was.
    pub fn output(file: &Path, error: &io::Error) -> Self {
        let next = match error.kind() {
            io::ErrorKind::NotFound => "Make its folder first, or name another.",
            io::ErrorKind::PermissionDenied => "Name a file in a folder you may write to.",
            io::ErrorKind::StorageFull | io::ErrorKind::FileTooLarge => {
                "Make room on the disk, or name a file on another."
            }
            _ => "Name another file.",
        };
        let folder = || file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let reason = match error.kind() {
            io::ErrorKind::NotFound => format!("there is no folder {}", folder().display()),
            io::ErrorKind::NotADirectory => format!("{} is no folder", folder().display()),
            io::ErrorKind::PermissionDenied => "you may not write there".to_owned(),
            io::ErrorKind::StorageFull => "the disk is full".to_owned(),
            io::ErrorKind::ReadOnlyFilesystem => "the disk can't be written to".to_owned(),
            _ => error.to_string(),
        };
        let older = if file.is_file() { "The older file of that name is as it was. " } else { "" };
        Failure::Output {
            file: file.display().to_string(),
            reason: format!("it can't be written: {reason}"),
            next: format!("{older}{next}"),
        }
    }
}
