//! Certificates: proofs that edges are free, and their verifier.

use numpy::PyArray2;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use motion_lab_core::collision::{Certificate, Checker, EdgeVerdict, ProvenStep, verify_certificate};
use motion_lab_core::robots::{ConfigurationError, Robot};

use crate::arrays::{OneRow, numbers_of, shape_text};
use crate::checker::{PyChecker, configuration, with_checker};
use crate::errors::{Error, configuration_error};
use crate::natural::counted;

/// A proof that an edge is free: steps, each with a clearance that is proven along it.
///
/// `Checker.certificate` makes one. `Certificate(checker, a, b, steps, margin=0.0)` is one from elsewhere, whose
/// `steps` are `(n, 3)`: where each begins and ends on the edge, from 0 to 1, and the clearance it claims, metres.
/// Nothing of it is believed: `verify` checks it.
#[pyclass(frozen, name = "Certificate", module = "motion_lab")]
pub struct PyCertificate {
    checker: Py<PyChecker>,
    ends: [OneRow; 2],
    certificate: Certificate,
}

fn certified<R: Robot>(
    checker: &Checker<R>,
    ends: &[R::Configuration; 2],
    certificate: &mut Certificate,
) -> Result<EdgeVerdict, ConfigurationError> {
    checker.edge_certified(&ends[0], &ends[1], certificate)
}

/// Where the proof ends, or the words of the refusal.
fn verified<R: Robot>(
    checker: &Checker<R>,
    ends: &[R::Configuration; 2],
    certificate: &Certificate,
) -> Result<f64, String> {
    let edge = checker.robot().edge(&ends[0], &ends[1]).map_err(|reason| reason.to_string())?;
    verify_certificate(checker.scene(), &edge, certificate).map_err(|error| error.to_string())
}

impl PyCertificate {
    /// The proof of an edge, as far as it is free.
    ///
    /// # Errors
    /// `ConfigurationError` for an end that is none of the robot's.
    pub fn proven(checker: &Bound<'_, PyChecker>, a: OneRow, b: OneRow) -> PyResult<Self> {
        let py = checker.py();
        let mut certificate = Certificate::new();
        with_checker!(&checker.get().checker, c => {
            let ends = [configuration(py, c.robot(), "a", &a)?, configuration(py, c.robot(), "b", &b)?];
            let verdict = py.detach(|| certified(c, &ends, &mut certificate));
            verdict.map_err(|reason| configuration_error(py, "a", &[], &reason.to_string()))?;
        });
        Ok(PyCertificate { checker: checker.clone().unbind(), ends: [a, b], certificate })
    }
}

#[pymethods]
impl PyCertificate {
    #[new]
    #[pyo3(signature = (checker, a, b, steps, margin = 0.0))]
    fn new(
        checker: &Bound<'_, PyChecker>,
        a: &Bound<'_, PyAny>,
        b: &Bound<'_, PyAny>,
        steps: &Bound<'_, PyAny>,
        margin: f64,
    ) -> PyResult<Self> {
        if !(margin.is_finite() && margin >= 0.0) {
            return Err(PyValueError::new_err(format!("margin {margin}: it must be finite and not below 0 m")));
        }
        let array = numbers_of("steps", steps)?;
        let array = crate::arrays::borrowed("steps", &array)?;
        let shape = numpy::PyUntypedArrayMethods::shape(&*array);
        if !matches!(shape, [_, 3] | [0]) {
            let words = format!("steps has shape {}, not (n, 3): from, to, clearance", shape_text(shape));
            return Err(PyValueError::new_err(words));
        }
        let numbers = array.as_slice().map_err(|error| PyValueError::new_err(error.to_string()))?;
        let step = |row: &[f64]| match *row {
            [from, to, clearance] => Some(ProvenStep { from, to, clearance }),
            _ => None,
        };
        let steps = numbers.chunks_exact(3).filter_map(step).collect();
        let own = checker.get();
        let ends = [own.one("a", a)?, own.one("b", b)?];
        Ok(PyCertificate {
            checker: checker.clone().unbind(),
            ends,
            certificate: Certificate::from_steps(margin, steps),
        })
    }

    /// Check the proof by code that did not make it, against the distances of the scene. Returns a `Proven`: where the
    /// proof ends, 1.0 when the whole edge is proven free. It is true only then: `holds` says so too, and `up_to` is
    /// the number.
    ///
    /// Raises Error, with the first step that fails, for a proof that proves not what it claims.
    fn verify<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let until = with_checker!(&self.checker.bind(py).get().checker, c => {
            let [a, b] = &self.ends;
            let ends = [configuration(py, c.robot(), "a", a)?, configuration(py, c.robot(), "b", b)?];
            py.detach(|| verified(c, &ends, &self.certificate)).map_err(Error::new_err)
        })?;
        py.import("motion_lab._answers")?.getattr("Proven")?.call1((until,))
    }

    /// The steps, `(n, 3)`: where each begins and ends on the edge, from 0 to 1, and the clearance along it, metres.
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let steps = self.certificate.steps();
        if steps.is_empty() {
            return py.import("numpy")?.call_method1("zeros", ((0, 3),));
        }
        let rows: Vec<Vec<f64>> = steps.iter().map(|step| vec![step.from, step.to, step.clearance]).collect();
        let array = PyArray2::from_vec2(py, &rows).map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(array.into_any())
    }

    /// Where the proof ends on the edge: 1.0 for a whole edge, 0.0 without a step.
    #[getter]
    fn proven_until(&self) -> f64 {
        self.certificate.proven_until()
    }

    /// The clearance along all steps, metres; inf without a step.
    #[getter]
    fn clearance(&self) -> f64 {
        self.certificate.clearance()
    }

    /// The clearance that every step must exceed, metres.
    #[getter]
    fn margin(&self) -> f64 {
        self.certificate.margin()
    }

    fn __len__(&self) -> usize {
        self.certificate.steps().len()
    }

    /// A certificate is neither true nor false: it may prove a part of the edge, and nobody has checked it.
    ///
    /// Raises TypeError.
    fn __bool__(&self) -> PyResult<bool> {
        let words = "a certificate is neither true nor false: ask certificate.verify(), which is true for a whole edge";
        Err(PyTypeError::new_err(words))
    }

    fn __repr__(&self) -> String {
        let (n, until) = (self.certificate.steps().len(), self.certificate.proven_until());
        format!("<Certificate of {}, free until {until:?}>", counted(n, "step"))
    }

    /// What pickles hold.
    fn __getnewargs__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let [a, b] = &self.ends;
        let ends = [PyTuple::new(py, a.numbers())?, PyTuple::new(py, b.numbers())?];
        let [a, b] = ends;
        (self.checker.clone_ref(py), a, b, self.steps(py)?, self.certificate.margin()).into_pyobject(py)
    }
}
