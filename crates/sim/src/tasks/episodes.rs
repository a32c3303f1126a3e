//! `Episodes`, many episodes of a task stepped together.

use super::episode::{Autoreset, Episode, seed_of};
use super::{EpisodeEnd, EpisodeMoment, EpisodeStart, EpisodesError, Judgement, LearningTask, TaskSetting};
use crate::recording::Run;
use crate::run::{Event, Frame, Log, RobotInput, Script};
use crate::simulation::{Replicas, SimulatedRobot, each};
use crate::tour::TourConfig;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::Robot;
use motion_lab_core::short_list::ShortList;
use motion_lab_core::worlds::World;

type ConfigurationOf<T> = <<T as LearningTask>::Robot as Robot>::Configuration;
type EpisodeOf<T> = Episode<<T as LearningTask>::Goal, ConfigurationOf<T>>;

/// Many episodes of a task, each a run of its own, stepped together.
///
/// Each has a seed; the runs of its episodes have the seeds that the stream `episodes` of that seed holds, so that what
/// happens in one depends on no other and on no number of threads.
///
/// ```
/// use motion_lab_core::random::Seed;
/// use motion_lab_sim::recording::verify;
/// use motion_lab_sim::tasks::{Autoreset, Episodes, RustyGoal};
///
/// let mut episodes = Episodes::new(RustyGoal::new(), (0..4).map(Seed), Autoreset::NextStep)?;
/// let mut seen = vec![0.0; 4 * episodes.observations()];
/// episodes.observe(&mut seen)?;
/// // full speed ahead
/// let outcomes = episodes.step(&[1.0, 0.0].repeat(4), &mut seen)?.to_vec();
/// assert!(outcomes.iter().all(|outcome| outcome.reward.abs() <= 0.03), "30 mm in a tick at 0.6 m/s");
/// let log = episodes.log(2)?;
/// assert_eq!(verify(&log, |_| {}).unwrap().identical, 1);
/// # Ok::<(), motion_lab_sim::tasks::EpisodesError>(())
/// ```
pub struct Episodes<T: LearningTask> {
    task: T,
    replicas: Replicas<T::Robot>,
    episodes: Vec<EpisodeOf<T>>,
    outcomes: Vec<StepOutcome>,
    /// What was observed at the end of those that began anew in the last step.
    finals: Vec<f32>,
    autoreset: Autoreset,
}

/// What a step made of an episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepOutcome {
    /// What the tick earned; 0 where the step began an episode.
    pub reward: f64,
    /// Whether the tick ended the episode, and how.
    pub end: Option<EpisodeEnd>,
}

impl<T: LearningTask> Episodes<T> {
    /// An episode for each seed, at its start.
    ///
    /// # Errors
    /// [`EpisodesError::Spawn`] where the task's run cannot start.
    pub fn new(task: T, seeds: impl IntoIterator<Item = Seed>, autoreset: Autoreset) -> Result<Self, EpisodesError> {
        let seeds: Vec<Seed> = seeds.into_iter().collect();
        let runs = seeds.iter().map(|&own| seed_of(own, 0));
        let setting = task.setting();
        let mut replicas = Replicas::new(&setting.model, &setting.world, &setting.resident, setting.sensor, runs)?;
        let mut episodes = Vec::with_capacity(seeds.len());
        for (i, &own) in seeds.iter().enumerate() {
            episodes.push(begin(&task, &mut replicas, i, own, 0)?);
        }
        let outcomes = vec![StepOutcome::default(); episodes.len()];
        let finals = match autoreset {
            Autoreset::SameStep => vec![0.0; episodes.len() * task.setting().observations],
            Autoreset::NextStep | Autoreset::Disabled => Vec::new(),
        };
        Ok(Episodes { task, replicas, episodes, outcomes, finals, autoreset })
    }

    /// The task.
    pub fn task(&self) -> &T {
        &self.task
    }

    /// The number of episodes that go on together.
    pub fn len(&self) -> usize {
        self.episodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.episodes.is_empty()
    }

    /// The numbers in an observation of one.
    pub fn observations(&self) -> usize {
        self.task.setting().observations
    }

