//! `Fleet`, the rovers of a warehouse in one run, from Python into arrays.

use numpy::PyArray1;
use pyo3::prelude::*;

use motion_lab_core::random::Seed;
use motion_lab_core::worlds::Warehouse;
use motion_lab_sim::tasks::{EpisodeEnd, EpisodesError, Fleet, StepOutcome};

use crate::buffers::{read, written};
use crate::episodes::{Outcomes, refused};
use crate::errors::Error;
use crate::pool;
use crate::run::PyRun;

/// The rovers of a generated warehouse, each on its way to a goal, all in one run: what `motion_lab.pettingzoo` is made
/// of. `robots`, 10 to 100,000, are eight rovers, an arm and a car of every ten; `warehouse` is the seed of what is
/// generated. It begins with the first episode of seed 0.
///
/// Raises `Error` for another number of robots.
#[pyclass(name = "Fleet", module = "motion_lab._core")]
pub struct PyFleet {
    fleet: Fleet,
}

#[pymethods]
impl PyFleet {
    #[new]
    #[pyo3(signature = (robots, warehouse, *, trailers = false))]
    fn new(py: Python<'_>, robots: usize, warehouse: u64, trailers: bool) -> PyResult<Self> {
        let settings = Warehouse { seed: Seed(warehouse), robots, trailers };
        let fleet = pool::install(py, || Fleet::new(&settings, Seed(0)).map_err(Box::new))?.map_err(refused)?;
        Ok(PyFleet { fleet })
    }

    /// The rovers' names, in their order.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.fleet.names().collect()
    }

    /// How many numbers an action has, each in [-1, 1].
    #[getter]
    fn actions(&self) -> usize {
        self.fleet.actions()
    }

    /// How many numbers an observation has.
    #[getter]
    fn observations(&self) -> usize {
        self.fleet.observations()
    }

    /// Begin the first episode of a seed, or with None the next one of the seed that it has.
    #[pyo3(signature = (seed))]
    fn begin(&mut self, py: Python<'_>, seed: Option<u64>) -> PyResult<()> {
        let fleet = &mut self.fleet;
        let begin = || match seed {
            Some(seed) => fleet.begin(Seed(seed)).map_err(Box::new),
            None => fleet.begin_next().map_err(Box::new),
        };
        pool::install(py, begin)?.map_err(refused)
    }

    /// Write what all rovers observe now into a C-ordered float32 array of (rovers, observations).
    ///
    /// Raises ValueError for another array.
    fn observe(&self, py: Python<'_>, observations: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut observations = written::<f32>("observations", observations)?;
        let (fleet, places) = (&self.fleet, observations.places()?);
        pool::install(py, || fleet.observe(places).map_err(Box::new))?.map_err(refused)
    }

    /// Act for a tick, 0.05 s; the arrays are as in `Episodes.step`, a row for each rover. What is said for rovers that
    /// have ended means nothing; they stand. Returns whether any ended.
    ///
    /// Raises ValueError for other arrays, and `Error` for an action that is not finite; nothing has changed then.
    fn step(
        &mut self,
        py: Python<'_>,
        actions: &Bound<'_, PyAny>,
        observations: &Bound<'_, PyAny>,
        rewards: &Bound<'_, PyAny>,
        terminated: &Bound<'_, PyAny>,
        truncated: &Bound<'_, PyAny>,
    ) -> PyResult<bool> {
        let actions = read::<f32>("actions", actions)?;
        let mut observations = written::<f32>("observations", observations)?;
        let mut outcomes = Outcomes::new(self.fleet.len(), rewards, terminated, truncated)?;
        let (given, places) = (actions.as_slice()?, observations.places()?);
        let fleet = &mut self.fleet;
        let stepped = pool::install(py, || fleet.step(given, places).map(|_| ()).map_err(Box::new))?;
        stepped.map_err(|error| match *error {
            // it is the name that the caller knows
            EpisodesError::NotFinite(index) => {
                let name = self.fleet.names().nth(index).unwrap_or_default();
                Error::new_err(format!("the action of {name} is not finite"))
            }
            _ => refused(error),
        })?;
        outcomes.write(self.fleet.outcomes())
    }

    /// Which rovers reached their goals in the last step.
    fn reached<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let has_reached = |outcome: &StepOutcome| outcome.end == Some(EpisodeEnd::Reached);
        PyArray1::from_iter(py, self.fleet.outcomes().iter().map(has_reached))
    }

    /// The run so far, simulated anew: it can be written, and it verifies.
    fn episode(&mut self, py: Python<'_>) -> PyResult<PyRun> {
        let fleet = &mut self.fleet;
        let log = pool::install(py, || fleet.log().map_err(Box::new))?.map_err(refused)?;
        Ok(log.into())
    }
}
