//! `Frame`, the state of a whole run after a tick.

use std::sync::Arc;

use pyo3::prelude::*;

use motion_lab_sim::run::Frame;

/// The state of a whole run after a tick: all that is needed to go on from it, bit for bit. `Recorder.restore` does.
/// Two frames are equal when they are in every bit.
#[pyclass(frozen, name = "Frame", module = "motion_lab")]
pub struct PyFrame {
    /// The library's frame.
    pub frame: Arc<Frame>,
}

impl From<&Frame> for PyFrame {
    fn from(frame: &Frame) -> Self {
        PyFrame { frame: Arc::new(frame.clone()) }
    }
}

#[pymethods]
impl PyFrame {
    /// The tick after which it is the state; 0 for the start.
    #[getter]
    fn tick(&self) -> u64 {
        self.frame.tick
    }

    /// The digest of its bits, 32 hexadecimal digits.
    #[getter]
    fn digest(&self) -> String {
        self.frame.digest().to_string()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<PyFrame>().is_ok_and(|other| other.get().frame.digest() == self.frame.digest())
    }

    fn __hash__(&self) -> u64 {
        self.frame.tick
    }

    fn __repr__(&self) -> String {
        format!("<Frame of tick {}: {}>", self.frame.tick, self.frame.digest())
    }
}
