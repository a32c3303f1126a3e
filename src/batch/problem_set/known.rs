//! `KnownProblem`, what is known of a problem beside its ends.

use motion_lab_sim::plans::Task;

/// What is known of a problem of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownProblem {
    /// Its number in the file, from 1.
    pub number: u64,
    /// The name of its set.
    pub set: String,
    /// Its bucket, of a scenario's: the file sorts problems by their lengths.
    pub bucket: Option<u64>,
    /// The length that a scenario says is the shortest, metres.
    pub optimal: Option<f64>,
    /// Whether the robot, as it is, has a path; `None` where nothing tells.
    pub has_path: Option<bool>,
}

impl KnownProblem {
    /// A problem of which nothing else is known.
    pub(super) fn of(number: u64, set: &str) -> Self {
        KnownProblem { number, set: set.to_owned(), bucket: None, optimal: None, has_path: None }
    }

    /// A path's length as a share of the shortest one that the scenario says; `None` where it says none, or 0.
    pub fn of_optimal(&self, length: f64) -> Option<f64> {
        self.optimal.filter(|optimal| *optimal > 0.0).map(|optimal| length / optimal)
    }

    /// What is known of a path, in a word.
    pub fn path_in_words(&self) -> Option<&'static str> {
        self.has_path.map(|has_path| if has_path { "path" } else { "none" })
    }
}

/// A problem of a set.
#[derive(Clone, Debug)]
pub struct SetProblem {
    /// The problem, or why there is none of this number.
    pub task: Result<Task, String>,
    /// What is known of it; `None` for one that stands in no file.
    pub known: Option<KnownProblem>,
}
