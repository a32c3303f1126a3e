//! `Combinations`, which combinations of its axes' values a sweep runs.

use serde::{Deserialize, Serialize};

use super::axis::CheckedAxis;
use super::error::{MAX_RUNS, SweepProblem};
use super::values::AxisValue;
use motion_lab_core::random::Seed;

/// Which combinations are run, as written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Combinations {
    /// Every combination; the last axis changes with every row.
    #[default]
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    List,
    /// This many combinations, each axis drawn by itself.
    Sample { count: u64, seed: u64 },
}

impl Combinations {
    /// The number of rows. A problem comes with the number of its axis, if it is one's.
    pub fn count(self, axes: &[CheckedAxis]) -> Result<u64, (Option<usize>, SweepProblem)> {
        if let Combinations::Sample { count, .. } = self {
            return checked(count);
        }
        let mut lengths = Vec::with_capacity(axes.len());
        for (i, axis) in axes.iter().enumerate() {
            lengths.push(axis.len().ok_or((Some(i), SweepProblem::Continuous))?);
        }
        let Some(&expected) = lengths.first() else { return Ok(1) };
        if self == Combinations::List {
            return match lengths.iter().position(|found| *found != expected) {
                Some(i) => Err((Some(i), SweepProblem::Lengths { found: lengths[i], expected })),
                None => checked(expected),
            };
        }
        checked(lengths.into_iter().fold(1, u64::saturating_mul))
    }

    /// The values of all axes in a row.
    pub fn values(self, axes: &[CheckedAxis], row: u64) -> Vec<AxisValue> {
        match self {
            Combinations::Grid => {
                let mut rest = row;
                let mut values: Vec<AxisValue> = Vec::with_capacity(axes.len());
                for axis in axes.iter().rev() {
                    let len = axis.len().unwrap_or(1);
                    values.push(axis.value(rest % len));
                    rest /= len;
                }
                values.reverse();
                values
            }
            Combinations::List => axes.iter().map(|axis| axis.value(row)).collect(),
            Combinations::Sample { seed, .. } => axes.iter().map(|axis| axis.draw(Seed(seed), row)).collect(),
        }
    }
}

fn checked(count: u64) -> Result<u64, (Option<usize>, SweepProblem)> {
    if (1..=MAX_RUNS).contains(&count) { Ok(count) } else { Err((None, SweepProblem::Runs(count))) }
}
