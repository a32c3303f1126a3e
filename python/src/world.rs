//! Worlds: by name, out of a file, out of a text, out of arrays.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple, PyType};

use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::Aabb;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

use crate::drawing::world_svg;
use crate::errors::{nowhere_in_a_world, world_error};
use crate::file::{os_error, text_of};
use crate::natural::counted;
use crate::picture::PyPicture;
use crate::resident::{PyResident, resident};
use crate::robot::PyRobot;
use crate::shapes::{Shapes, pieces};

/// Largest world file that is read, bytes.
const MAX_FILE: u64 = 32 << 20;

/// A world: named obstacles, places and robots, in metres and radians. It never changes.
///
/// `World("apartment")` is the built-in world of that name: `apartment`, `workbench` or `lot`. `World.read`,
/// `World.parse` and `World.from_shapes` make others. `str(world)` is its text as a world file, and two worlds are
/// equal when everything in them is.
///
/// Raises WorldError, which is a ValueError, for a name that no world has.
#[pyclass(frozen, name = "World", module = "motion_lab")]
#[derive(Clone)]
pub struct PyWorld {
    /// The library's world.
    pub world: Arc<World>,
    scene: Arc<OnceLock<Arc<Scene>>>,
}

/// The built-in worlds that were asked for, in the order of their names: a call that names one need not read it again.
static BUILT_IN: [OnceLock<PyWorld>; 3] = [const { OnceLock::new() }; 3];

impl From<World> for PyWorld {
    fn from(world: World) -> Self {
        PyWorld { world: Arc::new(world), scene: Arc::default() }
    }
}

impl PyWorld {
    /// Its obstacles under one index, built once.
    pub fn scene(&self) -> Arc<Scene> {
        Arc::clone(self.scene.get_or_init(|| Arc::new(Scene::of_world(&self.world))))
    }

    /// A world, or the built-in one of a name.
    ///
    /// # Errors
    /// `WorldError` for a name that there is not, `TypeError` for what is neither.
    pub fn of<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyWorld>> {
        if let Ok(world) = given.cast::<PyWorld>() {
            return Ok(world.clone());
        }
        match given.cast::<PyString>() {
            Ok(name) => Bound::new(given.py(), PyWorld::named(given.py(), &name.to_string_lossy())?),
            Err(_) => {
                let class = given.get_type().name()?;
                Err(PyTypeError::new_err(format!("a world is a World or the name of one, not {class}")))
            }
        }
    }

    /// The built-in world of a name.
    ///
    /// # Errors
    /// `WorldError` for a name that there is not.
    pub fn named(py: Python<'_>, name: &str) -> PyResult<PyWorld> {
        let known = World::built_in_names();
        let kept = known.iter().position(|known| *known == name).and_then(|i| BUILT_IN.get(i));
        if let Some(world) = kept.and_then(OnceLock::get) {
            return Ok(world.clone());
        }
        let world = World::named(name).map_err(|unknown| {
            let file = if unknown.meant().is_none() { ", and World.read reads a file" } else { "" };
            nowhere_in_a_world(py, format!("{unknown}{file}"))
        })?;
        let world = PyWorld::from(world);
        Ok(kept.map_or(world.clone(), |kept| kept.get_or_init(|| world).clone()))
    }
}

#[pymethods]
impl PyWorld {
    #[new]
    fn new(py: Python<'_>, name: &str) -> PyResult<Self> {
        PyWorld::named(py, name)
    }

