//! `Assignment`, what a course asks for, and the grade of what is handed in.

use std::path::{Path, PathBuf};
use std::time::Instant;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use motion_lab_core::worlds::World;
use motion_lab_sim::course::{Assignment, AssignmentFile, Attempt, Criterion, Grade, Submission};

use crate::errors::Error;
use crate::file::{MAX_TEXT, text_of};
use crate::interrupt::PIECE;
use crate::natural::counted;
use crate::run::{PyRun, read};
use crate::script::script;
use crate::world::PyWorld;

/// An assignment: the goal of a robot in a world, limits, and the seeds at which a submission is run.
///
/// `Assignment.read` reads a file, `Assignment.parse` its text, as `motion-lab grade --help` shows one.
#[pyclass(frozen, name = "Assignment", module = "motion_lab")]
pub struct PyAssignment {
    assignment: Assignment,
}

/// What a submission earned. It is true when it passed at every seed.
#[pyclass(frozen, name = "Grade", module = "motion_lab")]
pub struct PyGrade {
    grade: Grade,
}

/// A submission's run at one seed.
#[pyclass(frozen, name = "Attempt", module = "motion_lab", get_all)]
pub struct PyAttempt {
    /// The seed.
    seed: u64,
    /// `passed`, `missed the goal`, `left the goal`, `too many contacts` or `too many reversals`.
    verdict: String,
    /// The tick that decided it.
    tick: u64,
    /// The contact episodes up to then.
    contacts: u32,
    /// The changes between forward and backward up to then.
    reversals: u32,
    /// The configuration then, metres and radians.
    configuration: Vec<f64>,
    /// How far its place is from the goal's, metres; None for a configuration of another space.
    metres: Option<f64>,
    /// The greatest difference of an angle to the goal's, radians; None likewise.
    radians: Option<f64>,
    /// Whether it got there within all limits, which is its truth value too.
    passed: bool,
}

impl PyAttempt {
    fn of(attempt: &Attempt) -> Self {
        let Attempt { seed, verdict, tick, contacts, reversals, configuration, distance, .. } = attempt;
        PyAttempt {
            seed: seed.0,
            verdict: verdict.to_string(),
            tick: *tick,
            contacts: *contacts,
            reversals: *reversals,
            configuration: configuration.to_vec(),
            metres: distance.map(|distance| distance.metres),
            radians: distance.map(|distance| distance.radians),
            passed: attempt.passed(),
        }
    }
}

#[pymethods]
impl PyAttempt {
    fn __bool__(&self) -> bool {
        self.passed
    }

    fn __repr__(&self) -> String {
        let PyAttempt { seed, verdict, tick, contacts, reversals, .. } = self;
        let [contacts, reversals] =
            [(contacts, "contact"), (reversals, "reversal")].map(|(n, what)| counted(*n as usize, what));
        format!("<Attempt at seed {seed}: {verdict} at tick {tick}, {contacts}, {reversals}>")
    }
}

/// The world that an assignment names: a built-in one, or a file seen from the assignment's folder.
fn world_of(py: Python<'_>, name: &str, folder: Option<&Path>) -> PyResult<PyWorld> {
    let beside = folder.map(|folder| folder.join(name)).filter(|path| World::built_in(name).is_none() && path.exists());
    beside.map_or_else(|| PyWorld::named(py, name), |path| PyWorld::read(py, path))
}

impl PyAssignment {
    fn of(
        py: Python<'_>,
        file: &str,
        text: &str,
        world: Option<&Bound<'_, PyAny>>,
        folder: Option<&Path>,
    ) -> PyResult<Self> {
        let refused = |error: &dyn std::fmt::Display| Error::new_err(error.to_string());
        let file = AssignmentFile::parse(file, text).map_err(|error| refused(&error))?;
        let world = match world.filter(|world| !world.is_none()) {
            Some(world) => PyWorld::of(world)?.get().clone(),
            None => world_of(py, file.world_name(), folder)?,
        };
        let assignment = file.in_world((*world.world).clone()).map_err(|error| refused(&error))?;
        Ok(PyAssignment { assignment })
    }
}

/// A submission: a run, the path of its log, or what is a script.
fn submission(py: Python<'_>, given: &Bound<'_, PyAny>) -> PyResult<Submission> {
    if let Ok(run) = given.cast::<PyRun>() {
        return Ok(Submission::Log(Box::new((*run.get().log).clone())));
    }
    match given.extract::<PathBuf>() {
        Ok(path) if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mcap")) => {
            Ok(Submission::Log(Box::new((*read(py, path)?.log).clone())))
        }
        _ if given.is_none() => {
            Err(PyTypeError::new_err("a submission is a Run, a script, or the path of either, not None"))
        }
        _ => script(Some(given)).map(Submission::Script),
    }
}

