//! `plan`, a planner at work until it has a path.

use std::sync::Arc;
use std::time::{Duration, Instant};

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::{AnyConfiguration, Configuration, HitchCfg, Tn};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::planning::{Bounds, Effort, NoPath as LabNoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, RUSTY, Robot, Rusty};
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{MAX_CLEARANCE, PlanAttempt, PlannerName, Planners, Task};
use motion_lab_sim::tour::BOOK_SEED;

use crate::arrays::Given;
use crate::checker::PyChecker;
use crate::errors::{Error, NoPath, configuration_error, with};
use crate::natural::natural_or_none;
use crate::own_planner::PyPlanner;
use crate::path::PyPath;
use crate::path::effort_dict;
use crate::robot::{LabRobot, PyRobot};
use crate::world::PyWorld;

/// How long a planner works before somebody may stop it.
const PIECE: Duration = Duration::from_millis(20);

/// The names of the planners, for `plan`.
#[pyfunction]
pub fn planner_names() -> Vec<&'static str> {
    PlannerName::ALL.into_iter().map(PlannerName::id).collect()
}

/// Plan a path for a checker's robot in its world, from `start` to `goal`, configurations of metres and radians. Every
/// leg of the path is proven free, touching nothing, and its proof was checked by code that did not make it. Instead of
/// a `Checker` it takes a `World` or the name of one, and a `robot`.
///
/// `planner` is one of `planner_names()`; if left out `rrt-connect`, for a car `hybrid-a-star`. Or it is a planner of
/// yours for any robot but a car: an object, or its class, with a `name` and a method `advance(search)`, called for
/// each iteration until it has taken a path; `draws_samples` is True of one that joins samples. What it raises is
/// raised; one that gives up raises `NoPath` with its reason.
///
/// `seed`, 2005, is what the samples follow from: the same seed gives the same path on every machine. A rover's heading
/// does not matter: its path is that of a disc, all headings 0. A car's path ends within 0.1 m and 0.05 rad of its
/// goal.
///
/// `clearance` is how far the path keeps from every obstacle, metres; if left out 0.001 m by planners that draw
/// samples, if start and goal have it, else 0; to compare planners alike, say one. `budget` is the greatest number of
/// iterations, 100,000 if left out (20,000 for `hybrid-a-star`); with it `rrt-star`, `informed-rrt-star` and `prm` go
/// on to there and shorten their path. `tube` is how much larger a disc or a rover is planned, metres, as `motion-lab
/// plan --tube`, which says 0.02. `shorten` shortens the path, as certified as before, by shortcuts of that seed and
/// cut corners; a car's it leaves as it is.
///
/// Raises NoPath, which says why there is none, with `effort`, what was done for it, as a path has it, None where there
/// was no problem; Error for a planner that does not plan for this robot;
/// ConfigurationError for ends that are none of the robot's configurations. Ctrl+C stops it within 0.1 s.
#[pyfunction]
#[pyo3(signature = (checker, start, goal, *, robot = None, planner = None, seed = None, clearance = None,
    budget = None, tube = 0.0, shorten = false))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub fn plan(
    py: Python<'_>,
    checker: &Bound<'_, PyAny>,
    start: &Bound<'_, PyAny>,
    goal: &Bound<'_, PyAny>,
    robot: Option<&Bound<'_, PyRobot>>,
    planner: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    clearance: Option<f64>,
    budget: Option<&Bound<'_, PyAny>>,
    tube: f64,
    shorten: bool,
) -> PyResult<PyPath> {
    let seed = natural_or_none("seed", seed)?.map_or(BOOK_SEED, Seed);
    let budget = natural_or_none("budget", budget)?;
    let (world, scene, robot) = place(checker, robot)?;
    let ends = [end(&robot, "start", start)?, end(&robot, "goal", goal)?];
    let lab = any_robot(&robot);
    let (name, own) = match planner {
        None => (PlannerName::default_for(&lab), None),
        Some(planner) => match planner.cast::<PyString>() {
            Ok(name) => (named(&name.to_cow()?)?, None),
            Err(_) => {
                let own = PyPlanner::of(planner)?;
                (own.name(), Some(own))
            }
        },
    };
    check_clearance(clearance)?;
    if !(0.0..=1.0).contains(&tube) {
        return Err(PyValueError::new_err(format!("tube {tube}: it must be from 0 to 1 m")));
    }
    let task = Task { tube, clearance, ..Task::in_scene(lab.title(), lab, (world, scene), ends) };
    let asked = clearance.unwrap_or_else(|| task.usual_clearance(name.draws_samples()));
    let made = py.detach(|| match &own {
        Some(own) => task.attempt_by_lines(own, name.draws_samples(), seed),
        None => task.attempt(name, seed),
    });
    let mut attempt = made.map_err(|reason| no_path(py, &reason, None))?;
    let solved = solve(py, attempt.as_mut(), name, budget);
    let effort = attempt.effort();
    if let Some(raised) = own.and_then(|own| own.ended()) {
        return Err(if raised.is_instance_of::<NoPath>(py) { with_effort(py, raised, Some(effort)) } else { raised });
    }
    solved?.map_err(|reason| no_path(py, &reason, Some(effort)))?;
    if shorten {
        py.detach(|| attempt.shorten(seed));
    }
    Ok(PyPath::new((robot, task), (name, asked), seed.0, attempt))
}

