//! `Episodes`, the episodes of a learning task stepped together, from Python into arrays.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use motion_lab_core::random::Seed;
use motion_lab_sim::run::{Frame, Log};
use motion_lab_sim::tasks::{
    Autoreset, EpisodeEnd, Episodes, EpisodesError, HitchPark, LearningTask, ReachPost, RustyGoal, StepOutcome,
};

use crate::buffers::{Places, read, written};
use crate::errors::Error;
use crate::pool;
use crate::run::PyRun;

/// The most episodes that go on together.
const MOST: usize = 1 << 20;

/// From this number of episodes on a step divides them among threads.
const MANY: usize = 256;

/// What the library refuses: a large value, so it is on the heap.
pub type Refused = Box<EpisodesError>;

/// The episodes of one of the tasks.
enum AnyEpisodes {
    Rusty(Episodes<RustyGoal>),
    Hitch(Episodes<HitchPark>),
    Reach(Episodes<ReachPost>),
}

/// The same call for whichever task it is.
macro_rules! each_task {
    ($any:expr, $episodes:ident => $call:expr) => {
        match $any {
            AnyEpisodes::Rusty($episodes) => $call,
            AnyEpisodes::Hitch($episodes) => $call,
            AnyEpisodes::Reach($episodes) => $call,
        }
    };
}

impl AnyEpisodes {
    fn new(task: &str, count: usize, autoreset: Autoreset) -> PyResult<Self> {
        let seeds = || (0..count as u64).map(Seed);
        let made = match task {
            "RustyGoal" => Episodes::new(RustyGoal::new(), seeds(), autoreset).map(AnyEpisodes::Rusty),
            "HitchPark" => Episodes::new(HitchPark::new(), seeds(), autoreset).map(AnyEpisodes::Hitch),
            "ReachPost" => Episodes::new(ReachPost::new(), seeds(), autoreset).map(AnyEpisodes::Reach),
            other => {
                let words = format!("no task is named {other:?}: there are RustyGoal, HitchPark and ReachPost");
                return Err(Error::new_err(words));
            }
        };
        made.map_err(|error| refused(Box::new(error)))
    }

    fn count(&self) -> usize {
        each_task!(self, episodes => episodes.len())
    }

    fn observe(&self, observations: &mut [f32]) -> Result<(), Refused> {
        each_task!(self, episodes => episodes.observe(observations)).map_err(Box::new)
    }

    fn step(&mut self, actions: &[f32], observations: &mut [f32]) -> Result<(), Refused> {
        each_task!(self, episodes => episodes.step(actions, observations).map(|_| ())).map_err(Box::new)
    }

    fn outcomes(&self) -> &[StepOutcome] {
        each_task!(self, episodes => episodes.outcomes())
    }

    fn begin(&mut self, index: usize, seed: Option<u64>) -> Result<(), Refused> {
        let begun = each_task!(self, episodes => match seed {
            Some(seed) => episodes.begin(index, Seed(seed)),
            None => episodes.begin_next(index),
        });
        begun.map_err(Box::new)
    }

    fn final_observation(&self, index: usize) -> Option<&[f32]> {
        each_task!(self, episodes => episodes.final_observation(index))
    }

    fn frame(&self, index: usize) -> Option<Frame> {
        each_task!(self, episodes => (index < episodes.len()).then(|| episodes.frame(index)))
    }

    fn log(&self, index: usize) -> Result<Log, Refused> {
        each_task!(self, episodes => episodes.log(index)).map_err(Box::new)
    }
}

/// The episodes of a learning task, stepped together: what the environments are made of.
///
/// `task` is "RustyGoal", "HitchPark" or "ReachPost"; `count` says how many episodes go on together, and `autoreset`,
/// "NextStep", "SameStep" or "Disabled", what follows the end of one. At first episode i has the seed i.
///
/// Raises `Error` for a name that is none of these, and for more than 1,048,576 episodes.
#[pyclass(name = "Episodes", module = "motion_lab._core")]
pub struct PyEpisodes {
    episodes: AnyEpisodes,
}

