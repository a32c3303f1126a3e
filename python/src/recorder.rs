//! `Recorder`, a run under way.

use std::sync::{Mutex, MutexGuard};

use numpy::PyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use motion_lab_sim::recording::{FrameList, Recorder, RunError as LabRunError};
use motion_lab_sim::run::{Log, Recipe, RobotState};
use motion_lab_sim::tour::{ConfigError, MAX_TICKS, TourConfig};

use crate::errors::RunError;
use crate::frame::PyFrame;
use crate::interrupt;
use crate::natural::{natural, natural_or_none};
use crate::recording::{Settings, begin};
use crate::run::{PyRun, ranges_of, robot_of};
use crate::script::{change_of, input_of};
use crate::world::PyWorld;

/// A run under way, that goes on tick by tick, takes inputs, and goes back and ahead. Its arguments are those of
/// `record` but for `ticks` and `frames`: it ends where you stop, and it keeps frames on its way.
///
/// One call at a time: a second one meanwhile, of another thread, raises RuntimeError. Raises RunError for a run that
/// cannot start.
#[pyclass(frozen, name = "Recorder", module = "motion_lab")]
pub struct PyRecorder {
    run: Mutex<Recorder>,
}

/// The tick, if a run may reach it.
fn allowed(tick: u64) -> PyResult<u64> {
    if tick <= MAX_TICKS { Ok(tick) } else { Err(RunError::new_err(ConfigError::Ticks(tick).to_string())) }
}

/// Goes to a tick, and hears Ctrl+C on the way ahead.
fn sought(py: Python<'_>, run: &mut Recorder, tick: u64) -> PyResult<()> {
    let robots = run.frame().robots.len();
    let sought = interrupt::until(py, robots, || {
        let now = run.frame().tick;
        if now == tick {
            return Some(Ok(()));
        }
        // ahead in short pieces, between which somebody may stop it
        let to = if tick > now { tick.min(now.saturating_add(SOUGHT)) } else { tick };
        run.seek(to).err().map(Err)
    })?;
    sought.map_err(|error| RunError::new_err(error.to_string()))
}

impl PyRecorder {
    fn now(&self) -> PyResult<MutexGuard<'_, Recorder>> {
        // waiting could stop this very thread, where a signal's handler calls
        self.run.try_lock().map_err(|_| PyRuntimeError::new_err("the run is at work in another call"))
    }

    /// Looks at the state of the robot of this name.
    fn look<T>(&self, robot: &str, look: impl FnOnce(&RobotState) -> PyResult<T>) -> PyResult<T> {
        let run = self.now()?;
        let id = robot_of(run.config(), robot)?;
        let state = run.frame().robots.get(id);
        look(state.ok_or_else(|| RunError::new_err(format!("the frame has no robot {robot:?}")))?)
    }
}

#[pymethods]
impl PyRecorder {
    #[new]
    #[pyo3(signature = (worlds = None, *, seed = None, script = None, rays = None, range = None))]
    fn new(
        py: Python<'_>,
        worlds: Option<&Bound<'_, PyAny>>,
        seed: Option<&Bound<'_, PyAny>>,
        script: Option<&Bound<'_, PyAny>>,
        rays: Option<&Bound<'_, PyAny>>,
        range: Option<f64>,
    ) -> PyResult<Self> {
        let (config, input) = Settings { worlds, ticks: None, seed, script, rays, range }.read()?;
        let recipe = Recipe::new(config, input);
        Ok(PyRecorder { run: Mutex::new(begin(py, &recipe)?) })
    }

    /// The tick at which the run stands; 0 at the start. A tick is 0.05 s.
    #[getter]
    fn tick(&self) -> PyResult<u64> {
        Ok(self.now()?.frame().tick)
    }

    /// The digest of the run up to here, 32 hexadecimal digits: that of its `log()`. The run is simulated anew for it;
    /// `frame.digest`, that of the present state, costs nothing.
    #[getter]
    fn digest(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let run = self.log(py)?;
        Ok(py.detach(|| run.log.digest()).map(|digest| digest.to_string()))
    }

