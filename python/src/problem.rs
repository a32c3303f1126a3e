//! `Problem`, a planning problem by a seed.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use motion_lab_core::configuration::{AnyConfiguration, Configuration as _};
use motion_lab_core::names::{hint, nearest};
use motion_lab_core::random::Seed;
use motion_lab_sim::problems::{GeneratedProblem, ProblemGenerator};

use crate::errors::Error;
use crate::natural::natural_or_none;
use crate::robot::{LabRobot, PyRobot};
use crate::world::PyWorld;

/// A planning problem: a robot in a world, from a start to a goal. `Problem.generate` makes one.
#[pyclass(frozen, name = "Problem", module = "motion_lab")]
pub struct PyProblem {
    problem: GeneratedProblem,
    world: PyWorld,
}

#[pymethods]
impl PyProblem {
    /// Make a problem, one of `circles`, `maze`, `passage`, `parking` and `warehouse`: a function of kind, settings,
    /// `seed`, 1 if left out, and `number`, from 0, the same on every machine. The settings of each kind stand in
    /// docs/formats.md under Problems, in metres: `Problem.generate("maze", seed=1, number=4, columns=12)` is the fifth
    /// of `Generated(of: Maze(columns: 12), seed: 1)`.
    ///
    /// Start and goal have a clearance of 5 cm. Raises Error, which is a ValueError, for a kind or a setting that there
    /// is not, and where a problem of this number has no room for its robot.
    #[staticmethod]
    #[pyo3(signature = (kind, *, seed = None, number = None, **settings))]
    fn generate(
        py: Python<'_>,
        kind: &str,
        seed: Option<&Bound<'_, PyAny>>,
        number: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let seed = Seed(natural_or_none("seed", seed)?.unwrap_or(1));
        let number = natural_or_none("number", number)?.unwrap_or(0);
        let generator = generator(py, kind, settings)?;
        let made = py.detach(|| generator.problem(seed, number));
        let problem = made.map_err(|reason| Error::new_err(format!("{kind}: {reason}")))?;
        let world = PyWorld::from(problem.task.world.as_ref().clone());
        Ok(PyProblem { problem, world })
    }

    /// The world, with the robot alone in it at the start.
    #[getter]
    fn world(&self) -> PyWorld {
        self.world.clone()
    }

    /// The robot.
    #[getter]
    fn robot(&self, py: Python<'_>) -> PyResult<Py<PyRobot>> {
        LabRobot::of_any(self.problem.task.robot).into_object(py)
    }

    /// Where the path begins.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        coordinates(py, &self.problem.task.start)
    }

    /// Where it ends.
    #[getter]
    fn goal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        coordinates(py, &self.problem.task.goal)
    }

    /// Whether the robot has a path; None where the making of the problem does not tell.
    #[getter]
    fn has_path(&self) -> Option<bool> {
        self.problem.has_path
    }

    fn __repr__(&self) -> String {
        format!("<Problem {:?}: {}>", self.problem.task.world.name, self.problem.task.name)
    }
}

fn coordinates<'py>(py: Python<'py>, q: &AnyConfiguration) -> PyResult<Bound<'py, PyTuple>> {
    PyTuple::new(py, q.coordinates().iter().copied())
}

/// The generator of a kind with these settings.
fn generator(py: Python<'_>, kind: &str, settings: Option<&Bound<'_, PyDict>>) -> PyResult<ProblemGenerator> {
    let names = ProblemGenerator::NAMES;
    if !names.contains(&kind) {
        let meant = hint(nearest(kind, names));
        return Err(Error::new_err(format!("no problems are called {kind:?}; there are {}{meant}", names.join(", "))));
    }
    let text = match settings {
        None => "{}".to_owned(),
        Some(settings) => {
            // numpy's whole numbers are numbers too
            let how = PyDict::new(py);
            how.set_item("default", py.import("operator")?.getattr("index")?)?;
            py.import("json")?.call_method("dumps", (settings,), Some(&how))?.extract()?
        }
    };
    let read: Result<ProblemGenerator, _> = serde_json::from_str(&format!("{{{kind:?}: {text}}}"));
    read.map_err(|error| {
        let words = error.to_string();
        // the text is none of the caller's
        let words = words.split(" at line ").next().unwrap_or_default();
        Error::new_err(format!("{kind}: {words}"))
    })
}