impl PyEpisodes {
    /// Does work on the episodes with the interpreter's lock released, where there are many by the pool's threads.
    fn at_work<T: Send>(&mut self, py: Python<'_>, work: impl FnOnce(&mut AnyEpisodes) -> T + Send) -> PyResult<T> {
        let episodes = &mut self.episodes;
        if episodes.count() >= MANY { pool::install(py, || work(episodes)) } else { Ok(py.detach(|| work(episodes))) }
    }
}

#[pymethods]
impl PyEpisodes {
    #[new]
    fn new(py: Python<'_>, task: &str, count: usize, autoreset: &str) -> PyResult<Self> {
        let autoreset = match autoreset {
            "NextStep" => Autoreset::NextStep,
            "SameStep" => Autoreset::SameStep,
            "Disabled" => Autoreset::Disabled,
            other => {
                let words = format!("autoreset {other:?}: it is NextStep, SameStep or Disabled");
                return Err(Error::new_err(words));
            }
        };
        if count > MOST {
            return Err(Error::new_err(format!("{count} episodes: at most {MOST} go on together")));
        }
        // the first observations are made here, by all threads where there are many
        let episodes = pool::install(py, || AnyEpisodes::new(task, count, autoreset))??;
        Ok(PyEpisodes { episodes })
    }

    /// How many episodes go on together.
    #[getter]
    fn count(&self) -> usize {
        self.episodes.count()
    }

    /// How many numbers an action has, each in [-1, 1].
    #[getter]
    fn actions(&self) -> usize {
        each_task!(&self.episodes, episodes => episodes.task().setting().actions)
    }

    /// How many numbers an observation has.
    #[getter]
    fn observations(&self) -> usize {
        each_task!(&self.episodes, episodes => episodes.observations())
    }

    /// The most ticks that an episode takes; a tick is 0.05 s.
    #[getter]
    fn ticks(&self) -> u64 {
        each_task!(&self.episodes, episodes => episodes.task().setting().ticks)
    }

    /// Begin episodes anew. `seeds` holds for each of them its seed, or None for the next episode of the seed that it
    /// has; `mask` says which of them begin, by default all.
    ///
    /// Raises ValueError for another number of seeds or of flags.
    #[pyo3(signature = (seeds, mask = None))]
    fn begin(&mut self, py: Python<'_>, seeds: Vec<Option<u64>>, mask: Option<Vec<bool>>) -> PyResult<()> {
        let count = self.episodes.count();
        let mask = mask.unwrap_or_else(|| vec![true; count]);
        for (what, numbers) in [("seeds", seeds.len()), ("flags", mask.len())] {
            if numbers != count {
                return Err(PyValueError::new_err(format!("{numbers} {what} for {count} episodes")));
            }
        }
        let anew = (0..).zip(seeds).zip(mask).filter(|(_, begins)| *begins);
        let begun = py.detach(|| {
            let mut anew = anew;
            anew.try_for_each(|((index, seed), _)| self.episodes.begin(index, seed))
        });
        begun.map_err(refused)
    }

    /// Write what all observe now into a C-ordered float32 array of (count, observations).
    ///
    /// Raises ValueError for another array.
    fn observe(&mut self, py: Python<'_>, observations: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut observations = written::<f32>("observations", observations)?;
        let places = observations.places()?;
        self.at_work(py, |episodes| episodes.observe(places))?.map_err(refused)
    }

