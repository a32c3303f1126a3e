//! `Path`, a planned path with its proofs.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyFileExistsError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::planning::{Bounds, Effort};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::capture::{Paper, PlanOutcome, PlanSheet, plan, proven, unit};
use motion_lab_sim::plans::{FileLeg, OwnPlanner, PathFile, PathLengths, PlanAttempt, PlannerName, Task};
use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::tour::TourConfig;

use crate::errors::{Error, RunError};
use crate::file::replace;
use crate::natural::counted;
use crate::picture::{PyPicture, theme};
use crate::planning::{any_robot, check_clearance, end, no_path, place};
use crate::recording::recorded;
use crate::robot::{LabRobot, PyRobot};
use crate::run::PyRun;

/// The width of a picture, pixels.
const WIDTH: u32 = 640;

/// A path from a start to a goal whose legs are all proven free. `plan` makes it, and `Path.of` of corners.
///
/// A leg is a straight line in the robot's coordinates, angles the short way round; of a car what it drives under one
/// control.
#[pyclass(frozen, name = "Path", module = "motion_lab")]
pub struct PyPath {
    robot: LabRobot,
    task: Task,
    planner: PlannerName,
    clearance_asked: f64,
    seed: u64,
    legs: Vec<FileLeg>,
    lengths: PathLengths,
    effort: Effort,
    attempt: Mutex<Box<dyn PlanAttempt>>,
}

impl PyPath {
    /// The path that an attempt has found, and the clearance that was asked of it.
    pub fn new(
        (robot, task): (LabRobot, Task),
        (planner, clearance_asked): (PlannerName, f64),
        seed: u64,
        attempt: Box<dyn PlanAttempt>,
    ) -> Self {
        let (legs, lengths, effort) = (attempt.legs(), attempt.lengths(), attempt.effort());
        PyPath { robot, task, planner, clearance_asked, seed, legs, lengths, effort, attempt: Mutex::new(attempt) }
    }

    /// Works with the attempt, with the interpreter's lock released.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&dyn PlanAttempt) -> T + Send) -> T {
        py.detach(|| work(self.attempt.lock().unwrap_or_else(PoisonError::into_inner).as_ref()))
    }

    /// A configuration of a leg as this robot's coordinates: a rover's legs are those of a disc.
    fn own(&self, q: &[f64]) -> Vec<f64> {
        let width = self.robot.coordinates().len();
        q.iter().copied().chain(std::iter::repeat(0.0)).take(width).collect()
    }

    /// The same task in the world with the robot alone, at the path's start.
    fn alone(&self) -> Task {
        let Task { robot, start, world, .. } = &self.task;
        let usual = AnyRobot::model(robot.kind(), None).map(|model| model.fitted(start));
        let sizes = (usual != Some(*robot)).then(|| robot.sizes());
        let resident = Resident { sizes, ..Resident::new(robot.title(), robot.kind(), start.coordinates().to_vec()) };
        Task { world: Arc::new(World { robots: vec![resident], ..World::clone(world) }), ..self.task.clone() }
    }

    fn picture(&self, py: Python<'_>, theme_name: &str) -> PyResult<PyPicture> {
        let paper = Paper { palette: theme(theme_name)?.palette(), width: WIDTH, scale: 1.0 };
        Ok(PyPicture::of(self.with(py, |attempt| {
            let drawn = attempt.drawn();
            let sheet = PlanSheet {
                task: &self.task,
                planner: self.planner,
                seed: Seed(self.seed),
                drawn: &drawn,
                effort: self.effort,
                found: PlanOutcome::Path(self.lengths),
                cells: None,
            };
            plan(&sheet).svg(&paper)
        })))
    }
}

