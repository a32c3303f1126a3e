//! Checkers: the questions about a robot in a world.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyType};

use motion_lab_core::collision::{Checker, Collision};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::robots::{ConfigurationError, Hitch, Reach, Robot, Rusty, RustyDisc};

use crate::arrays::{Given, ManyRows, OneRow, RowKind};
use crate::batches::{both, joined, numbered, of_pairs, of_rows, sweep_hits, sweeps};
use crate::certificate::PyCertificate;
use crate::errors::configuration_error;
use crate::robot::{LabRobot, PyRobot};
use crate::verdicts;
use crate::world::PyWorld;

/// A checker of any of the lab's robots.
#[derive(Clone, Debug)]
pub enum LabChecker {
    /// Of a disc.
    Disc(Checker<RustyDisc>),
    /// Of the rover.
    Rusty(Checker<Rusty>),
    /// Of an arm of two links.
    Reach2(Checker<Reach<2>>),
    /// Of an arm of three links.
    Reach3(Checker<Reach<3>>),
    /// Of a car.
    Hitch(Checker<Hitch>),
}

/// The same expression for a checker of any robot: `with_checker!(&checker, c => c.scene().bounds())`.
macro_rules! with_checker {
    ($any:expr, $checker:ident => $body:expr) => {
        match $any {
            $crate::checker::LabChecker::Disc($checker) => $body,
            $crate::checker::LabChecker::Rusty($checker) => $body,
            $crate::checker::LabChecker::Reach2($checker) => $body,
            $crate::checker::LabChecker::Reach3($checker) => $body,
            $crate::checker::LabChecker::Hitch($checker) => $body,
        }
    };
}
pub(crate) use with_checker;

/// A robot in a world, and the questions about it.
///
/// `Checker(world, robot)` takes a `World`, or the name of a built-in one, and a robot: `Checker("apartment", Disc())`.
///
/// A configuration is a tuple, a list or an array `(d,)` of the robot's `coordinates`, in metres and radians, and its
/// answer a float, a bool or a named tuple. An array `(..., d)` holds many; its answers are arrays `(...)`. Two arrays
/// broadcast along their leading axes. Arrays of other types or orders are copied, never misread; `out` takes the
/// answers into an array of your own, C-ordered, of exactly their shape and dtype, that shares no memory with the
/// questions. Writing into an array while a call of another thread reads it is a race, as in numpy.
///
/// Touching is contact. Beyond 1e60 m, where squares of squares are no numbers, the answers are safe: contact, nothing
/// proven, and no witness. Angles are the same a full turn on. No answer depends on the number of threads.
///
/// Every question raises ValueError for an array of another shape and for what is no number, and ConfigurationError,
/// which names the row, for a configuration that is not finite.
#[pyclass(frozen, name = "Checker", module = "motion_lab")]
pub struct PyChecker {
    /// The library's checker.
    pub checker: LabChecker,
    /// The world.
    pub world: Py<PyWorld>,
    /// The robot.
    pub robot: Py<PyRobot>,
    /// What a row of an array is.
    pub row: RowKind,
}

/// The one row as a configuration of this robot.
///
/// # Errors
/// `ConfigurationError` where it is none.
#[inline]
pub fn configuration<R: Robot>(py: Python<'_>, robot: &R, name: &str, row: &OneRow) -> PyResult<R::Configuration> {
    let Some(q) = R::Configuration::from_coordinates(row.numbers()) else {
        return Err(PyValueError::new_err(format!("{name} has another number of coordinates than the robot")));
    };
    match robot.check(&q) {
        Ok(()) => Ok(q),
        Err(reason) => Err(configuration_error(py, name, &[], &reason.to_string())),
    }
}

impl PyChecker {
    /// The argument, an array even of one row where the answers have a place.
    fn given<'py>(
        &self,
        name: &'static str,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Given<'py>> {
        match out {
            None => self.row.read(name, q),
            Some(_) => Ok(Given::Many(self.row.read_array(name, q)?)),
        }
    }

    /// Both ends of edges: two rows, or two arrays.
    fn ends<'py>(
        &self,
        a: &Bound<'py, PyAny>,
        b: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Result<(OneRow, OneRow), (ManyRows<'py>, ManyRows<'py>)>> {
        Ok(match (self.given("a", a, out)?, self.given("b", b, out)?) {
            (Given::One(a), Given::One(b)) => Ok((a, b)),
            (Given::Many(a), Given::Many(b)) => Err((a, b)),
            (Given::One(_), Given::Many(b)) => Err((self.row.read_array("a", a)?, b)),
            (Given::Many(a), Given::One(_)) => Err((a, self.row.read_array("b", b)?)),
        })
    }

