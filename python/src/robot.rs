//! Robots: what a checker asks about.

use std::hash::{DefaultHasher, Hash, Hasher};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use motion_lab_core::configuration::{ArmSizes, CarSizes, Configuration, DiscSizes, HitchCfg, R2, Sizes, Tn};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::robots::{AnyRobot, HITCH, Hitch, RUSTY, Reach, Rusty, RustyDisc};

use crate::arrays::RowKind;
use crate::errors::Error;

/// A robot of the lab, each of its own type: the library's closed forms depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LabRobot {
    /// A disc, whose configuration is its centre.
    Disc(RustyDisc),
    /// The rover, a disc with a heading.
    Rusty(Rusty),
    /// An arm of two links.
    Reach2(Reach<2>),
    /// An arm of three links.
    Reach3(Reach<3>),
    /// A car, with a trailer or without.
    Hitch(Hitch),
}

impl LabRobot {
    /// The robot's name in Python.
    pub fn class(&self) -> &'static str {
        match self {
            LabRobot::Disc(_) => "Disc",
            LabRobot::Rusty(_) => "Rusty",
            LabRobot::Reach2(_) | LabRobot::Reach3(_) => "Reach",
            LabRobot::Hitch(_) => "Hitch",
        }
    }

    /// The names of its configurations' coordinates.
    pub fn coordinates(&self) -> Vec<String> {
        match self {
            LabRobot::Disc(_) => R2::new(0.0, 0.0).coordinate_names(),
            LabRobot::Rusty(_) => Pose2::IDENTITY.coordinate_names(),
            LabRobot::Reach2(_) => Tn([0.0; 2]).coordinate_names(),
            LabRobot::Reach3(_) => Tn([0.0; 3]).coordinate_names(),
            LabRobot::Hitch(car) => {
                HitchCfg { body: Pose2::IDENTITY, trailer: car.hitch_len.map(|_| 0.0) }.coordinate_names()
            }
        }
    }

    /// How many of its first coordinates are lengths; the others are angles.
    pub fn lengths(&self) -> usize {
        match self {
            LabRobot::Disc(_) | LabRobot::Rusty(_) | LabRobot::Hitch(_) => 2,
            LabRobot::Reach2(_) | LabRobot::Reach3(_) => 0,
        }
    }

    /// What a row of numbers is for this robot.
    pub fn row_kind(&self) -> RowKind {
        RowKind { what: format!("a {}'s configuration", self.class()), names: self.coordinates() }
    }

    /// The robot of a resident's kind and sizes.
    pub fn of_any(robot: AnyRobot) -> Self {
        match robot {
            AnyRobot::Rusty(rover) => LabRobot::Rusty(rover),
            AnyRobot::Reach(arm) => LabRobot::Reach2(arm),
            AnyRobot::Reach3(arm) => LabRobot::Reach3(arm),
            AnyRobot::Hitch(car) => LabRobot::Hitch(car),
        }
    }

    /// The robot as an object of its class.
    ///
    /// # Errors
    /// Python's own, where it has no memory.
    pub fn into_object(self, py: Python<'_>) -> PyResult<Py<PyRobot>> {
        let base = PyClassInitializer::from(PyRobot { robot: self });
        Ok(match self {
            LabRobot::Disc(_) => Bound::new(py, base.add_subclass(PyDisc))?.into_super().unbind(),
            LabRobot::Rusty(_) => Bound::new(py, base.add_subclass(PyRusty))?.into_super().unbind(),
            LabRobot::Reach2(_) | LabRobot::Reach3(_) => {
                Bound::new(py, base.add_subclass(PyReach))?.into_super().unbind()
            }
            LabRobot::Hitch(_) => Bound::new(py, base.add_subclass(PyHitch))?.into_super().unbind(),
        })
    }

    /// The lab's own robot of this class.
    fn own(&self) -> Self {
        match self {
            LabRobot::Disc(_) => LabRobot::Disc(RustyDisc::default()),
            LabRobot::Rusty(_) => LabRobot::Rusty(RUSTY),
            LabRobot::Reach2(_) | LabRobot::Reach3(_) => LabRobot::Reach2(Reach::workbench()),
            LabRobot::Hitch(_) => LabRobot::Hitch(HITCH),
        }
    }

    /// The arguments of its class that make it.
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let of = PyDict::new(py);
        match self {
            LabRobot::Disc(disc) => of.set_item("radius", disc.radius)?,
            LabRobot::Rusty(rover) => {
                of.set_item("radius", rover.body_radius)?;
                of.set_item("track", rover.track)?;
                of.set_item("wheel_radius", rover.wheel_radius)?;
            }
            LabRobot::Reach2(arm) => keep_arm(&of, arm)?,
            LabRobot::Reach3(arm) => keep_arm(&of, arm)?,
            LabRobot::Hitch(car) => keep_car(&of, car)?,
        }
        Ok(of)
    }
}

