//! `Resident`, a robot that lives in a world.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use motion_lab_core::robots::{AnyRobot, HITCH, RUSTY, Reach};
use motion_lab_core::worlds::{MAX_ITEMS, Resident, World, WorldProblem, check_name};

use crate::errors::nowhere_in_a_world;
use crate::robot::{LabRobot, PyRobot};

/// A robot that lives in a world.
#[pyclass(frozen, name = "Resident", module = "motion_lab")]
pub struct PyResident {
    resident: Resident,
}

impl From<Resident> for PyResident {
    fn from(resident: Resident) -> Self {
        PyResident { resident }
    }
}

#[pymethods]
impl PyResident {
    /// Its name, unique in its world.
    #[getter]
    fn name(&self) -> &str {
        &self.resident.name
    }

    /// Its kind, as world files have it: `'rusty'`, `'reach'`, `'reach3'`, `'hitch'`, or one of a program's own.
    #[getter]
    fn kind(&self) -> &str {
        &self.resident.kind
    }

    /// The configuration in which it starts.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, &self.resident.start)
    }

    /// The robot, of its own sizes, for a `Checker`; None for one of a kind that is not the lab's.
    #[getter]
    fn robot(&self, py: Python<'_>) -> PyResult<Option<Py<PyRobot>>> {
        let robot = AnyRobot::of_resident(&self.resident);
        robot.map(|(robot, _)| LabRobot::of_any(robot).into_object(py)).transpose()
    }

    fn __repr__(&self) -> String {
        let Resident { name, kind, start, .. } = &self.resident;
        format!("<Resident {name:?}: {kind} at {start:?}>")
    }
}

/// A resident that the world has room for.
///
/// # Errors
/// `WorldError` for a name that is taken or none, for a start or sizes that do not fit; `TypeError` for a `Disc`.
pub fn resident(py: Python<'_>, world: &World, name: &str, robot: &LabRobot, start: Vec<f64>) -> PyResult<Resident> {
    let refused = |reason: &dyn std::fmt::Display| nowhere_in_a_world(py, format!("robot {name:?}: {reason}"));
    check_name(name).map_err(|error| refused(&error))?;
    if world.has_name(name) {
        return Err(refused(&"something in the world has this name already"));
    }
    if world.robots.len() >= MAX_ITEMS {
        return Err(refused(&WorldProblem::TooMany { what: "robots" }));
    }
    let (kind, sizes) = match robot {
        LabRobot::Disc(_) => return Err(PyTypeError::new_err("a Disc has no wheels: Rusty(radius=...) is a rover")),
        LabRobot::Rusty(rover) => ("rusty", (*rover != RUSTY).then(|| rover.sizes())),
        LabRobot::Reach2(arm) => ("reach", (*arm != Reach::workbench()).then(|| arm.sizes())),
        LabRobot::Reach3(arm) => ("reach3", Some(arm.sizes())),
        LabRobot::Hitch(car) => ("hitch", (car.sizes() != HITCH.sizes()).then(|| car.sizes())),
    };
    let (coordinates, given) = (robot.coordinates(), start.len());
    if given != coordinates.len() {
        // of a car the number of coordinates would say whether it has its trailer
        let (own, names) = (coordinates.len(), coordinates.join(", "));
        return Err(refused(&format!(
            "start has {given} coordinates, a {}'s configuration has {own}: {names}",
            robot.class()
        )));
    }
    let plain = Resident::try_new(name, kind, start, None).map_err(|error| refused(&error))?;
    let own = match sizes {
        Some(sizes) => plain.try_with_sizes(sizes).map_err(|error| refused(&error))?,
        None => plain,
    };
    world.check_resident(&own).map_err(|error| refused(&error))?;
    Ok(own)
}
