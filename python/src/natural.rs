//! Whole numbers that Python gives.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyInt;

/// The number of the argument called `name`: a tick, a seed, a count.
///
/// # Errors
/// `ValueError` for one below 0 or beyond 64 bits, `TypeError` for anything else.
pub fn natural(name: &str, given: &Bound<'_, PyAny>) -> PyResult<u64> {
    given.extract().map_err(|_| {
        if given.is_instance_of::<PyInt>() {
            return PyValueError::new_err(format!("{name} {given}: it must be from 0 to {}", u64::MAX));
        }
        let class = given.get_type().name().map_or_else(|_| "an object".to_owned(), |class| class.to_string());
        PyTypeError::new_err(format!("{name}: a whole number, not {class}"))
    })
}

/// The same of an argument that may be left out.
///
/// # Errors
/// As [`natural`].
pub fn natural_or_none(name: &str, given: Option<&Bound<'_, PyAny>>) -> PyResult<Option<u64>> {
    given.filter(|given| !given.is_none()).map(|given| natural(name, given)).transpose()
}

/// A number of things in words: `1 leg`, `2 legs`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