/// A robot of the lab: a `Disc`, `Rusty`, `Reach` or `Hitch`. Two are equal when all their sizes are.
#[pyclass(frozen, subclass, name = "Robot", module = "motion_lab")]
pub struct PyRobot {
    /// The library's robot.
    pub robot: LabRobot,
}

#[pymethods]
impl PyRobot {
    /// The names of a configuration's coordinates, in their order: `('x', 'y', 'theta')`.
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.robot.coordinates())
    }

    /// The units of the coordinates: `'m'` for lengths, `'rad'` for angles.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let lengths = self.robot.lengths();
        let units = (0..self.robot.coordinates().len()).map(|i| if i < lengths { "m" } else { "rad" });
        PyTuple::new(py, units.collect::<Vec<_>>())
    }

    /// Which coordinates are angles, by their indices. Angles are the same a full turn on, and edges turn the short
    /// way.
    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, (self.robot.lengths()..self.robot.coordinates().len()).collect::<Vec<_>>())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let own = self.robot.own().arguments(py)?;
        let mut written = Vec::new();
        for (name, value) in self.robot.arguments(py)? {
            let is_own = own.get_item(&name)?.is_some_and(|own| own.eq(&value).unwrap_or(false));
            if !is_own {
                written.push(format!("{name}={}", value.repr()?));
            }
        }
        Ok(format!("{}({})", self.robot.class(), written.join(", ")))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<PyRobot>().is_ok_and(|other| other.get().robot == self.robot)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        format!("{:?}", self.robot).hash(&mut hasher);
        hasher.finish()
    }

    /// What pickles hold: the arguments of its class.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        Ok((PyTuple::empty(py), self.robot.arguments(py)?))
    }
}

fn keep_arm<const N: usize>(of: &Bound<'_, PyDict>, arm: &Reach<N>) -> PyResult<()> {
    of.set_item("lengths", PyTuple::new(of.py(), arm.lengths)?)?;
    of.set_item("base", (arm.base.x, arm.base.y))?;
    of.set_item("radius", arm.link_radius)
}

fn keep_car(of: &Bound<'_, PyDict>, car: &Hitch) -> PyResult<()> {
    of.set_item("trailer", car.hitch_len.is_some())?;
    let Sizes::Car(sizes) = car.sizes() else { return Ok(()) };
    of.set_item("wheelbase", sizes.wheelbase)?;
    of.set_item("length", sizes.length)?;
    of.set_item("width", sizes.width)?;
    of.set_item("rear_overhang", sizes.rear_overhang)?;
    of.set_item("max_steer", sizes.max_steer)?;
    of.set_item("hitch_length", sizes.trailer.hitch_len)?;
    of.set_item("trailer_width", sizes.trailer.width)?;
    of.set_item("trailer_front_overhang", sizes.trailer.front_overhang)?;
    of.set_item("trailer_rear_overhang", sizes.trailer.rear_overhang)?;
    of.set_item("jackknife", sizes.trailer.jackknife)
}

