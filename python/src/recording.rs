//! `record`: what a run is, as Python gives it, and the run tick by tick.

use pyo3::prelude::*;
use pyo3::types::PyString;

use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;
use motion_lab_sim::recording::{FrameList, FramesError, Recorder};
use motion_lab_sim::run::{DIGEST_TICKS, Log, LogKind, Recipe, Recorded, RunDigest, RunInput, SecondDigests};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use crate::errors::RunError;
use crate::interrupt;
use crate::natural::natural_or_none;
use crate::run::PyRun;
use crate::script::script;
use crate::world::PyWorld;

/// The settings of a run as Python gives them, None for what is left out.
pub struct Settings<'a, 'py> {
    /// A world, a name or several of them.
    pub worlds: Option<&'a Bound<'py, PyAny>>,
    /// The number of ticks.
    pub ticks: Option<&'a Bound<'py, PyAny>>,
    /// The seed.
    pub seed: Option<&'a Bound<'py, PyAny>>,
    /// The inputs, as [`script`] reads them.
    pub script: Option<&'a Bound<'py, PyAny>>,
    /// The number of rays of a rover's sensor; 0 for none.
    pub rays: Option<&'a Bound<'py, PyAny>>,
    /// The sensor's reach, metres.
    pub range: Option<f64>,
}

impl Settings<'_, '_> {
    /// The configuration and the input of the run: the tour with what is given.
    ///
    /// # Errors
    /// `WorldError` for a world that there is not, `RunError` for a script that is refused, `ValueError` for a number
    /// that cannot be; the run itself checks all else.
    pub fn read(self) -> PyResult<(TourConfig, RunInput)> {
        let usual = TourConfig::default();
        let worlds = match self.worlds.filter(|worlds| !worlds.is_none()) {
            None => usual.worlds,
            Some(one) if one.is_instance_of::<PyWorld>() || one.is_instance_of::<PyString>() => vec![world_of(one)?],
            Some(several) => several.try_iter()?.map(|world| world_of(&world?)).collect::<PyResult<_>>()?,
        };
        let ticks = natural_or_none("ticks", self.ticks)?.unwrap_or(usual.ticks);
        let rays = natural_or_none("rays", self.rays)?;
        let sensor = match (rays, usual.sensor) {
            (Some(0), _) | (None, None) => None,
            (rays, usual) => {
                let RangeSensor { n_rays, max_range } = usual.unwrap_or(RangeSensor { n_rays: 1, max_range: 1.0 });
                // the library refuses the largest number
                let n_rays = rays.map_or(n_rays, |rays| u32::try_from(rays).unwrap_or(u32::MAX));
                Some(RangeSensor { n_rays, max_range: self.range.unwrap_or(max_range) })
            }
        };
        let seed = natural_or_none("seed", self.seed)?.map_or(BOOK_SEED, Seed);
        Ok((TourConfig { worlds, ticks, sensor }, (seed, script(self.script)?).into()))
    }
}

fn world_of(given: &Bound<'_, PyAny>) -> PyResult<World> {
    Ok((*PyWorld::of(given)?.get().world).clone())
}

/// Record a run: the 60 s tour of the three built-in worlds, or `worlds`, a `World`, the name of one or several of
/// them, for `ticks` of 0.05 s, 1200. `seed`, 2005, is what its noise and its tours follow from.
///
/// `script` has the inputs: the text of a script, the path of its file, or a list of `(tick, name, input)`, as
/// `(1, "Rusty", {"drive": (128, 0)})` or `(20, "Apartment", {"close": "door A"})`, with the inputs of
/// `Recorder.input` and the changes of `Recorder.change`. What a robot or a world refuses at its tick is counted there
/// and changes nothing.
///
/// Every rover has a range sensor of `rays` rays, 360, that reach `range` metres, 4; with 0 rays none. `frames` says
/// whether every frame is kept, or a digest of each second; if left out, frames for at most 100 robots.
///
/// The digest is that of `motion-lab record` with the same settings. Raises RunError for a run that cannot start, and
/// for one whose frames would take more than 4 GiB; Ctrl+C stops it within 0.1 s.
#[pyfunction]
#[pyo3(signature = (worlds = None, ticks = None, *, seed = None, script = None, rays = None, range = None,
    frames = None))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub fn record(
    py: Python<'_>,
    worlds: Option<&Bound<'_, PyAny>>,
    ticks: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    script: Option<&Bound<'_, PyAny>>,
    rays: Option<&Bound<'_, PyAny>>,
    range: Option<f64>,
    frames: Option<bool>,
) -> PyResult<PyRun> {
    let settings = Settings { worlds, ticks, seed, script, rays, range };
    let (config, input) = settings.read()?;
    let kind = match frames {
        None => LogKind::usual(&config),
        Some(true) => LogKind::Frames,
        Some(false) => LogKind::Digests,
    };
    recorded(py, Recipe::new(config, input), kind)
}

/// The run of a recipe, tick by tick, until Ctrl+C.
///
/// # Errors
/// `RunError` for one that cannot start or whose frames take too much memory, `KeyboardInterrupt`.
pub fn recorded(py: Python<'_>, recipe: Recipe, kind: LogKind) -> PyResult<PyRun> {
    let mut recorder = begin(py, &recipe)?.without_keyframes();
    let recipe = Recipe { config: recorder.shared_config(), ..recipe };
    let (ticks, robots) = (recipe.config.ticks, recorder.frame().robots.len());
    let initial = recorder.frame().clone();
    let too_many = |error: FramesError| RunError::new_err(error.to_string());
    let kept = if kind == LogKind::Frames { ticks } else { 0 };
    let mut frames = FrameList::try_new(&initial, kept).map_err(too_many)?;
    let mut run = RunDigest::new(&recipe, &initial);
    let (start, mut digests) = (run.lower_half(), Vec::new());
    let recorded = interrupt::until(py, robots, || {
        let now = recorder.frame().tick;
        if now >= ticks {
            return Some(Ok(()));
        }
        let frame = recorder.step();
        if kind == LogKind::Frames {
            if let Err(error) = frames.push(frame) {
                return Some(Err(error));
            }
        } else {
            run.tick(frame);
            if frame.tick == ticks || frame.tick.is_multiple_of(DIGEST_TICKS) {
                digests.push(run.lower_half());
            }
        }
        None
    })?;
    recorded.map_err(too_many)?;
    let recorded = match kind {
        LogKind::Frames => Recorded::Frames { initial, frames: frames.into_frames() },
        LogKind::Digests => Recorded::Digests(SecondDigests { start, digests, ticks, whole: Some(run.digest()) }),
    };
    Ok(Log { recipe, recorded }.into())
}

/// A run at tick 0, whose script names only robots that there are.
///
/// # Errors
/// `RunError` in the library's words.
pub fn begin(py: Python<'_>, recipe: &Recipe) -> PyResult<Recorder> {
    let robots = recipe.config.robot_names().count();
    interrupt::once(py, robots, || Recorder::of(recipe))?.map_err(|error| RunError::new_err(error.to_string()))
}
