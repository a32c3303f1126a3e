//! The package's errors, and the library's as Python raises them.

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use motion_lab_core::worlds::WorldError as LabWorldError;

create_exception!(
    motion_lab,
    Error,
    PyValueError,
    "What the lab refuses: `WorldError`, `ConfigurationError`, `LogError` and `RunError` are kinds of it. Arguments of a \
     wrong type, shape or range raise TypeError or ValueError, as elsewhere."
);
create_exception!(
    motion_lab,
    WorldError,
    Error,
    "A world that is refused. `path`, `line` and `column` say where, and are None for one that no text was read of."
);
create_exception!(
    motion_lab,
    ConfigurationError,
    Error,
    "A configuration that is none of its robot's. `name` is the argument, and `row` its index in that array: a tuple, \
     empty for a single configuration."
);
create_exception!(motion_lab, LogError, Error, "A log that cannot be read, or that does not fit.");
create_exception!(motion_lab, RunError, Error, "A run that is refused.");
create_exception!(
    motion_lab,
    NoPath,
    PyRuntimeError,
    "A planner found no path, and says why; or start or goal can be none of a path. `effort` is what the planner did for \
     it, None where there was no problem."
);

/// A `WorldError` with the words of the library, and where in the text it is.
pub fn world_error(py: Python<'_>, error: &LabWorldError) -> PyErr {
    let raised = WorldError::new_err(error.to_string());
    with(py, raised, |value| {
        value.setattr("path", &error.file)?;
        value.setattr("line", error.line)?;
        value.setattr("column", error.column)
    })
}

/// A `WorldError` about no place in a text.
pub fn nowhere_in_a_world(py: Python<'_>, words: String) -> PyErr {
    with(py, WorldError::new_err(words), |value| {
        ["path", "line", "column"].into_iter().try_for_each(|name| value.setattr(name, py.None()))
    })
}

/// A `ConfigurationError` about one row of the argument called `name`; the row is its index in that array.
pub fn configuration_error(py: Python<'_>, name: &str, row: &[usize], reason: &str) -> PyErr {
    let index: Vec<String> = row.iter().map(usize::to_string).collect();
    let place = if index.is_empty() { name.to_owned() } else { format!("{name}[{}]", index.join(", ")) };
    // the library's sentence has the configuration for its subject
    let words = match reason.strip_prefix("the configuration ") {
        Some(rest) => format!("{place} {rest}"),
        None => format!("{place}: {reason}"),
    };
    with(py, ConfigurationError::new_err(words), |value| {
        value.setattr("name", name)?;
        value.setattr("row", PyTuple::new(py, row)?)
    })
}

/// The error with more attributes, or the one of setting them.
pub fn with(py: Python<'_>, error: PyErr, set: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<()>) -> PyErr {
    match set(error.value(py).as_any()) {
        Ok(()) => error,
        Err(other) => other,
    }
}