    /// A single configuration.
    ///
    /// # Errors
    /// `ValueError` for an array of several.
    pub fn one(&self, name: &'static str, q: &Bound<'_, PyAny>) -> PyResult<OneRow> {
        match self.row.read(name, q)? {
            Given::One(row) => Ok(row),
            Given::Many(_) => Err(PyValueError::new_err(format!("{name} is an array of more than one axis"))),
        }
    }
}

#[pymethods]
impl PyChecker {
    #[new]
    fn new(world: &Bound<'_, PyAny>, robot: &Bound<'_, PyAny>) -> PyResult<Self> {
        let world = PyWorld::of(world)?;
        let Ok(of) = robot.cast::<PyRobot>() else {
            let found = match robot.cast::<PyType>() {
                Ok(class) => format!("the class {0}: write {0}()", class.name()?),
                Err(_) => robot.get_type().name()?.to_string(),
            };
            return Err(PyTypeError::new_err(format!("a robot is a Disc, Rusty, Reach or Hitch, not {found}")));
        };
        let scene = world.get().scene();
        let lab = of.get().robot;
        let checker = match lab {
            LabRobot::Disc(robot) => LabChecker::Disc(Checker::new(scene, robot)),
            LabRobot::Rusty(robot) => LabChecker::Rusty(Checker::new(scene, robot)),
            LabRobot::Reach2(robot) => LabChecker::Reach2(Checker::new(scene, robot)),
            LabRobot::Reach3(robot) => LabChecker::Reach3(Checker::new(scene, robot)),
            LabRobot::Hitch(robot) => LabChecker::Hitch(Checker::new(scene, robot)),
        };
        Ok(PyChecker { checker, world: world.unbind(), robot: of.clone().unbind(), row: lab.row_kind() })
    }

    /// The world.
    #[getter]
    fn world(&self, py: Python<'_>) -> Py<PyWorld> {
        self.world.clone_ref(py)
    }

