//! Arrays that are read and written where they are.

use numpy::prelude::*;
use numpy::{Element, PyArrayDyn, PyReadonlyArrayDyn, PyReadwriteArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// An array that is written into.
pub struct Places<'py, T: Element>(PyReadwriteArrayDyn<'py, T>);

impl<T: Element> Places<'_, T> {
    /// Its places, in C order.
    pub fn places(&mut self) -> PyResult<&mut [T]> {
        Ok(self.0.as_slice_mut()?)
    }

    /// The same, if it has this many places.
    ///
    /// # Errors
    /// `ValueError` that names it.
    pub fn of(self, name: &str, count: usize) -> PyResult<Self> {
        let found = self.0.len();
        if found == count {
            return Ok(self);
        }
        Err(PyValueError::new_err(format!("{name} has {found} places for {count} episodes")))
    }
}

/// An array to be read.
///
/// # Errors
/// `ValueError` that names it, unless it is a C-ordered array of this type that nobody writes now.
pub fn read<'py, T: Element>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let array = c_ordered::<T>(name, given)?;
    array.try_readonly().map_err(|_| PyValueError::new_err(format!("{name} shares memory with an array written into")))
}

/// An array to be written into.
///
/// # Errors
/// `ValueError` that names it, unless it is a C-ordered, writeable array of this type that shares memory with no other.
pub fn written<'py, T: Element>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Places<'py, T>> {
    let array = c_ordered::<T>(name, given)?;
    let words = || format!("{name} is not writeable, or shares memory with another array");
    Ok(Places(array.try_readwrite().map_err(|_| PyValueError::new_err(words()))?))
}

fn c_ordered<'a, 'py, T: Element>(name: &str, given: &'a Bound<'py, PyAny>) -> PyResult<&'a Bound<'py, PyArrayDyn<T>>> {
    let array = given.cast::<PyArrayDyn<T>>().ok().filter(|array| array.is_c_contiguous() && array.is_aligned());
    array.ok_or_else(|| {
        let dtype = T::get_dtype(given.py());
        PyValueError::new_err(format!("{name} is no C-ordered array of {dtype}"))
    })
}