    /// The state of the whole run at this tick, for `restore`.
    #[getter]
    fn frame(&self) -> PyResult<PyFrame> {
        Ok(self.now()?.frame().into())
    }

    /// The names of the robots, by id.
    #[getter]
    fn robots<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let run = self.now()?;
        PyTuple::new(py, run.config().robot_names().collect::<Vec<_>>())
    }

    /// The worlds as they stand: obstacles where they are now, doors open or closed.
    #[getter]
    fn worlds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let worlds = self.now()?.standing_worlds();
        PyTuple::new(py, worlds.iter().map(|world| PyWorld::from((**world).clone())).collect::<Vec<_>>())
    }

    /// All inputs, past and still to come, as the text of a script.
    #[getter]
    fn script(&self) -> PyResult<String> {
        Ok(self.now()?.script().to_ron())
    }

    /// How many inputs and changes were refused so far, those that raised among them, and why the first was, in words:
    /// `(0, None)` if none was, which is false. Going back forgets none.
    #[getter]
    fn refusals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (count, first) = {
            let run = self.now()?;
            let refusals = run.refusals();
            (refusals.count(), refusals.first().map(ToString::to_string))
        };
        py.import("motion_lab._answers")?.getattr("Refusals")?.call1((count, first))
    }

    /// Go on by a tick, or by `n`; returns the tick then.
    ///
    /// Ctrl+C stops it within 0.1 s; the run then stands at the last tick that was finished.
    #[pyo3(signature = (n = None))]
    fn step(&self, py: Python<'_>, n: Option<&Bound<'_, PyAny>>) -> PyResult<u64> {
        let n = natural_or_none("n", n)?.unwrap_or(1);
        let mut run = self.now()?;
        let run = &mut *run;
        let until = allowed(run.frame().tick.saturating_add(n))?;
        let robots = run.frame().robots.len();
        interrupt::until(py, robots, || {
            if run.frame().tick >= until {
                return Some(run.frame().tick);
            }
            run.step();
            None
        })
    }

    /// Go to a tick, back or ahead. Going back is quick, for the run keeps frames on its way; inputs stay as they were.
    ///
    /// Ctrl+C stops the way ahead within 0.1 s.
    fn seek(&self, py: Python<'_>, tick: &Bound<'_, PyAny>) -> PyResult<()> {
        let tick = allowed(natural("tick", tick)?)?;
        let mut run = self.now()?;
        sought(py, &mut run, tick)
    }

    /// Go to the tick of a frame of this run, of `frame` or of `Run.frame`, where its state is that frame to the last
    /// bit.
    ///
    /// Raises RunError for a frame of another run, one with other settings or inputs before that tick; the run stands
    /// where it stood then. Ctrl+C stops the way ahead within 0.1 s.
    fn restore(&self, py: Python<'_>, frame: &Bound<'_, PyFrame>) -> PyResult<()> {
        let frame = &frame.get().frame;
        let mut run = self.now()?;
        let before = run.frame().tick;
        sought(py, &mut run, frame.tick)?;
        if run.frame().digest() == frame.digest() {
            return Ok(());
        }
        sought(py, &mut run, before)?;
        Err(RunError::new_err(format!("the frame of tick {} is one of another run", frame.tick)))
    }

    /// Give a robot one input, which applies before the next tick:
    ///
    /// - `drive=(speed, turn)`: hold these channels, whole numbers from -128 to 128, the robot's maximum; a rover's
    ///   speed and turn rate, a car's speed and steering angle;
    /// - `move_to=q`: go to this configuration by the end of the tick; an arm's joint angles, radians;
    /// - `teleport=q`: be put there, unless it would touch anything;
    /// - `trailer=True`: attach the car's trailer straight behind it, or with False detach it;
    /// - `release=True`: back to the tour.
    ///
    /// Metres and radians are rounded to units of 2^-20. After going back, the run goes on from here: what came after
    /// this tick is forgotten.
    ///
    /// Raises RunError for an input that the run cannot hold, as to a robot that there is not. What only the tick can
    /// refuse is counted in `refusals`.
    #[pyo3(signature = (robot, **input))]
    fn input(&self, py: Python<'_>, robot: &str, input: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let input = input_of(input)?;
        let mut run = self.now()?;
        let run = &mut *run;
        let robots = run.frame().robots.len();
        interrupt::once(py, robots, || run.input(robot, input).map_err(|error| error.to_string()))?
            .map_err(RunError::new_err)
    }

    /// Change a world before the next tick:
    ///
    /// - `close=name`, `open=name`: a door;
    /// - `remove=name`: take an obstacle away;
    /// - `move=(name, (x, y, theta))`: move one from where it was at first, metres and radians;
    /// - `add=(name, [(x, y), ..], radius)`: put a new one there, all points within a radius of the hull of some.
    ///
    /// Raises RunError for a change that the run cannot hold, and for a move or a closing that a robot is in the way
    /// of. What only the tick can refuse, as a new obstacle where a robot is, is counted in `refusals`.
    #[pyo3(signature = (world, **change))]
    fn change(&self, py: Python<'_>, world: &str, change: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let change = change_of(change)?;
        let mut run = self.now()?;
        let run = &mut *run;
        let robots = run.frame().robots.len();
        interrupt::once(py, robots, || run.change(world, change).map_err(|error| error.to_string()))?
            .map_err(RunError::new_err)
    }

    /// The configuration of a robot, metres and radians.
    fn configuration<'py>(&self, py: Python<'py>, robot: &str) -> PyResult<Bound<'py, PyTuple>> {
        self.look(robot, |state| PyTuple::new(py, state.configuration.iter().copied()))
    }

    /// Whether a robot's last tick met an obstacle, another robot or its own limit.
    fn in_contact(&self, robot: &str) -> PyResult<bool> {
        self.look(robot, |state| Ok(state.in_contact))
    }

    /// What a robot's range sensor reads here, metres, shape `(rays,)`; inf where nothing is within reach. `sensor` is
    /// its number, from 0, of a robot with several.
    #[pyo3(signature = (robot, sensor = None))]
    fn scan<'py>(
        &self,
        py: Python<'py>,
        robot: &str,
        sensor: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let sensor = natural_or_none("sensor", sensor)?.unwrap_or(0);
        let run = self.now()?;
        let id = robot_of(run.config(), robot)?;
        Ok(PyArray1::from_slice(py, ranges_of(run.frame(), id, robot, sensor)?))
    }

    /// The run up to here, with all its inputs; it verifies. The run is simulated anew for it, and stands where it
    /// stood.
    ///
    /// Ctrl+C stops it within 0.1 s.
    fn log(&self, py: Python<'_>) -> PyResult<PyRun> {
        let mut run = self.now()?;
        let run = &mut *run;
        let (ticks, robots) = (run.frame().tick, run.frame().robots.len());
        let refused = |error: LabRunError| RunError::new_err(error.to_string());
        let mut frames = FrameList::try_new(run.frame(), ticks).map_err(|error| refused(error.into()))?;
        let initial = interrupt::once(py, robots, || run.seek(0).cloned())?.map_err(refused)?;
        let gathered = interrupt::until(py, robots, || {
            if run.frame().tick >= ticks {
                return Some(Ok(()));
            }
            frames.push(run.step()).err().map(Err)
        });
        let gathered = gathered.and_then(|kept| kept.map_err(|error| refused(error.into())));
        if let Err(stopped) = gathered {
            interrupt::once(py, robots, || run.seek(ticks).map(|_| ()))?.map_err(refused)?;
            return Err(stopped);
        }
        let config = TourConfig { ticks, ..run.config().clone() };
        let recipe = Recipe::new(config, (run.transport().seed(), run.script().clone()));
        Ok(Log::with_frames(recipe, initial, frames.into_frames()).into())
    }

    fn __repr__(&self) -> PyResult<String> {
        let run = self.now()?;
        let robots: Vec<&str> = run.config().robot_names().take(8).collect();
        Ok(format!("<Recorder at tick {} of seed {}: {}>", run.frame().tick, run.transport().seed(), robots.join(", ")))
    }
}

/// The ticks of a piece of the way ahead.
const SOUGHT: u64 = 16;