    /// The robot.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.robot.clone_ref(py)
    }

    /// The names of a configuration's coordinates, in their order.
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.robot.bind(py).getattr("coordinates")
    }

    /// The units of the coordinates: `'m'` for lengths, `'rad'` for angles.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.robot.bind(py).getattr("units")
    }

    /// Which coordinates are angles, by their indices.
    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.robot.bind(py).getattr("angles")
    }

    /// Whether the robot touches an obstacle at each configuration of `q`, `(..., d)`: bool, `(...)`. Its own limits do
    /// not matter; see `is_free`.
    #[pyo3(signature = (q, *, out = None))]
    fn intersects<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.given("q", q, out)? {
            Given::One(row) => with_checker!(&self.checker, c => {
                let q = configuration(py, c.robot(), "q", &row)?;
                Ok(truth(py, c.scene().intersects(&c.robot().footprint(&q))))
            }),
            Given::Many(q) => with_checker!(&self.checker, c => {
                of_rows(py, c, &q, out, |rows, places| c.intersects_into(rows, places))
            }),
        }
    }

    /// The distance from the robot to the nearest obstacle at each configuration of `q`, `(..., d)`: metres, `(...)`,
    /// exactly 0.0 on contact, inf without obstacles.
    #[pyo3(signature = (q, *, out = None))]
    fn distance<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.given("q", q, out)? {
            Given::One(row) => with_checker!(&self.checker, c => {
                let q = configuration(py, c.robot(), "q", &row)?;
                Ok(PyFloat::new(py, c.distance(&q)).into_any())
            }),
            Given::Many(q) => with_checker!(&self.checker, c => {
                of_rows(py, c, &q, out, |rows, places| c.distances_into(rows, places))
            }),
        }
    }

    /// Whether the robot touches nothing at each configuration of `q`, `(..., d)`, and is within its own limits, as
    /// that of a hitch: bool, `(...)`.
    #[pyo3(signature = (q, *, out = None))]
    fn is_free<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.given("q", q, out)? {
            Given::One(row) => with_checker!(&self.checker, c => {
                let q = configuration(py, c.robot(), "q", &row)?;
                Ok(truth(py, c.is_free(&q)))
            }),
            Given::Many(q) => with_checker!(&self.checker, c => {
                of_rows(py, c, &q, out, |rows, places| c.are_free_into(rows, places))
            }),
        }
    }

    /// The nearest points of the robot and the obstacles at each configuration of `q`, `(..., d)`: a `Witness` of
    /// `distance`, `on_robot` `(..., 2)`, `on_obstacle` `(..., 2)`, `part` and `obstacle`. Where there is no obstacle,
    /// the distance is inf and the numbers are -1. Ties go to the lowest part, then to the first obstacle.
    fn witness<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        match self.given("q", q, None)? {
            Given::One(row) => with_checker!(&self.checker, c => {
                let q = configuration(py, c.robot(), "q", &row)?;
                verdicts::witness(py, c.scene().witness(&c.robot().footprint(&q)))
            }),
            Given::Many(q) => with_checker!(&self.checker, c => {
                let rows = q.checked(py, c.robot())?;
                verdicts::witnesses(py, q.leading(), |part, places| c.witnesses_into(&rows.part(part)?, places))
            }),
        }
    }

    /// Whether a sweep from each configuration of `a` to that of `b`, both `(..., d)`, hits anything: bool, `(...)`. In
    /// a sweep the frame of each of the robot's parts moves in a straight line while the part turns the short way. For
    /// an arm that is no edge: see `edge_free`.
    ///
    /// Never False for a sweep that touches, and never True where the clearance is more than 1e-6 m all the way.
    #[pyo3(signature = (a, b, *, out = None))]
    fn swept<'py>(
        &self,
        py: Python<'py>,
        a: &Bound<'py, PyAny>,
        b: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.ends(a, b, out)? {
            Ok((a, b)) => with_checker!(&self.checker, c => {
                let (a, b) = (configuration(py, c.robot(), "a", &a)?, configuration(py, c.robot(), "b", &b)?);
                Ok(truth(py, py.detach(|| sweep_hits(c, &a, &b))))
            }),
            Err(ends) => with_checker!(&self.checker, c => sweeps(py, c, ends, out)),
        }
    }

    /// Whether each edge from `a` to `b`, both `(..., d)`, is proven free: bool, `(...)`. An edge is the straight line
    /// between two configurations, angles the short way round. True wherever `edge` says FREE, False wherever it says
    /// HIT, and several times as fast.
    #[pyo3(signature = (a, b, *, out = None))]
    fn edge_free<'py>(
        &self,
        py: Python<'py>,
        a: &Bound<'py, PyAny>,
        b: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.ends(a, b, out)? {
            Ok((a, b)) => with_checker!(&self.checker, c => {
                let (a, b) = (configuration(py, c.robot(), "a", &a)?, configuration(py, c.robot(), "b", &b)?);
                Ok(truth(py, py.detach(|| c.edge_free(&a, &b))))
            }),
            Err(ends) => with_checker!(&self.checker, c => {
                of_pairs(py, c, ends, out, |from, to, places| c.edges_free_into(from, to, places))
            }),
        }
    }

    /// What is known of each edge from `a` to `b`, both `(..., d)`: an `Edge` of `verdict` (FREE, HIT or UNRESOLVED),
    /// `clearance`, `free_until`, `contact_at`, `part`, `obstacle` and `gap`, each `(...)`.
    fn edge<'py>(&self, py: Python<'py>, a: &Bound<'py, PyAny>, b: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        match self.ends(a, b, None)? {
            Ok((a, b)) => with_checker!(&self.checker, c => {
                let (a, b) = (configuration(py, c.robot(), "a", &a)?, configuration(py, c.robot(), "b", &b)?);
                let verdict = py.detach(|| c.edge(&a, &b));
                verdicts::edge(py, verdict.map_err(|reason| configuration_error(py, "a", &[], &reason.to_string()))?)
            }),
            Err((a, b)) => with_checker!(&self.checker, c => {
                let (a, b) = joined(py, c.robot(), a, b)?;
                let (from, to) = both(py, c.robot(), &a, &b)?;
                verdicts::edges(py, a.leading(), |part| {
                    let mut found = vec![Err(ConfigurationError::NotFinite); part.len()];
                    c.edges_into(&from.part(part)?, &to.part(part)?, &mut found)?;
                    numbered(found, part.start)
                })
            }),
        }
    }

    /// The proof that the edge from `a` to `b`, single configurations, is free as far as it is: a `Certificate`.
    fn certificate(slf: &Bound<'_, Self>, a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>) -> PyResult<PyCertificate> {
        let own = slf.get();
        PyCertificate::proven(slf, own.one("a", a)?, own.one("b", b)?)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("Checker({}, {})", self.world.bind(py).repr()?, self.robot.bind(py).repr()?))
    }

    /// What pickles hold.
    fn __getnewargs__(&self, py: Python<'_>) -> (Py<PyWorld>, Py<PyRobot>) {
        (self.world.clone_ref(py), self.robot.clone_ref(py))
    }
}

fn truth(py: Python<'_>, answer: bool) -> Bound<'_, PyAny> {
    PyBool::new(py, answer).to_owned().into_any()
}
