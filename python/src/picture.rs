//! Pictures: SVG, for notebooks and files.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use motion_lab_core::picture::Theme;

use crate::file::replace;

/// A figure as SVG. A notebook shows it; `save` writes it to a file. The same figure has the same bytes everywhere.
#[pyclass(frozen, name = "Picture", module = "motion_lab")]
pub struct PyPicture {
    svg: String,
}

impl PyPicture {
    /// The picture of this SVG.
    pub fn of(svg: String) -> Self {
        PyPicture { svg }
    }

    /// An image for a page, which every notebook shows.
    ///
    /// # Errors
    /// Python's own, where it has no memory.
    pub fn html(&self, py: Python<'_>) -> PyResult<String> {
        let bytes = PyBytes::new(py, self.svg.as_bytes());
        let coded: Vec<u8> = py.import("base64")?.call_method1("b64encode", (bytes,))?.extract()?;
        Ok(format!("<img src=\"data:image/svg+xml;base64,{}\">", String::from_utf8_lossy(&coded)))
    }
}

#[pymethods]
impl PyPicture {
    /// The text of the SVG file.
    #[getter]
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// Write it to this file, whose name ends with `.svg`. An older file is replaced.
    ///
    /// Raises ValueError for another ending, and OSError where the file cannot be written.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("svg")) {
            let words = format!("{}: a picture is an SVG file, whose name ends with .svg", path.display());
            return Err(PyValueError::new_err(words));
        }
        replace(py, &path, self.svg.as_bytes())
    }

    fn _repr_svg_(&self) -> &str {
        &self.svg
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        self.html(py)
    }

    fn __repr__(&self) -> String {
        format!("<Picture: SVG of {} bytes>", self.svg.len())
    }
}

/// The theme of this name.
///
/// # Errors
/// `ValueError` for another name than `light` and `dark`.
pub fn theme(name: &str) -> PyResult<Theme> {
    match name {
        "light" => Ok(Theme::Light),
        "dark" => Ok(Theme::Dark),
        _ => Err(PyValueError::new_err(format!("theme {name:?}: it is \"light\" or \"dark\""))),
    }
}
