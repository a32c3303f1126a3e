//! Tables of runs as numpy and pandas have them.

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyDict, PyList};

use motion_lab_sim::export::{LogCells, LogColumn};

/// Bytes of a number in a structured array.
const WORD: usize = 8;

/// A field of a structured array.
struct Field<'a> {
    name: &'a str,
    cells: &'a LogCells,
    /// Where it begins in a row, bytes.
    offset: usize,
}

/// The columns as one structured array, a row for each row of theirs. Names have no units, and texts are left out.
///
/// # Errors
/// Python's own, where it has no memory.
pub fn structured<'py>(py: Python<'py>, columns: &[LogColumn], rows: usize) -> PyResult<Bound<'py, PyAny>> {
    let (fields, width) = laid_out(columns);
    // a buffer of Python's own, which the array takes without a copy
    let buffer = PyByteArray::new_with(py, rows * width, |bytes| {
        for field in &fields {
            let places = bytes.chunks_exact_mut(width).filter_map(|row| row.get_mut(field.offset..));
            field.write(places);
        }
        Ok(())
    })?;
    let dtype = PyDict::new(py);
    dtype.set_item("names", PyList::new(py, fields.iter().map(|field| field.name))?)?;
    dtype.set_item("formats", PyList::new(py, fields.iter().map(Field::format))?)?;
    dtype.set_item("offsets", PyList::new(py, fields.iter().map(|field| field.offset))?)?;
    dtype.set_item("itemsize", width)?;
    let numpy = py.import("numpy")?;
    let dtype = numpy.call_method1("dtype", (dtype,))?;
    if rows == 0 {
        return numpy.call_method1("empty", (0, dtype));
    }
    numpy.call_method1("frombuffer", (buffer, dtype))
}

/// The fields of these columns, numbers at whole words, and the bytes of a row.
fn laid_out(columns: &[LogColumn]) -> (Vec<Field<'_>>, usize) {
    let mut fields = Vec::new();
    let mut end = 0_usize;
    for LogColumn { name, cells } in columns {
        let offset = if matches!(cells, LogCells::Flags(_)) { end } else { end.next_multiple_of(WORD) };
        end = match cells {
            LogCells::Integers(_) | LogCells::Numbers(_) => offset + WORD,
            LogCells::Flags(_) => offset + 1,
            LogCells::Names(_) => continue,
        };
        fields.push(Field { name: without_unit(name), cells, offset });
    }
    (fields, end.next_multiple_of(WORD))
}

/// A column's name without its unit.
fn without_unit(name: &str) -> &str {
    ["_m", "_rad", "_s"].into_iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name)
}

impl Field<'_> {
    fn format(&self) -> &'static str {
        match self.cells {
            LogCells::Integers(_) => "=i8",
            LogCells::Numbers(_) => "=f8",
            LogCells::Flags(_) | LogCells::Names(_) => "?",
        }
    }

    fn write<'b>(&self, places: impl Iterator<Item = &'b mut [u8]>) {
        match self.cells {
            LogCells::Integers(all) => places.zip(all).for_each(|(place, x)| put(place, &x.to_ne_bytes())),
            LogCells::Numbers(all) => places.zip(all).for_each(|(place, x)| put(place, &x.to_ne_bytes())),
            LogCells::Flags(all) => places.zip(all).for_each(|(place, x)| put(place, &[u8::from(*x)])),
            LogCells::Names(_) => {}
        }
    }
}

fn put(place: &mut [u8], bytes: &[u8]) {
    place.iter_mut().zip(bytes).for_each(|(place, byte)| *place = *byte);
}

/// The columns by their names, as arrays; texts as lists.
///
/// # Errors
/// Python's own, where it has no memory.
pub fn by_name<'py>(py: Python<'py>, columns: Vec<LogColumn>) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for LogColumn { name, cells } in columns {
        match cells {
            LogCells::Integers(all) => table.set_item(name, all.into_pyarray(py))?,
            LogCells::Numbers(all) => table.set_item(name, all.into_pyarray(py))?,
            LogCells::Flags(all) => table.set_item(name, PyArray1::from_vec(py, all))?,
            LogCells::Names(all) => table.set_item(name, all)?,
        }
    }
    Ok(table)
}