    /// Act in all of them for a tick, 0.05 s. `actions` is a C-ordered float32 array of (count, actions); what they
    /// observe then is written into `observations`, float32 of (count, observations), what they earned into `rewards`,
    /// float64, and how they ended into `terminated` and `truncated`, bool, all C-ordered. Returns whether any ended.
    ///
    /// Raises ValueError for other arrays, and `Error` for an action that is not finite or an episode that has ended
    /// and was not begun anew; nothing has changed then.
    fn step(
        &mut self,
        py: Python<'_>,
        actions: &Bound<'_, PyAny>,
        observations: &Bound<'_, PyAny>,
        rewards: &Bound<'_, PyAny>,
        terminated: &Bound<'_, PyAny>,
        truncated: &Bound<'_, PyAny>,
    ) -> PyResult<bool> {
        let actions = read::<f32>("actions", actions)?;
        let mut observations = written::<f32>("observations", observations)?;
        let mut outcomes = Outcomes::new(self.episodes.count(), rewards, terminated, truncated)?;
        let (given, places) = (actions.as_slice()?, observations.places()?);
        self.at_work(py, |episodes| episodes.step(given, places))?.map_err(refused)?;
        outcomes.write(self.episodes.outcomes())
    }

    /// Which episodes the last step ended because the robot did what it was to do.
    fn reached<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let has_reached = |outcome: &StepOutcome| outcome.end == Some(EpisodeEnd::Reached);
        PyArray1::from_iter(py, self.episodes.outcomes().iter().map(has_reached))
    }

    /// With "SameStep", what was observed at the end of an episode that the last step ended, float32; None where it
    /// ended none.
    fn final_observation<'py>(&self, py: Python<'py>, index: usize) -> Option<Bound<'py, PyArray1<f32>>> {
        self.episodes.final_observation(index).map(|numbers| PyArray1::from_slice(py, numbers))
    }

    /// The robots' configurations, float64 of (count, d): metres and radians.
    fn configurations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let of = |index| {
            let state = self.episodes.frame(index)?.robots.into_iter().next()?;
            Some(state.configuration.to_vec())
        };
        let rows: Vec<Vec<f64>> = (0..self.episodes.count()).filter_map(of).collect();
        PyArray2::from_vec2(py, &rows).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The run of an episode so far, simulated anew from its seed and its actions: it can be written, and it verifies.
    ///
    /// Raises `Error` without such an episode.
    fn episode(&mut self, py: Python<'_>, index: usize) -> PyResult<PyRun> {
        let log = py.detach(|| self.episodes.log(index)).map_err(refused)?;
        Ok(log.into())
    }
}

/// The arrays that what was earned is written into.
pub struct Outcomes<'py> {
    rewards: Places<'py, f64>,
    terminated: Places<'py, bool>,
    truncated: Places<'py, bool>,
}

impl<'py> Outcomes<'py> {
    /// Arrays of `count` places each.
    pub fn new(
        count: usize,
        rewards: &Bound<'py, PyAny>,
        terminated: &Bound<'py, PyAny>,
        truncated: &Bound<'py, PyAny>,
    ) -> PyResult<Self> {
        Ok(Outcomes {
            rewards: written("rewards", rewards)?.of("rewards", count)?,
            terminated: written("terminated", terminated)?.of("terminated", count)?,
            truncated: written("truncated", truncated)?.of("truncated", count)?,
        })
    }

    /// Writes them; returns whether any ended.
    pub fn write(&mut self, outcomes: &[StepOutcome]) -> PyResult<bool> {
        let (rewards, terminated) = (self.rewards.places()?, self.terminated.places()?);
        let places = rewards.iter_mut().zip(terminated).zip(self.truncated.places()?);
        let mut any = false;
        for (outcome, ((reward, terminated), truncated)) in outcomes.iter().zip(places) {
            *reward = outcome.reward;
            *truncated = outcome.end.is_some_and(EpisodeEnd::is_truncation);
            *terminated = outcome.end.is_some() && !*truncated;
            any |= outcome.end.is_some();
        }
        Ok(any)
    }
}

/// The error with the library's words.
pub fn refused(error: Refused) -> PyErr {
    Error::new_err(error.to_string())
}