fn rows<'py>(py: Python<'py>, rows: &[Vec<f64>]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray2::from_vec2(py, rows).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// What a planner has done, by names.
pub fn effort_dict(py: Python<'_>, effort: Effort) -> PyResult<Bound<'_, PyDict>> {
    let Effort { iterations, samples, edges, free } = effort;
    let by_name = PyDict::new(py);
    for (name, count) in [("iterations", iterations), ("samples", samples), ("edges", edges), ("free", free)] {
        by_name.set_item(name, count)?;
    }
    Ok(by_name)
}

#[pymethods]
impl PyPath {
    /// The path of the straight lines through corners, `(k, d)`: configurations of metres and radians, angles the short
    /// way round, from its start to its goal. Every line is proven free as those of `plan` are, so a path from
    /// elsewhere has its proof. It takes a `Checker`, or a `World` or the name of one, and a `robot`; `clearance` is
    /// how far the path has to keep from every obstacle, metres.
    ///
    /// Raises NoPath, which names the first line that is not proven free, and what it hits; Error for a car, which
    /// drives no straight lines; ConfigurationError for a corner that is none of the robot's configurations.
    #[staticmethod]
    #[pyo3(signature = (checker, corners, *, robot = None, clearance = 0.0))]
    fn of(
        py: Python<'_>,
        checker: &Bound<'_, PyAny>,
        corners: &Bound<'_, PyAny>,
        robot: Option<&Bound<'_, PyRobot>>,
        clearance: f64,
    ) -> PyResult<Self> {
        check_clearance(Some(clearance))?;
        let (world, scene, robot) = place(checker, robot)?;
        let corners = corners.try_iter()?.map(|corner| end(&robot, "corners", &corner?));
        let corners: Vec<AnyConfiguration> = corners.collect::<PyResult<_>>()?;
        let (Some(start), Some(goal)) = (corners.first(), corners.last()) else {
            return Err(PyValueError::new_err("corners is empty: a path has a start and a goal"));
        };
        let (lab, ends) = (any_robot(&robot), [*start, *goal]);
        let in_scene = Task::in_scene(lab.title(), lab, (world, scene), ends);
        let task = Task { tube: 0.0, clearance: Some(clearance), ..in_scene };
        let mut attempt = task.attempt_through(&corners).map_err(|reason| no_path(py, &reason, None))?;
        let solved = py.detach(|| attempt.solve(&Bounds::of_iterations(1)));
        solved.map_err(|reason| no_path(py, &reason, Some(attempt.effort())))?;
        let name = PlannerName::Own(OwnPlanner::of_corners());
        Ok(PyPath::new((robot, task), (name, clearance), 0, attempt))
    }

    /// The start and the ends of the legs, shape `(k, d)`: metres and radians, in the robot's coordinates.
    #[getter]
    fn corners<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let first = self.legs.first().map(|leg| self.own(&leg.from));
        let corners: Vec<Vec<f64>> = first.into_iter().chain(self.legs.iter().map(|leg| self.own(&leg.to))).collect();
        rows(py, &corners)
    }

    /// What a car drives each leg with, shape `(k - 1, 3)`: speed, m/s, negative backward; steering angle, rad; time,
    /// s. None for a robot whose legs are straight lines.
    #[getter]
    fn controls<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let controls: Option<Vec<Vec<f64>>> =
            self.legs.iter().map(|leg| leg.driven.map(|driven| vec![driven.v, driven.phi, driven.seconds])).collect();
        controls.map(|controls| rows(py, &controls)).transpose()
    }

    /// The length: metres of a disc, a rover or a car; of an arm radians, by all of its joints.
    #[getter]
    fn length(&self) -> f64 {
        self.lengths.length
    }

    /// A length that no path undercuts, in the unit of `length`: of a rover larger by its tube, and with the clearance
    /// that was asked for. A disc's or a rover's is that of the shortest path, by tangents and arcs, less rounding; an
    /// arm's or a car's is proven by cells and some per cent shorter, a car's that turns about far more.
    #[getter]
    fn length_bound(&self, py: Python<'_>) -> Option<f64> {
        py.detach(|| self.task.length_bound())
    }

    /// The unit of `length`.
    #[getter]
    fn unit(&self) -> &'static str {
        unit(&self.task.robot)
    }

    /// The clearance that is proven along the whole path, metres; inf in a world without obstacles.
    #[getter]
    fn clearance(&self) -> f64 {
        self.lengths.clearance
    }

    /// The clearance that was asked of the path, metres: what was said, or what is usual for its planner, which may
    /// keep more by itself. Planners that were asked for another are not compared alike.
    #[getter]
    fn clearance_asked(&self) -> f64 {
        self.clearance_asked
    }

    /// The planner's name; `corners` of a path that was made of them.
    #[getter]
    fn planner(&self) -> &'static str {
        self.planner.id()
    }

    /// The seed of its samples.
    #[getter]
    fn seed(&self) -> u64 {
        self.seed
    }

    /// What the planner has done: `iterations`, `samples` drawn, `edges` asked about, and how many of them were `free`.
    #[getter]
    fn effort<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        effort_dict(py, self.effort)
    }

    /// The proofs: of each leg an array `(m, 3)` of the steps that prove it free. A step goes from one share of the leg
    /// to another, 0 to 1, and has the clearance that is proven along it, metres.
    #[getter]
    fn certificates<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let of = |leg: &FileLeg| {
            let steps: Vec<f64> = leg.steps.iter().flat_map(|step| [step.from, step.to, step.clearance]).collect();
            Ok(steps.into_pyarray(py).reshape([leg.steps.len(), 3])?.into_any())
        };
        self.legs.iter().map(of).collect()
    }

    /// What the planner has grown, the configurations of its tree or road map and its edges: arrays `(n, d)`, metres
    /// and radians, and `(m, 2)`, the numbers of the edges' ends.
    #[getter]
    fn growth<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (nodes, edges) = self.with(py, |attempt| attempt.growth());
        let shape = [nodes.len(), self.robot.coordinates().len()];
        let nodes: Vec<f64> = nodes.iter().flat_map(|node| self.own(node)).collect();
        let nodes = nodes.into_pyarray(py).reshape(shape)?.into_any();
        let ends: Vec<usize> = edges.iter().flatten().copied().collect();
        Ok((nodes, ends.into_pyarray(py).reshape([edges.len(), 2])?.into_any()))
    }

    /// The same as a `networkx.Graph`: the nodes are numbers, each with its configuration `q`.
    ///
    /// Raises ImportError without networkx.
    fn graph<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let graph = py.import("networkx")?.getattr("Graph")?.call0()?;
        let (nodes, edges) = self.with(py, |attempt| attempt.growth());
        for (number, node) in nodes.iter().enumerate() {
            let about = PyDict::new(py);
            about.set_item("q", PyTuple::new(py, self.own(node))?)?;
            graph.call_method("add_node", (number,), Some(&about))?;
        }
        let edges: Vec<(usize, usize)> = edges.into_iter().map(|[a, b]| (a, b)).collect();
        graph.call_method1("add_edges_from", (edges,))?;
        Ok(graph)
    }

    /// Check the proofs of all legs once more, by code that did not make them. Returns the clearance proven along the
    /// whole path, metres.
    ///
    /// Raises Error for a leg that is not proven, which no path of `plan` has.
    fn verify(&self, py: Python<'_>) -> PyResult<f64> {
        match self.with(py, |attempt| attempt.verify()) {
            Some(verified) => verified.map_err(|error| Error::new_err(error.to_string())),
            None => Err(Error::new_err("there is no path")),
        }
    }

    /// Play the path: the run in which the robot, of its own sizes and alone in the world, follows it from its start by
    /// inputs alone. A disc is played by a rover, which needs a `tube` to stay in.
    ///
    /// Raises RunError for a path that cannot be played.
    fn play(&self, py: Python<'_>) -> PyResult<PyRun> {
        let task = self.alone();
        let (world, played) = self.with(py, |attempt| task.played(attempt, Seed(self.seed)));
        let played = match played {
            Some(played) => played.map_err(|error| RunError::new_err(error.to_string()))?,
            None => return Err(RunError::new_err("there is no path")),
        };
        let config = TourConfig { worlds: vec![world], ticks: played.ticks, sensor: None };
        recorded(py, Recipe::new(config, (Seed(self.seed), played.script)), LogKind::Frames)
    }

    /// Write it as a path file, the JSON of `motion-lab plan -o`, which the lab's window shows. With `growth` it holds
    /// what the planner has grown too. An older path file is replaced; any other file only with `overwrite`.
    ///
    /// Raises FileExistsError for a file that is no path, OSError where the file cannot be written.
    #[pyo3(signature = (path, *, growth = false, overwrite = false))]
    fn write(&self, py: Python<'_>, path: PathBuf, growth: bool, overwrite: bool) -> PyResult<()> {
        let text =
            self.with(py, |attempt| PathFile::new(self.planner.id(), self.seed, &self.task, attempt, growth).to_json());
        let text = text.map_err(|error| Error::new_err(error.to_string()))?;
        let is_other =
            || path.is_file() && !std::fs::read_to_string(&path).is_ok_and(|old| PathFile::read(&old).is_ok());
        if !overwrite && py.detach(is_other) {
            let words = format!("{}: this file is no path; overwrite=True replaces it", path.display());
            return Err(PyFileExistsError::new_err(words));
        }
        replace(py, &path, text.as_bytes())
    }

    /// The picture of the world, of what the planner has grown and of the path. `theme` is `"light"` or `"dark"`.
    #[pyo3(signature = (*, theme = "light"))]
    fn plot(&self, py: Python<'_>, theme: &str) -> PyResult<PyPicture> {
        self.picture(py, theme)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.picture(py, "light")?.svg().to_owned())
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        self.picture(py, "light")?.html(py)
    }

    fn __len__(&self) -> usize {
        self.legs.len()
    }

    /// A path is true, also one that stays where it is.
    fn __bool__(&self) -> bool {
        true
    }

    fn __repr__(&self) -> String {
        let PathLengths { length, clearance } = self.lengths;
        let (planner, legs, unit) = (self.planner.id(), counted(self.legs.len(), "leg"), unit(&self.task.robot));
        let clearance = proven(clearance);
        format!("<Path of {legs}, {length:.3} {unit}, by {planner}: clearance {clearance} m, proven>")
    }
}