    /// Writes what all observe now, one after the other.
    ///
    /// # Errors
    /// [`EpisodesError::Count`] unless there are as many places; nothing is written then.
    pub fn observe(&self, observations: &mut [f32]) -> Result<(), EpisodesError> {
        self.check_count("places for observations", observations.len(), self.observations())?;
        let Episodes { task, replicas, episodes, .. } = self;
        let rows = observations.chunks_mut(task.setting().observations.max(1));
        each(
            episodes.iter().zip(rows).enumerate(),
            || (),
            |(), (i, (episode, row))| {
                task.observe(&episode.goal, &moment(replicas, i, &episode.before), row);
            },
        );
        Ok(())
    }

    /// Begins one anew, with another seed for all its episodes.
    ///
    /// # Errors
    /// [`EpisodesError`] without such an episode; it stays as it is then.
    pub fn begin(&mut self, index: usize, seed: Seed) -> Result<(), EpisodesError> {
        self.check_index(index)?;
        self.episodes[index] = begin(&self.task, &mut self.replicas, index, seed, 0)?;
        self.outcomes[index] = StepOutcome::default();
        Ok(())
    }

    /// Begins the next episode of one, with the seed that it has.
    ///
    /// # Errors
    /// As of [`begin`](Self::begin).
    pub fn begin_next(&mut self, index: usize) -> Result<(), EpisodesError> {
        self.check_index(index)?;
        let Episode { own, number, .. } = self.episodes[index];
        self.episodes[index] = begin(&self.task, &mut self.replicas, index, own, number + 1)?;
        Ok(())
    }

    /// Acts in all of them for a tick: their actions one after the other, each number cut to `[-1, 1]`. Writes what
    /// they observe then, and returns what each earned.
    ///
    /// # Errors
    /// [`EpisodesError`] for wrong numbers of actions or places, for the first action that is not finite, and for the
    /// first episode that ended and was not begun anew; nothing has changed then.
    pub fn step(&mut self, actions: &[f32], observations: &mut [f32]) -> Result<&[StepOutcome], EpisodesError> {
        let width = self.task.setting().actions;
        self.check_count("numbers in actions", actions.len(), width)?;
        self.check_count("places for observations", observations.len(), self.observations())?;
        if let Some(at) = actions.iter().position(|a| !a.is_finite()) {
            return Err(EpisodesError::NotFinite(at / width.max(1)));
        }
        let ended = self.episodes.iter().position(|episode| episode.end.is_some());
        if let (Autoreset::Disabled, Some(index)) = (self.autoreset, ended) {
            return Err(EpisodesError::Ended(index));
        }
        // those that ended with the last step begin with this one
        let begins: Vec<bool> = self.episodes.iter().map(|episode| episode.end.is_some()).collect();
        for (i, _) in begins.iter().enumerate().filter(|(_, begins)| !**begins) {
            self.act(i, &actions[i * width..(i + 1) * width]);
        }
        self.replicas.step();
        for (i, _) in begins.iter().enumerate().filter(|(_, begins)| **begins) {
            self.begin_next(i)?;
        }
        self.judge(&begins);
        self.observe(observations)?;
        if self.autoreset == Autoreset::SameStep {
            self.begin_ended(observations)?;
        }
        Ok(&self.outcomes)
    }

    /// What each earned in the last step.
    pub fn outcomes(&self) -> &[StepOutcome] {
        &self.outcomes
    }

    /// With [`Autoreset::SameStep`], what was observed at the end of an episode that the last step ended; `None` where
    /// it ended none.
    pub fn final_observation(&self, index: usize) -> Option<&[f32]> {
        self.outcomes.get(index)?.end?;
        let width = self.observations();
        self.finals.get(index * width..(index + 1) * width)
    }

    /// The goal of one.
    ///
    /// # Panics
    /// Without such an episode, as the questions that follow.
    pub fn goal(&self, index: usize) -> &T::Goal {
        &self.episodes[index].goal
    }

    /// The ticks that one has taken.
    pub fn tick(&self, index: usize) -> u64 {
        self.replicas.tick(index)
    }

    /// The frame of one's run.
    pub fn frame(&self, index: usize) -> Frame {
        self.replicas.frame(index)
    }