#[pymethods]
impl PyAssignment {
    /// Read an assignment's file of at most 64 MiB. Its world is a built-in one, a file seen from its own folder, or
    /// `world`.
    ///
    /// Raises OSError for a file that cannot be read, WorldError for a world that there is not, and Error, with file,
    /// line, column and item, for what is no assignment in it.
    #[staticmethod]
    #[pyo3(signature = (path, *, world = None))]
    fn read(py: Python<'_>, path: PathBuf, world: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let text = text_of(py, &path, "an assignment", MAX_TEXT)?.map_err(Error::new_err)?;
        PyAssignment::of(py, &path.display().to_string(), &text, world, path.parent())
    }

    /// Make an assignment of its text. Errors call the text `name`.
    ///
    /// Raises WorldError and Error, as `read`.
    #[staticmethod]
    #[pyo3(signature = (text, *, world = None, name = "<text>"))]
    fn parse(py: Python<'_>, text: &str, world: Option<&Bound<'_, PyAny>>, name: &str) -> PyResult<Self> {
        PyAssignment::of(py, name, text, world, None)
    }

    /// The world, with the robot at the assignment's start.
    #[getter]
    fn world(&self) -> PyWorld {
        self.assignment.world().clone().into()
    }

    /// The name of the robot.
    #[getter]
    fn robot(&self) -> &str {
        self.assignment.world().robots.get(self.assignment.robot()).map_or("", |robot| &robot.name)
    }

    /// The seeds.
    #[getter]
    fn seeds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.assignment.seeds().iter().map(|seed| seed.0))
    }

    /// The ticks within which the robot has to be there.
    #[getter]
    fn ticks(&self) -> u64 {
        self.assignment.limits().ticks
    }

    /// Grade a submission by running it again at every seed: a `Run` or the path of its log, named .mcap, or a script
    /// as `record` takes it. The frames of a run are not believed: one that is simulated otherwise is refused as
    /// forged.
    ///
    /// Raises RunError for what is no script, and LogError for what is no log, or one that was changed after it was
    /// recorded. Ctrl+C stops it within 0.1 s, once a run was simulated again.
    fn grade(&self, py: Python<'_>, submission: &Bound<'_, PyAny>) -> PyResult<PyGrade> {
        let submission = self::submission(py, submission)?;
        let (mut heard, mut stopped) = (Instant::now(), None);
        let goes_on = |_, _| {
            if heard.elapsed() > PIECE {
                heard = Instant::now();
                stopped = Python::attach(|py| py.check_signals()).err();
            }
            stopped.is_none()
        };
        let grade = py.detach(|| self.assignment.grade_while(&submission, goes_on));
        match (grade, stopped) {
            (Some(grade), None) => Ok(PyGrade { grade }),
            (_, Some(error)) => Err(error),
            (None, None) => Err(Error::new_err("grading was stopped")),
        }
    }

    fn __repr__(&self) -> String {
        let seeds = counted(self.assignment.seeds().len(), "seed");
        let world = &self.assignment.world().name;
        format!("<Assignment for {} in {world}: {} ticks, {seeds}>", self.robot(), self.ticks())
    }
}

#[pymethods]
impl PyGrade {
    /// The points earned.
    #[getter]
    fn points(&self) -> f64 {
        self.grade.score.points
    }

    /// The points that could be earned.
    #[getter]
    fn max_points(&self) -> f64 {
        self.grade.score.of
    }

    /// What is worth points, in order: a tuple each of the criterion, the points earned, and those that could be.
    #[getter]
    fn criteria(&self) -> Vec<(&'static str, f64, f64)> {
        let part = |criterion: &Criterion| (criterion.name, criterion.points, criterion.of);
        self.grade.score.criteria.iter().map(part).collect()
    }

    /// Why it was not graded; None when it was.
    #[getter]
    fn refused(&self) -> Option<String> {
        self.grade.refusal.as_ref().map(ToString::to_string)
    }

    /// One attempt for each seed, in order; none when it was refused.
    #[getter]
    fn attempts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.grade.attempts.iter().map(PyAttempt::of))
    }

    fn __bool__(&self) -> bool {
        self.grade.passed()
    }

    fn __repr__(&self) -> String {
        if let Some(reason) = self.refused() {
            return format!("<Grade: refused: {reason}>");
        }
        let passed = self.grade.attempts.iter().filter(|attempt| attempt.passed()).count();
        let (points, of, seeds) = (self.points(), self.max_points(), self.grade.attempts.len());
        format!("<Grade: {points} of {of} points, passed at {passed} of {}>", counted(seeds, "seed"))
    }
}
