//! Arrays of rows, read without being misread.

use std::ops::Range;

use numpy::prelude::*;
use numpy::{PyArray1, PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyFloat, PyInt, PyList, PyTuple};

use motion_lab_core::collision::{Rows, RowsError};
use motion_lab_core::robots::Robot;

use crate::errors::configuration_error;

/// Most numbers in a row.
pub const MAX_WIDTH: usize = 4;

/// Most numbers that are checked with the interpreter's lock held: another thread does not miss it meanwhile.
const QUICK: usize = 512;

/// Most rows that are checked before Ctrl+C is heard. No part of a call crosses a multiple of this number.
pub const BLOCK: usize = 1 << 18;

/// What the rows of an argument are: `a Disc's configuration`, of `x`, `y`.
#[derive(Clone, Debug)]
pub struct RowKind {
    /// What a row is, in words.
    pub what: String,
    /// The names of its numbers.
    pub names: Vec<String>,
}

/// A row by itself.
#[derive(Clone, Copy, Debug)]
pub struct OneRow {
    numbers: [f64; MAX_WIDTH],
    width: usize,
}

/// Rows of an argument, C-ordered `float64`: the caller's own memory where it is that, else a copy.
pub struct ManyRows<'py> {
    name: &'static str,
    /// What the caller gave.
    given: Bound<'py, PyAny>,
    array: PyReadonlyArrayDyn<'py, f64>,
}

/// Rows, each of them checked.
pub struct CheckedRows<'a, R> {
    /// [`BLOCK`] rows each, the last one fewer.
    blocks: Vec<Rows<'a, R>>,
}

/// An argument: one row, or an array of them.
pub enum Given<'py> {
    /// One.
    One(OneRow),
    /// An array.
    Many(ManyRows<'py>),
}

impl OneRow {
    /// Its numbers.
    #[inline]
    pub fn numbers(&self) -> &[f64] {
        self.numbers.get(..self.width).unwrap_or_default()
    }
}

impl RowKind {
    fn refuse(&self, name: &str, found: &str) -> PyErr {
        let (n, names) = (self.names.len(), self.names.join(", "));
        PyValueError::new_err(format!("{name} has {found}, {} has {n}: {names}", self.what))
    }

    /// Reads an argument: a tuple, list or `(d,)` array as one row, anything with more axes as rows.
    ///
    /// # Errors
    /// `ValueError` for another number of coordinates, and for what is no array of numbers.
    pub fn read<'py>(&self, name: &'static str, given: &Bound<'py, PyAny>) -> PyResult<Given<'py>> {
        let width = self.names.len();
        if let Some(row) = quick_row(given, width) {
            return Ok(Given::One(row));
        }
        let many = self.read_array(name, given)?;
        if many.array.ndim() == 1 {
            let mut row = OneRow { numbers: [0.0; MAX_WIDTH], width };
            row.numbers.iter_mut().zip(many.numbers()?).for_each(|(place, number)| *place = *number);
            return Ok(Given::One(row));
        }
        Ok(Given::Many(many))
    }

    /// As [`read`](Self::read), with one row as an array of it.
    pub fn read_array<'py>(&self, name: &'static str, given: &Bound<'py, PyAny>) -> PyResult<ManyRows<'py>> {
        let array = numbers_of(name, given)?;
        match array.shape().last() {
            Some(width) if *width == self.names.len() => {}
            Some(1) => return Err(self.refuse(name, "1 coordinate")),
            Some(width) => return Err(self.refuse(name, &format!("{width} coordinates"))),
            None => return Err(self.refuse(name, "no axis")),
        }
        Ok(ManyRows { name, given: given.clone(), array: borrowed(name, &array)? })
    }
}