    /// The run of one so far as a log, simulated anew from its seed and its inputs. Its last frame is
    /// [`frame`](Self::frame), from tick 1 on.
    ///
    /// # Errors
    /// [`EpisodesError`] without such an episode.
    pub fn log(&self, index: usize) -> Result<Log, EpisodesError> {
        self.check_index(index)?;
        let Episode { seed, inputs, .. } = &self.episodes[index];
        let TaskSetting { resident, world, sensor, .. } = self.task.setting();
        let robot = &resident.name;
        let event =
            |(tick, input): &(u64, RobotInput)| Event { tick: *tick, robot: robot.clone(), input: input.clone() };
        let script = Script::new(inputs.iter().map(event).collect(), Vec::new());
        let world = World { robots: vec![resident.clone()], ..world.clone() };
        let config = TourConfig { worlds: vec![world], ticks: self.tick(index), sensor: *sensor };
        Ok(Run::record(config, (*seed, script))?)
    }

    fn act(&mut self, index: usize, action: &[f32]) {
        let Episodes { task, replicas, episodes, .. } = self;
        let cut: ShortList<f32, 8> = action.iter().map(|a| a.clamp(-1.0, 1.0)).collect();
        let episode = &mut episodes[index];
        episode.before = *replicas.configuration(index);
        let input = task.input(&moment(replicas, index, &episode.before), &cut);
        let is_new = episode.add_input(replicas.tick(index) + 1, &input);
        if is_new {
            replicas.input(index, &input);
        }
    }

    /// Judges all that acted.
    fn judge(&mut self, begins: &[bool]) {
        let Episodes { task, replicas, episodes, outcomes, .. } = self;
        for (i, (episode, outcome)) in episodes.iter_mut().zip(outcomes).enumerate() {
            *outcome = StepOutcome::default();
            if begins[i] {
                continue;
            }
            let Judgement { reward, end } = task.judge(&episode.goal, &moment(replicas, i, &episode.before));
            let is_over = replicas.tick(i) >= task.setting().ticks;
            episode.end = end.or(is_over.then_some(EpisodeEnd::OutOfTime));
            *outcome = StepOutcome { reward, end: episode.end };
        }
    }

    /// Begins those anew that ended, and keeps what they observed.
    fn begin_ended(&mut self, observations: &mut [f32]) -> Result<(), EpisodesError> {
        let width = self.observations();
        for i in 0..self.len() {
            if self.episodes[i].end.is_none() {
                continue;
            }
            let row = i * width..(i + 1) * width;
            self.finals[row.clone()].copy_from_slice(&observations[row.clone()]);
            self.begin_next(i)?;
            let episode = &self.episodes[i];
            self.task.observe(&episode.goal, &moment(&self.replicas, i, &episode.before), &mut observations[row]);
        }
        Ok(())
    }

    fn check_index(&self, index: usize) -> Result<(), EpisodesError> {
        let count = self.len();
        if index < count { Ok(()) } else { Err(EpisodesError::NoEpisode { index, count }) }
    }

    fn check_count(&self, what: &'static str, numbers: usize, each: usize) -> Result<(), EpisodesError> {
        let (episodes, right) = (self.len(), self.len() * each);
        if numbers == right { Ok(()) } else { Err(EpisodesError::Count { what, numbers, right, each, episodes }) }
    }
}

/// Begins a replica's episode of this number.
fn begin<T: LearningTask>(
    task: &T,
    replicas: &mut Replicas<T::Robot>,
    index: usize,
    own: Seed,
    number: u64,
) -> Result<EpisodeOf<T>, EpisodesError> {
    let seed = seed_of(own, number);
    let EpisodeStart { inputs, goal } = task.begin(&mut Stream::new(seed, "task"));
    replicas.begin(index, seed, &inputs)?;
    let inputs = inputs.into_iter().map(|input| (1, input)).collect();
    Ok(Episode { own, number, seed, goal, inputs, before: *replicas.configuration(index), end: None })
}

fn moment<'a, R: SimulatedRobot>(
    replicas: &'a Replicas<R>,
    index: usize,
    before: &'a R::Configuration,
) -> EpisodeMoment<'a, R> {
    let in_contact = replicas.contacts(index).in_contact();
    EpisodeMoment { before, q: replicas.configuration(index), ranges: replicas.ranges(index), in_contact }
}