    /// Read a world file of at most 32 MiB: the RON text that `motion-lab world show apartment` prints.
    ///
    /// Raises OSError for a file that cannot be read, and WorldError, with `path`, `line` and `column`, for one that is
    /// no world.
    #[staticmethod]
    pub fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let text = text_of(py, &path, "a world file", MAX_FILE)?.map_err(|words| nowhere_in_a_world(py, words))?;
        parsed(py, &path.display().to_string(), &text)
    }

    /// Make a world of the text of a world file. Errors call the text `name`.
    ///
    /// Raises WorldError, with `path`, `line` and `column`, for a text that is no world.
    #[staticmethod]
    #[pyo3(signature = (text, name = "<text>"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        parsed(py, name, text)
    }

    /// Make a world of arrays, in metres:
    ///
    /// - `segments`, shape `(n, 4)` or `(n, 2, 2)`: two ends, `x0, y0, x1, y1`; walls without thickness;
    /// - `boxes`, `(n, 4)` or `(n, 2, 2)`: the least corner and the greatest, `min x, min y, max x, max y`;
    /// - `discs`, `(n, 3)`: centre and radius, `x, y, r`;
    /// - `polygons`, a list of arrays `(k, 2)`: simple polygons, convex or not, in either direction;
    /// - `occupancy`, `(rows, columns)`, bool: cells of `resolution` metres, from the lower left corner `origin`, `(0,
    ///   0)` if left out; row 0 is the lowest, so a picture wants `[::-1]`.
    ///
    /// The obstacles are named `segment 1`, `box 1`, `disc 1`, `polygon 1` and so on, in the order of the arrays; cells
    /// become boxes, each of many cells, `cells 1` and so on. `bounds` is `(min x, min y, max x, max y)`, if left out
    /// the box around all the shapes and cells. They are no obstacle.
    ///
    /// Raises WorldError for what no world may hold, as a disc without a radius, and says which one it is.
    #[staticmethod]
    #[pyo3(signature = (*, segments = None, boxes = None, discs = None, polygons = None, occupancy = None,
        resolution = None, origin = None, bounds = None, name = "World"))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn from_shapes(
        py: Python<'_>,
        segments: Option<&Bound<'_, PyAny>>,
        boxes: Option<&Bound<'_, PyAny>>,
        discs: Option<&Bound<'_, PyAny>>,
        polygons: Option<&Bound<'_, PyAny>>,
        occupancy: Option<&Bound<'_, PyAny>>,
        resolution: Option<f64>,
        origin: Option<(f64, f64)>,
        bounds: Option<(f64, f64, f64, f64)>,
        name: &str,
    ) -> PyResult<Self> {
        let mut shapes = Shapes::default();
        if let Some(segments) = segments {
            shapes.segments(segments)?;
        }
        if let Some(boxes) = boxes {
            shapes.boxes(boxes)?;
        }
        if let Some(discs) = discs {
            shapes.discs(discs)?;
        }
        if let Some(polygons) = polygons {
            shapes.polygons(polygons)?;
        }
        if let Some(occupancy) = occupancy {
            shapes.occupancy(occupancy, resolution, origin.unwrap_or_default())?;
        }
        Ok(shapes.finish(py, name, bounds)?.into())
    }

    /// The same world with one more robot, which lives in it: `robot`, a `Rusty`, `Reach` or `Hitch`, at the
    /// configuration `start`; of a rover that is `x, y, theta`, of a car with its trailer one number more.
    ///
    /// Raises WorldError for a name that is taken or none, and for a start or sizes that the world has no room for.
    fn with_robot(&self, py: Python<'_>, name: &str, robot: &Bound<'_, PyRobot>, start: Vec<f64>) -> PyResult<Self> {
        let added = resident(py, &self.world, name, &robot.get().robot, start)?;
        let mut world = (*self.world).clone();
        world.robots.push(added);
        Ok(world.into())
    }

    /// The world's name.
    #[getter]
    fn name(&self) -> &str {
        &self.world.name
    }

    /// The part of the plane that it shows, metres: `(min x, min y, max x, max y)`. It is no obstacle.
    #[getter]
    fn bounds(&self) -> (f64, f64, f64, f64) {
        let Aabb { min, max } = self.world.bounds;
        (min.x, min.y, max.x, max.y)
    }

    /// The obstacles, as the answers number them: those of the file in its order, walls first, then the closed doors.
    #[getter]
    fn obstacles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let all = self.world.obstacles.iter().cloned().chain(self.world.closed_doors());
        PyTuple::new(py, all.map(|obstacle| PyObstacle { obstacle }).collect::<Vec<_>>())
    }

    /// The robots that live in it.
    #[getter]
    fn robots<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let robots = self.world.robots.iter().cloned().map(PyResident::from);
        PyTuple::new(py, robots.collect::<Vec<_>>())
    }

    /// The named places: `(x, y, theta)` by name, metres and radians.
    #[getter]
    fn places<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = PyDict::new(py);
        for place in &self.world.places {
            places.set_item(&place.name, (place.pose.x, place.pose.y, place.pose.theta))?;
        }
        Ok(places)
    }

    /// Write it as a world file, which `World.read` reads as an equal world.
    ///
    /// Raises OSError for a file that cannot be written.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| std::fs::write(&path, self.world.to_ron())).map_err(|error| os_error(&error, &path))
    }

    fn __str__(&self) -> String {
        self.world.to_ron()
    }

    fn __repr__(&self) -> String {
        let World { name, obstacles, robots, .. } = &*self.world;
        let [obstacles, robots] =
            [(obstacles.len(), "obstacle"), (robots.len(), "robot")].map(|(n, what)| counted(n, what));
        format!("<World {name:?}: {obstacles}, {robots}>")
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<PyWorld>().is_ok_and(|other| *other.get().world == *self.world)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.world.content_hash().hash(&mut hasher);
        hasher.finish()
    }

    /// Its picture: walls, obstacles, doors, routes and marks.
    fn plot(&self) -> PyPicture {
        PyPicture::of(world_svg(&self.world))
    }

    /// Draw it on `ax`, axes of matplotlib, in metres, and fit them to its bounds. Returns the axes.
    ///
    /// Raises ImportError without matplotlib.
    fn draw<'py>(slf: &Bound<'py, Self>, ax: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("motion_lab._draw")?.getattr("draw")?.call1((slf, ax))
    }

    fn _repr_svg_(&self) -> String {
        world_svg(&self.world)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        self.plot().html(py)
    }

    /// What pickles hold: the text.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let parse = PyType::new::<PyWorld>(slf.py()).getattr("parse")?;
        Ok((parse, (slf.get().world.to_ron(),)))
    }
}

fn parsed(py: Python<'_>, name: &str, text: &str) -> PyResult<PyWorld> {
    let world = py.detach(|| World::parse(name, text));
    world.map(PyWorld::from).map_err(|error| world_error(py, &error))
}

/// An obstacle of a world.
#[pyclass(frozen, name = "Obstacle", module = "motion_lab")]
pub struct PyObstacle {
    obstacle: Obstacle,
}

#[pymethods]
impl PyObstacle {
    /// Its name, unique in its world.
    #[getter]
    fn name(&self) -> &str {
        &self.obstacle.name
    }

    /// `'wall'` or `'solid'`.
    #[getter]
    fn kind(&self) -> &'static str {
        match self.obstacle.kind {
            ObstacleKind::Wall => "wall",
            ObstacleKind::Solid => "solid",
        }
    }

    /// Its convex pieces: each all points within `radius`, metres, of the convex hull of `vertices`, an array `(k, 2)`
    /// in world coordinates, counter-clockwise. A disc has one vertex, a segment two.
    #[getter]
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        pieces(py, self.obstacle.placed())
    }

    fn __repr__(&self) -> String {
        let Obstacle { name, pieces, .. } = &self.obstacle;
        format!("<Obstacle {name:?}: {} of {}>", self.kind(), counted(pieces.len(), "shape"))
    }
}