/// A row out of a tuple or a list of numbers, or an array of one axis, without an array of our own; `None` of anything
/// else, which is no error yet.
#[inline]
fn quick_row(given: &Bound<'_, PyAny>, width: usize) -> Option<OneRow> {
    let mut row = OneRow { numbers: [0.0; MAX_WIDTH], width };
    let places = row.numbers.get_mut(..width)?;
    let number = |item: Bound<'_, PyAny>| match item.cast_exact::<PyFloat>() {
        Ok(float) => Some(float.value()),
        // an int that no float holds is left to numpy, as is a number of any other type
        Err(_) if item.is_exact_instance_of::<PyInt>() || item.is_instance_of::<PyFloat>() => item.extract().ok(),
        Err(_) => None,
    };
    if let Ok(tuple) = given.cast_exact::<PyTuple>() {
        if tuple.len() != width {
            return None;
        }
        for (place, item) in places.iter_mut().zip(tuple.iter()) {
            *place = number(item)?;
        }
    } else if let Ok(list) = given.cast_exact::<PyList>() {
        if list.len() != width {
            return None;
        }
        for (i, place) in places.iter_mut().enumerate() {
            *place = number(list.get_item(i).ok()?)?;
        }
    } else {
        let array = given.cast::<PyArray1<f64>>().ok()?;
        if array.shape() != [width] || !array.is_aligned() {
            return None;
        }
        for (i, place) in places.iter_mut().enumerate() {
            *place = array.get_owned([i])?;
        }
    }
    Some(row)
}

/// A function of numpy, looked up once.
pub fn numpy_function<'py>(
    py: Python<'py>,
    kept: &'static PyOnceLock<Py<PyAny>>,
    name: &str,
) -> PyResult<&'py Bound<'py, PyAny>> {
    let function = kept.get_or_try_init(py, || py.import("numpy")?.getattr(name).map(Bound::unbind))?;
    Ok(function.bind(py))
}

/// The numbers of an argument as a C-ordered array of native `float64`: itself where it is one, else a copy.
///
/// # Errors
/// `ValueError` for what is no array of real numbers, and for a masked array.
pub fn numbers_of<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    if let Ok(array) = given.cast_exact::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
        && array.is_aligned()
    {
        return Ok(array.clone());
    }
    static ASARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = given.py();
    let wrong = |words: &str| PyValueError::new_err(format!("{name} {words}"));
    if given.hasattr("mask")? && given.hasattr("filled")? {
        return Err(wrong("is a masked array: say with its filled() what stands for what is masked"));
    }
    let array = numpy_function(py, &ASARRAY, "asarray")?.call1((given,)).map_err(|error| {
        let is_ours = error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyTypeError>(py);
        if is_ours { wrong(&format!("is no array of numbers: {}", error.value(py))) } else { error }
    })?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    if !["b", "i", "u", "f"].contains(&kind.as_str()) {
        return Err(wrong(&format!("is no array of real numbers: its dtype is {dtype}")));
    }
    let how = PyDict::new(py);
    how.set_item("order", "C")?;
    how.set_item("copy", !array.getattr("flags")?.getattr("aligned")?.extract::<bool>()?)?;
    how.set_item("subok", false)?;
    let copied = array.call_method("astype", (numpy::dtype::<f64>(py),), Some(&how))?;
    Ok(copied.cast_into::<PyArrayDyn<f64>>()?)
}

/// A borrow of the array, for reading.
pub fn borrowed<'py>(name: &str, array: &Bound<'py, PyArrayDyn<f64>>) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    array.try_readonly().map_err(|_| PyValueError::new_err(format!("another call is writing into {name}")))
}

impl<R: Robot> CheckedRows<'_, R> {
    /// Some of the rows, within one [`BLOCK`].
    pub fn part(&self, rows: &Range<usize>) -> Result<Rows<'_, R>, RowsError> {
        let before = rows.start / BLOCK * BLOCK;
        let block = self.blocks.get(rows.start / BLOCK);
        let part = block.map(|block| block.part(rows.start - before..rows.end - before));
        part.ok_or(RowsError::Places { answers: 0, places: rows.len() })
    }
}

