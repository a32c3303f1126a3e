//! The values of an axis, as a plan writes them and as a run gets them.

use serde::{Deserialize, Serialize};

/// The values of an axis as written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Over {
    /// The whole numbers from the first to the second, without it.
    Range(u64, u64),
    /// These numbers.
    Values(Vec<f64>),
    /// This many numbers evenly from the first to the second, both included.
    Steps(f64, f64, u64),
    /// Drawn uniformly from the first to the second, without it.
    Uniform(f64, f64),
    /// Names: built-in worlds, or files.
    Names(Vec<String>),
    /// Start configurations.
    Starts(Vec<Vec<f64>>),
}

/// The value of an axis in a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum AxisValue {
    /// A whole number.
    Whole(u64),
    /// A number, in the parameter's unit.
    Number(f64),
    /// A name.
    Name(String),
    /// The coordinates of a configuration.
    Start(Vec<f64>),
}

impl Over {
    /// The numbers that are written.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Over::Range(..) | Over::Names(_) => Vec::new(),
            Over::Values(values) => values.clone(),
            Over::Steps(from, to, _) | Over::Uniform(from, to) => vec![*from, *to],
            Over::Starts(starts) => starts.concat(),
        }
    }

    /// Their form, in words.
    pub fn in_words(&self) -> &'static str {
        match self {
            Over::Range(..) => "whole numbers",
            Over::Values(_) | Over::Steps(..) | Over::Uniform(..) => "numbers",
            Over::Names(_) => "names",
            Over::Starts(_) => "start configurations",
        }
    }

    /// The number of values; `None` for a range without steps.
    pub fn len(&self) -> Option<u64> {
        match self {
            Over::Range(from, to) => Some(to.saturating_sub(*from)),
            Over::Values(values) => Some(values.len() as u64),
            Over::Steps(_, _, count) => Some(*count),
            Over::Uniform(..) => None,
            Over::Names(names) => Some(names.len() as u64),
            Over::Starts(starts) => Some(starts.len() as u64),
        }
    }
}