/// A disc whose configuration is its centre: `x`, `y`, metres.
///
/// `radius` is from 0.001 m to 10 km, and Rusty's if it is left out, 0.11 m.
#[pyclass(frozen, extends = PyRobot, name = "Disc", module = "motion_lab")]
pub struct PyDisc;

#[pymethods]
impl PyDisc {
    #[new]
    #[pyo3(signature = (radius = None))]
    fn new(radius: Option<f64>) -> PyResult<PyClassInitializer<Self>> {
        let radius = radius.unwrap_or(RUSTY.body_radius);
        let disc = RustyDisc::try_new(radius).map_err(|error| Error::new_err(error.to_string()))?;
        Ok(PyClassInitializer::from(PyRobot { robot: LabRobot::Disc(disc) }).add_subclass(PyDisc))
    }

    /// The radius, metres.
    #[getter]
    fn radius(slf: &Bound<'_, Self>) -> f64 {
        match slf.as_super().get().robot {
            LabRobot::Disc(disc) => disc.radius,
            _ => f64::NAN,
        }
    }
}

/// Rusty, the rover: a disc with a heading, whose configuration is `x`, `y`, metres, and `theta`, radians.
///
/// `radius` is its body's, `track` the distance between its wheels, `wheel_radius` theirs, metres: 0.11, 0.16 and 0.033
/// if left out.
#[pyclass(frozen, extends = PyRobot, name = "Rusty", module = "motion_lab")]
pub struct PyRusty;

#[pymethods]
impl PyRusty {
    #[new]
    #[pyo3(signature = (radius = None, *, track = None, wheel_radius = None))]
    fn new(radius: Option<f64>, track: Option<f64>, wheel_radius: Option<f64>) -> PyResult<PyClassInitializer<Self>> {
        let sizes = Sizes::Disc(DiscSizes {
            radius: radius.unwrap_or(RUSTY.body_radius),
            track: track.unwrap_or(RUSTY.track),
            wheel_radius: wheel_radius.unwrap_or(RUSTY.wheel_radius),
        });
        let rover = checked(&sizes)?.and_then(|sizes| RUSTY.with_sizes(sizes)).unwrap_or(RUSTY);
        Ok(PyClassInitializer::from(PyRobot { robot: LabRobot::Rusty(rover) }).add_subclass(PyRusty))
    }

    /// The radius of its body, metres.
    #[getter]
    fn radius(slf: &Bound<'_, Self>) -> f64 {
        match slf.as_super().get().robot {
            LabRobot::Rusty(rover) => rover.body_radius,
            _ => f64::NAN,
        }
    }
}

/// Reach, an arm pinned at its base, whose configuration is the angles of its joints, radians, each from the link
/// before: `th1`, `th2`, and `th3` with three links.
///
/// `lengths` are those of its two or three links, metres; `base` is the place of the first joint, and `radius` that of
/// the links, metres, of which 0 makes them segments without thickness. Left out, they are those of the arm on the
/// Workbench: two links of 1 m, at the origin, 0.03 m.
#[pyclass(frozen, extends = PyRobot, name = "Reach", module = "motion_lab")]
pub struct PyReach;