impl<'py> ManyRows<'py> {
    /// The numbers, row after row.
    ///
    /// # Errors
    /// `ValueError` never, once it was read.
    pub fn numbers(&self) -> PyResult<&[f64]> {
        // a slice of an array in Fortran's order would be another one's rows
        if !self.array.is_c_contiguous() {
            return Err(PyValueError::new_err(format!("{} is not C-ordered", self.name)));
        }
        self.array.as_slice().map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// All axes but the last.
    pub fn leading(&self) -> &[usize] {
        self.array.shape().split_last().map_or(&[], |(_, leading)| leading)
    }

    /// How many numbers a row has.
    pub fn width(&self) -> usize {
        self.array.shape().last().copied().unwrap_or(0)
    }

    /// What an answer may not share memory with, and its name: what the caller gave, and what is read of it.
    pub fn memory(&self) -> [(&'static str, &Bound<'py, PyAny>); 2] {
        [(self.name, &self.given), (self.name, self.array.as_any())]
    }

    /// The rows as configurations of this robot, each of them checked.
    ///
    /// # Errors
    /// `ConfigurationError` names the first that is none.
    pub fn checked<R: Robot>(&self, py: Python<'_>, robot: &R) -> PyResult<CheckedRows<'_, R>> {
        let (numbers, width) = (self.numbers()?, self.width().max(1));
        let mut blocks = Vec::new();
        // no rows are a block too
        for first in (0..numbers.len().max(1)).step_by(BLOCK * width) {
            let block = numbers.get(first..numbers.len().min(first + BLOCK * width)).unwrap_or_default();
            let read = || Rows::new(robot, block, width);
            let rows = if block.len() <= QUICK { read() } else { py.detach(read) };
            blocks.push(rows.map_err(|error| self.refused(py, blocks.len() * BLOCK, error))?);
            py.check_signals()?;
        }
        Ok(CheckedRows { blocks })
    }

    /// Names the row that is none.
    fn refused(&self, py: Python<'_>, first: usize, error: RowsError) -> PyErr {
        let RowsError::Row { row, reason } = error else { return PyValueError::new_err(error.to_string()) };
        let index = index_of(first + row, self.leading());
        configuration_error(py, self.name, &index, &reason.to_string())
    }

    /// The same rows along leading axes that they broadcast to: a copy, unless they have these already.
    pub fn broadcast(self, py: Python<'py>, leading: &[usize]) -> PyResult<Self> {
        if self.leading() == leading {
            return Ok(self);
        }
        static BROADCAST: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let shape = PyTuple::new(py, [leading, &[self.width()]].concat())?;
        let own = self.array.as_any();
        let wide = numpy_function(py, &BROADCAST, "broadcast_to")?.call1((own, shape))?;
        let array = borrowed(self.name, &numbers_of(self.name, &wide)?)?;
        Ok(ManyRows { array, ..self })
    }
}

/// Two arguments along the leading axes that both broadcast to.
///
/// # Errors
/// `ValueError` where they do not.
pub fn along<'py>(py: Python<'py>, a: ManyRows<'py>, b: ManyRows<'py>) -> PyResult<(ManyRows<'py>, ManyRows<'py>)> {
    let mut leading = Vec::new();
    let n = a.leading().len().max(b.leading().len());
    for axis in 0..n {
        // axes are matched from the last one
        let of =
            |shape: &[usize]| (axis + shape.len()).checked_sub(n).map_or(1, |i| shape.get(i).copied().unwrap_or(1));
        leading.push(match (of(a.leading()), of(b.leading())) {
            (p, q) if p == q || q == 1 => p,
            (1, q) => q,
            _ => {
                let (p, q) = (shape_text(a.array.shape()), shape_text(b.array.shape()));
                let words = format!("{} has shape {p} and {} {q}: their leading axes do not broadcast", a.name, b.name);
                return Err(PyValueError::new_err(words));
            }
        });
    }
    Ok((a.broadcast(py, &leading)?, b.broadcast(py, &leading)?))
}

/// The index of a row in an array with these leading axes.
fn index_of(row: usize, leading: &[usize]) -> Vec<usize> {
    let mut rest = row;
    let mut index: Vec<usize> = leading
        .iter()
        .rev()
        .map(|&length| {
            let here = rest % length.max(1);
            rest /= length.max(1);
            here
        })
        .collect();
    index.reverse();
    index
}

/// A shape as Python prints it.
pub fn shape_text(shape: &[usize]) -> String {
    let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
    if lengths.len() == 1 { format!("({},)", lengths.join("")) } else { format!("({})", lengths.join(", ")) }
}
