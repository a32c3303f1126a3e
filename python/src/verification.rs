//! What came of verifying a run, and of comparing two.

use std::slice::from_ref;

use pyo3::prelude::*;

use motion_lab_sim::recording::{Recorder, RunError as LabRunError};
use motion_lab_sim::run::{Comparison, Divergence, Log, SetupDifference, first_divergence};

use crate::errors::RunError;
use crate::interrupt;

/// What came of simulating a run again. It is true when the whole recording is identical.
#[pyclass(frozen, name = "Verification", module = "motion_lab", get_all)]
pub struct PyVerification {
    /// The number of recorded ticks.
    recorded: u64,
    /// The number of them that are identical in every bit, from the first on.
    identical: u64,
    /// The digest of the run as it was simulated again.
    digest: String,
    /// Where the run first differs from the recording, in words; None if nowhere.
    difference: Option<String>,
}

#[pymethods]
impl PyVerification {
    fn __bool__(&self) -> bool {
        self.difference.is_none()
    }

    fn __repr__(&self) -> String {
        let PyVerification { recorded, identical, digest, difference } = self;
        let differs = difference.as_ref().map_or(String::new(), |words| format!(", difference={words:?}"));
        format!("Verification(recorded={recorded}, identical={identical}, digest='{digest}'{differs})")
    }
}

/// Simulates a log's run again, as [`verify`](motion_lab_sim::recording::verify) does, until Ctrl+C.
///
/// # Errors
/// `RunError` for a run that cannot start, `KeyboardInterrupt`.
pub fn verify(py: Python<'_>, log: &Log) -> PyResult<PyVerification> {
    let robots = log.recipe.config.robot_names().count();
    let mut begun: Option<(Recorder, Comparison<&Log>)> = None;
    let step = || -> Option<Result<Verified, LabRunError>> {
        let (run, comparison) = match &mut begun {
            Some(begun) => begun,
            None => match Recorder::of(&log.recipe) {
                Ok(run) => {
                    let run = run.without_keyframes();
                    let comparison = Comparison::begin(log, run.frame());
                    begun.insert((run, comparison))
                }
                Err(refused) => return Some(Err(refused)),
            },
        };
        if run.frame().tick < log.ticks() {
            comparison.tick(run.step());
            return None;
        }
        let difference = comparison.difference().map(ToString::to_string);
        Some(Ok(Verified { identical: comparison.identical(), digest: comparison.digest().to_string(), difference }))
    };
    let verified = interrupt::until(py, robots, step)?.map_err(|error| RunError::new_err(error.to_string()))?;
    let Verified { identical, digest, difference } = verified;
    Ok(PyVerification { recorded: log.ticks(), identical, digest, difference })
}

/// What the library calls a verification, made piece by piece.
struct Verified {
    identical: u64,
    digest: String,
    difference: Option<String>,
}

/// Where two runs differ. It is true when they do.
#[pyclass(frozen, name = "Difference", module = "motion_lab", get_all)]
pub struct PyDifference {
    /// The number of ticks that both have.
    ticks: u64,
    /// The number of these whose frames differ.
    differing: u64,
    /// The settings that differ: a tuple each of the setting, its value in this run, and in the other.
    setup: Vec<(String, String, String)>,
    /// The tick of the first value that differs; None if none does.
    tick: Option<u64>,
    /// The first value that differs, in words, with its bits: `expected` in this run, `found` in the other; None if
    /// none does.
    first: Option<String>,
}

impl PyDifference {
    /// Where these logs differ.
    pub fn of(a: &Log, b: &Log) -> Self {
        let starts = [a, b].map(|log| log.initial().map_or(&[][..], from_ref));
        let first = first_divergence(starts[0], starts[1]).or_else(|| first_divergence(a.frames(), b.frames()));
        let first = first.map(|divergence: Divergence| divergence.named(&a.recipe.config));
        let both = a.frames().iter().zip(b.frames());
        let setup = a.recipe.differences(&b.recipe).into_iter();
        PyDifference {
            ticks: std::cmp::min(a.ticks(), b.ticks()),
            differing: both.filter(|(a, b)| a.digest() != b.digest()).count() as u64,
            setup: setup.map(|SetupDifference { item, first, second }| (item, first, second)).collect(),
            tick: first.as_ref().map(|first| first.tick),
            first: first.map(|first| first.to_string()),
        }
    }
}

#[pymethods]
impl PyDifference {
    fn __bool__(&self) -> bool {
        !self.setup.is_empty() || self.first.is_some()
    }

    fn __str__(&self) -> String {
        let PyDifference { ticks, differing, setup, first, .. } = self;
        let settings = setup.iter().map(|(item, one, other)| format!("{item}: {one} here, {other} there"));
        let mut lines: Vec<String> = settings.chain(first.clone()).collect();
        lines.push(if lines.is_empty() {
            format!("{ticks} ticks, equal to the last bit")
        } else {
            format!("{differing} of {ticks} ticks differ")
        });
        lines.join("\n")
    }

    fn __repr__(&self) -> String {
        format!("<Difference: {}>", self.__str__().replace('\n', "; "))
    }
}
