//! `LearningTask`, what an episode is.

use crate::run::RobotInput;
use crate::simulation::SimulatedRobot;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::Stream;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Resident, World};

/// What an episode is: where it begins, what the robot observes, what an action means, what it earns and when it ends.
///
/// All of it is a pure function of its arguments; what is drawn comes from the stream of the episode's seed.
pub trait LearningTask: Send + Sync {
    /// The robot that acts.
    type Robot: SimulatedRobot;
    /// What one episode has to itself, such as its goal.
    type Goal: Clone + std::fmt::Debug + PartialEq + Send + Sync;

    /// What all its episodes have in common.
    fn setting(&self) -> &TaskSetting<Self::Robot>;

    /// Draws the start and the goal of an episode.
    fn begin(&self, draws: &mut Stream) -> EpisodeStart<Self::Goal>;

    /// The input that an action stands for: its numbers are finite and in `[-1, 1]`.
    fn input(&self, now: &EpisodeMoment<'_, Self::Robot>, action: &[f32]) -> RobotInput;

    /// Writes what the robot observes into as many places as its numbers are.
    fn observe(&self, goal: &Self::Goal, now: &EpisodeMoment<'_, Self::Robot>, observation: &mut [f32]);

    /// What the tick that led to `now` earns, and whether it ends the episode. That it takes too long is not asked
    /// here.
    fn judge(&self, goal: &Self::Goal, now: &EpisodeMoment<'_, Self::Robot>) -> Judgement;
}

/// What all episodes of a task have in common.
#[derive(Clone, Debug)]
pub struct TaskSetting<R> {
    /// The model of the robot's kind.
    pub model: R,
    /// The world that the robot is in, alone.
    pub world: World,
    /// The robot in it.
    pub resident: Resident,
    /// The robot's range sensor, if it has one.
    pub sensor: Option<RangeSensor>,
    /// The most ticks that an episode takes.
    pub ticks: u64,
    /// How many numbers an action has, each in `[-1, 1]`.
    pub actions: usize,
    /// How many numbers an observation has.
    pub observations: usize,
}

impl<R> TaskSetting<R> {
    /// Of the first robot of a world, or of one of this kind that has a name and no place. It has no sensor, ten
    /// seconds, two numbers in an action, and observes nothing yet.
    pub(super) fn of(world: World, model: R, kind: &RobotKind) -> Self {
        let resident =
            world.robots.first().cloned().unwrap_or_else(|| Resident::new(kind.title, kind.name, Vec::new()));
        TaskSetting { model, world, resident, sensor: None, ticks: 200, actions: 2, observations: 0 }
    }
}

/// How an episode begins.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodeStart<G> {
    /// The inputs before tick 1 that put the robot where it starts.
    pub inputs: Vec<RobotInput>,
    /// The goal.
    pub goal: G,
}

/// What a task knows of an episode at a tick.
#[derive(Debug)]
pub struct EpisodeMoment<'a, R: SimulatedRobot> {
    /// The configuration one tick before; at tick 0 the same.
    pub before: &'a R::Configuration,
    /// The configuration now.
    pub q: &'a R::Configuration,
    /// What the sensor reads now, metres: infinity where nothing is within range. Empty without a sensor.
    pub ranges: &'a [f64],
    /// Whether the robot is in contact.
    pub in_contact: bool,
}

/// What a tick earned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// The reward.
    pub reward: f64,
    /// Whether the episode ends with it, and how.
    pub end: Option<EpisodeEnd>,
}

impl Judgement {
    /// That of a tick by which the robot came nearer by so much: the goal is worth 1 more, contact 1 less, and either
    /// ends the episode.
    pub(super) fn of(nearer: f64, in_contact: bool, has_reached: bool) -> Self {
        match (in_contact, has_reached) {
            (true, _) => Judgement { reward: nearer - 1.0, end: Some(EpisodeEnd::Contact) },
            (false, true) => Judgement { reward: nearer + 1.0, end: Some(EpisodeEnd::Reached) },
            (false, false) => Judgement { reward: nearer, end: None },
        }
    }
}

/// How an episode ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EpisodeEnd {
    /// The robot has done what it was to do.
    Reached,
    /// The robot touched something.
    Contact,
    /// The episode took all its ticks. It is cut off, not ended by what the robot did.
    OutOfTime,
}

impl EpisodeEnd {
    /// Whether the episode is cut off rather than ended: what learners call truncated.
    pub const fn is_truncation(self) -> bool {
        matches!(self, EpisodeEnd::OutOfTime)
    }
}
