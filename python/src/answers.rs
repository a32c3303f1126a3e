//! Answers to many rows: in the caller's memory or in new arrays, by calls that Ctrl+C stops.

use std::ops::Range;
use std::time::{Duration, Instant};

use numpy::prelude::*;
use numpy::{Element, PyArrayDyn, PyReadwriteArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

use motion_lab_core::collision::RowsError;

use crate::arrays::{BLOCK, ManyRows, numpy_function, shape_text};
use crate::pool;

/// How many rows a call begins with: few enough that Ctrl+C does not wait for hard ones.
const FIRST: usize = 16;
/// The library answers no more questions than these in the caller's own thread.
pub const ALONE: usize = 64;
/// A part of a call that took less than this is followed by a larger one, and by a smaller one if it took more.
const SHORT: Duration = Duration::from_millis(8);
const LONG: Duration = Duration::from_millis(40);

/// Answers, in the caller's `out` or in a new array.
pub struct Answers<'py, T: Element> {
    array: PyReadwriteArrayDyn<'py, T>,
    object: Bound<'py, PyAny>,
}

impl<'py, T: Element> Answers<'py, T> {
    /// A new array of this shape; or `out`, if it is one and shares no memory with the inputs.
    ///
    /// # Errors
    /// `ValueError` says why `out` is refused, `MemoryError` that there is not so much memory.
    pub fn new(
        py: Python<'py>,
        out: Option<&Bound<'py, PyAny>>,
        shape: &[usize],
        inputs: &[&ManyRows<'py>],
    ) -> PyResult<Self> {
        let Some(out) = out else {
            static ZEROS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
            let zeros = numpy_function(py, &ZEROS, "zeros")?;
            let array = zeros.call1((PyTuple::new(py, shape)?, numpy::dtype::<T>(py)))?;
            let own = array.cast::<PyArrayDyn<T>>()?.try_readwrite();
            let own = own.map_err(|error| PyValueError::new_err(error.to_string()))?;
            return Ok(Answers { array: own, object: array });
        };
        let wrong = |words: String| Err(PyValueError::new_err(format!("out {words}")));
        let Ok(untyped) = out.cast::<numpy::PyUntypedArray>() else {
            return wrong(format!("is no numpy array, but {}", out.get_type().name()?));
        };
        if !untyped.dtype().is_equiv_to(&numpy::dtype::<T>(py)) {
            return wrong(format!("has dtype {}, its answers are {}", untyped.dtype(), numpy::dtype::<T>(py)));
        }
        if untyped.shape() != shape {
            return wrong(format!("has shape {}, its answers have {}", shape_text(untyped.shape()), shape_text(shape)));
        }
        if !untyped.is_c_contiguous() || !untyped.is_aligned() {
            return wrong("is not C-ordered and aligned".to_owned());
        }
        if !out.getattr("flags")?.getattr("writeable")?.extract::<bool>()? {
            return wrong("is not writeable".to_owned());
        }
        for (name, input) in inputs.iter().flat_map(|input| input.memory()) {
            if shares_memory(py, out, input)? {
                return wrong(format!("shares memory with {name}"));
            }
        }
        let array = out.cast::<PyArrayDyn<T>>()?.try_readwrite();
        let array = array.map_err(|_| PyValueError::new_err("another call is using out"))?;
        Ok(Answers { array, object: out.clone() })
    }

    /// The places, in the order of the rows.
    ///
    /// # Errors
    /// `ValueError` never, once it was made.
    pub fn places(&mut self) -> PyResult<&mut [T]> {
        self.array.as_slice_mut().map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The array as Python has it.
    pub fn into_object(self) -> Bound<'py, PyAny> {
        self.object
    }
}

/// Whether an array shares memory with an input; where that is hard to tell, it does.
fn shares_memory<'py>(py: Python<'py>, out: &Bound<'py, PyAny>, input: &Bound<'py, PyAny>) -> PyResult<bool> {
    static SHARES: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    if !input.is_instance_of::<numpy::PyUntypedArray>() {
        return Ok(false);
    }
    let shares = numpy_function(py, &SHARES, "shares_memory")?.call1((out, input, 10_000));
    Ok(shares.is_err() || shares?.extract()?)
}

/// Asks about some rows after others, in the pool where they are many, with the interpreter's lock released, and looks
/// in between whether Ctrl+C was pressed. What is answered does not depend on how many rows a part has; none crosses a
/// multiple of [`BLOCK`].
///
/// # Errors
/// `ask`'s, as `ValueError`; `KeyboardInterrupt`.
pub fn each_chunk(
    py: Python<'_>,
    rows: usize,
    mut ask: impl FnMut(Range<usize>) -> Result<(), RowsError> + Send,
) -> PyResult<()> {
    if rows <= FIRST {
        return py.detach(|| ask(0..rows)).map_err(refused);
    }
    let (mut at, mut size) = (0, FIRST);
    while at < rows {
        let part = at..rows.min(at + size).min((at / BLOCK + 1) * BLOCK);
        at = part.end;
        let began = Instant::now();
        let asked = if part.len() > ALONE { pool::install(py, || ask(part))? } else { py.detach(|| ask(part)) };
        asked.map_err(refused)?;
        py.check_signals()?;
        let took = began.elapsed();
        if took < SHORT {
            size = size.saturating_mul(4);
        } else if took > LONG {
            size = 1.max(size / 4);
        }
    }
    Ok(())
}

fn refused(error: RowsError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