/// Refuses a clearance that is none.
pub fn check_clearance(clearance: Option<f64>) -> PyResult<()> {
    match clearance.filter(|kept| !(0.0..=MAX_CLEARANCE).contains(kept)) {
        Some(kept) => Err(PyValueError::new_err(format!("clearance {kept}: it must be from 0 to {MAX_CLEARANCE} m"))),
        None => Ok(()),
    }
}

/// Why there is no path, as it is raised.
pub fn no_path(py: Python<'_>, reason: &LabNoPath, effort: Option<Effort>) -> PyErr {
    match reason {
        LabNoPath::Unsuited(_) => Error::new_err(reason.to_string()),
        reason => with_effort(py, NoPath::new_err(reason.to_string()), effort),
    }
}

fn with_effort(py: Python<'_>, raised: PyErr, effort: Option<Effort>) -> PyErr {
    with(py, raised, |value| value.setattr("effort", effort.map(|effort| effort_dict(py, effort)).transpose()?))
}

/// The world, its obstacles under an index, and the robot that a path is planned for.
pub fn place(
    given: &Bound<'_, PyAny>,
    robot: Option<&Bound<'_, PyRobot>>,
) -> PyResult<(Arc<World>, Arc<Scene>, LabRobot)> {
    let (world, robot) = match (given.cast::<PyChecker>(), robot) {
        (Ok(checker), None) => {
            let checker = checker.get();
            (checker.world.bind(given.py()).clone(), checker.robot.bind(given.py()).clone())
        }
        (Ok(_), Some(_)) => return Err(PyTypeError::new_err("a Checker has its robot: leave out robot=")),
        (Err(_), Some(robot)) => (PyWorld::of(given)?, robot.clone()),
        (Err(_), None) => {
            return Err(PyTypeError::new_err("a path is planned for a Checker, or for a World and robot="));
        }
    };
    let world = world.get();
    Ok((Arc::clone(&world.world), world.scene(), robot.get().robot))
}

/// The planner of this name.
fn named(name: &str) -> PyResult<PlannerName> {
    Planners::default().named(name).map_err(|unknown| PyValueError::new_err(unknown.to_string()))
}

/// The lab's robot for planners: a disc is the rover's body.
pub fn any_robot(robot: &LabRobot) -> AnyRobot {
    match *robot {
        LabRobot::Disc(disc) => AnyRobot::Rusty(Rusty { body_radius: disc.radius, ..RUSTY }),
        LabRobot::Rusty(rover) => AnyRobot::Rusty(rover),
        LabRobot::Reach2(arm) => AnyRobot::Reach(arm),
        LabRobot::Reach3(arm) => AnyRobot::Reach3(arm),
        LabRobot::Hitch(car) => AnyRobot::Hitch(car),
    }
}

/// One end of a path.
pub fn end(robot: &LabRobot, name: &'static str, given: &Bound<'_, PyAny>) -> PyResult<AnyConfiguration> {
    let row = match robot.row_kind().read(name, given)? {
        Given::One(row) => row,
        Given::Many(_) => return Err(PyTypeError::new_err(format!("{name} is one configuration, not many"))),
    };
    let q = match (robot, row.numbers()) {
        (LabRobot::Disc(_), &[x, y]) => Pose2::new(x, y, 0.0).into(),
        (LabRobot::Rusty(_), &[x, y, theta]) => Pose2::new(x, y, theta).into(),
        (LabRobot::Reach2(_), &[a, b]) => Tn([a, b]).into(),
        (LabRobot::Reach3(_), &[a, b, c]) => Tn([a, b, c]).into(),
        (LabRobot::Hitch(_), &[x, y, theta]) => HitchCfg { body: Pose2::new(x, y, theta), trailer: None }.into(),
        (LabRobot::Hitch(_), &[x, y, theta, psi]) => {
            HitchCfg { body: Pose2::new(x, y, theta), trailer: Some(psi) }.into()
        }
        _ => return Err(PyTypeError::new_err(format!("{name} is no configuration of this robot"))),
    };
    let checked: Result<(), _> = any_robot(robot).check(&q);
    checked.map_err(|error| configuration_error(given.py(), name, &[], &error.to_string()))?;
    Ok(q.in_chart())
}

/// Works on a path until it is there or there will be none, and hears Ctrl+C in between.
fn solve(
    py: Python<'_>,
    attempt: &mut dyn PlanAttempt,
    name: PlannerName,
    budget: Option<u64>,
) -> PyResult<Result<(), LabNoPath>> {
    let most = budget.unwrap_or(name.iterations());
    let mut is_solved = false;
    loop {
        let done = py.detach(|| {
            let begun = Instant::now();
            while begun.elapsed() < PIECE {
                let next = Bounds::of_iterations(most.min(attempt.effort().iterations.saturating_add(1)));
                if is_solved {
                    let before = attempt.effort();
                    let improved = if before.iterations >= most { Ok(()) } else { attempt.improve(&next) };
                    // one that improves nothing does nothing more
                    if improved.is_err() || attempt.effort() == before {
                        return Some(improved);
                    }
                    continue;
                }
                match attempt.solve(&next) {
                    Err(LabNoPath::Exhausted { .. }) if next.iterations < most => {}
                    Ok(()) if budget.is_some() => is_solved = true,
                    solved => return Some(solved),
                }
            }
            None
        });
        if let Some(done) = done {
            return Ok(done);
        }
        py.check_signals()?;
    }
}