#[pymethods]
impl PyReach {
    #[new]
    #[pyo3(signature = (lengths = None, *, base = None, radius = None))]
    fn new(
        lengths: Option<Vec<f64>>,
        base: Option<(f64, f64)>,
        radius: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let own = Reach::<2>::workbench();
        let lengths = lengths.unwrap_or_else(|| own.lengths.to_vec());
        let base = base.map_or(own.base, |(x, y)| Point2::new(x, y));
        let radius = radius.unwrap_or(own.link_radius);
        let n = lengths.len();
        let sizes = Sizes::Arm(ArmSizes { base, lengths, radius });
        if !(n == 2 || n == 3) {
            return Err(Error::new_err(format!(
                "{n} length{}: an arm has 2 or 3 links",
                if n == 1 { "" } else { "s" }
            )));
        }
        let sized = checked(&sizes)?;
        let two = sized.and_then(|sizes| own.with_sizes(sizes)).map(LabRobot::Reach2);
        let three = || sized.and_then(|sizes| Reach::<3>::redundant().with_sizes(sizes)).map(LabRobot::Reach3);
        let robot = two.or_else(three).unwrap_or(LabRobot::Reach2(own));
        Ok(PyClassInitializer::from(PyRobot { robot }).add_subclass(PyReach))
    }

    /// The lengths of its links, metres.
    #[getter]
    fn lengths<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        match slf.as_super().get().robot {
            LabRobot::Reach2(arm) => PyTuple::new(slf.py(), arm.lengths),
            LabRobot::Reach3(arm) => PyTuple::new(slf.py(), arm.lengths),
            _ => Ok(PyTuple::empty(slf.py())),
        }
    }
}

/// Hitch, a car, whose configuration is the middle of its rear axle, `x`, `y`, metres, its heading `theta`, radians,
/// and with a trailer the trailer's heading `psi`, radians.
///
/// Lengths are metres, angles radians; what is left out is the lab's Hitch's. `jackknife` is the greatest angle between
/// the two headings, beyond which nothing is free; without one the hitch folds as far as it likes.
#[pyclass(frozen, extends = PyRobot, name = "Hitch", module = "motion_lab")]
pub struct PyHitch;

#[pymethods]
impl PyHitch {
    #[new]
    #[pyo3(signature = (trailer = false, *, jackknife = None, wheelbase = None, length = None, width = None,
        rear_overhang = None, max_steer = None, hitch_length = None, trailer_width = None,
        trailer_front_overhang = None, trailer_rear_overhang = None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn new(
        trailer: bool,
        jackknife: Option<f64>,
        wheelbase: Option<f64>,
        length: Option<f64>,
        width: Option<f64>,
        rear_overhang: Option<f64>,
        max_steer: Option<f64>,
        hitch_length: Option<f64>,
        trailer_width: Option<f64>,
        trailer_front_overhang: Option<f64>,
        trailer_rear_overhang: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let mut own = CarSizes::HITCH;
        let towed = &mut own.trailer;
        towed.jackknife = jackknife.or(towed.jackknife);
        for (place, given) in [
            (&mut own.wheelbase, wheelbase),
            (&mut own.length, length),
            (&mut own.width, width),
            (&mut own.rear_overhang, rear_overhang),
            (&mut own.max_steer, max_steer),
            (&mut towed.hitch_len, hitch_length),
            (&mut towed.width, trailer_width),
            (&mut towed.front_overhang, trailer_front_overhang),
            (&mut towed.rear_overhang, trailer_rear_overhang),
        ] {
            *place = given.unwrap_or(*place);
        }
        let sizes = Sizes::Car(own);
        let car = checked(&sizes)?.and_then(|sizes| HITCH.with_sizes(sizes)).unwrap_or(HITCH);
        let car = if trailer { car.with_trailer() } else { car.without_trailer() };
        Ok(PyClassInitializer::from(PyRobot { robot: LabRobot::Hitch(car) }).add_subclass(PyHitch))
    }

    /// Whether it pulls a trailer.
    #[getter]
    fn trailer(slf: &Bound<'_, Self>) -> bool {
        matches!(slf.as_super().get().robot, LabRobot::Hitch(car) if car.hitch_len.is_some())
    }
}

/// Sizes that the library accepts.
fn checked(sizes: &Sizes) -> PyResult<Option<&Sizes>> {
    sizes.check().map_err(|error| Error::new_err(error.to_string()))?;
    Ok(Some(sizes))
}
