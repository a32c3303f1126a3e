//! `Fleet`, many rovers on their ways to goals in one run.

use std::sync::Arc;

use super::draws::{channels, first};
use super::episode::seed_of;
use super::rusty_goal::{SENSOR, distance, judge_goal, observe_goal};
use super::{EpisodeEnd, EpisodeMoment, EpisodesError, Judgement, StepOutcome};
use crate::recording::Recorder;
use crate::run::{Frame, Log, RobotInput, RobotState};
use crate::simulation::each;
use crate::tour::TourConfig;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::Rusty;
use motion_lab_core::worlds::{Resident, RoutePath, Warehouse, World};

/// The most ticks that an episode takes.
const TICKS: u64 = 600;
/// How many numbers an action has.
const ACTIONS: usize = 2;
/// How many numbers an observation has: those of `RustyGoal`.
const OBSERVATIONS: usize = SENSOR.n_rays as usize + 3;

/// The rovers of a generated warehouse, each on its way to a goal of its own, all in one run: they see each other and
/// are in each other's way.
///
/// A rover begins where the warehouse puts it. Its goal is drawn on the route that it follows there when nobody drives
/// it, 1 to 4 m away. What it observes, what its action means and what it earns is as in
/// [`RustyGoal`](super::RustyGoal). It has ended when it reached its goal, touched something, or took 600 ticks; then
/// it stands where it is. Arms and cars go about their own tours.
///
/// ```
/// use motion_lab_core::random::Seed;
/// use motion_lab_core::worlds::Warehouse;
/// use motion_lab_sim::recording::verify;
/// use motion_lab_sim::tasks::Fleet;
///
/// let mut fleet = Fleet::new(&Warehouse { seed: Seed(1), robots: 10, trailers: false }, Seed(7))?;
/// assert_eq!((fleet.len(), fleet.names().next()), (8, Some("rover 00000")));
/// let mut seen = vec![0.0; 8 * fleet.observations()];
/// let outcomes = fleet.step(&[0.5, 0.0].repeat(8), &mut seen)?;
/// assert!(outcomes.iter().all(|outcome| outcome.reward.abs() <= 0.03), "15 mm in a tick at 0.3 m/s");
/// assert_eq!(verify(&fleet.log()?, |_| {}).unwrap().identical, 1);
/// # Ok::<(), motion_lab_sim::tasks::EpisodesError>(())
/// ```
pub struct Fleet {
    config: Arc<TourConfig>,
    recorder: Recorder,
    rovers: Vec<FleetRover>,
    outcomes: Vec<StepOutcome>,
    /// The seed of all its episodes.
    own: Seed,
    /// The number of the episode, from 0.
    number: u64,
}

struct FleetRover {
    /// Its id in the run.
    id: usize,
    name: String,
    /// The route that its goals are on.
    route: RoutePath,
    goal: Point2,
    /// The configuration one tick before.
    before: Pose2,
    end: Option<EpisodeEnd>,
}

impl Fleet {
    /// The rovers of this warehouse at the start of the first episode of a seed.
    ///
    /// # Errors
    /// [`EpisodesError::Warehouse`] when the number of robots is out of range.
    pub fn new(warehouse: &Warehouse, seed: Seed) -> Result<Self, EpisodesError> {
        let world = warehouse.world()?;
        let rovers = rovers(&world);
        let config = Arc::new(TourConfig { worlds: vec![world], ticks: TICKS, sensor: Some(SENSOR) });
        let recorder = Recorder::new(Arc::clone(&config), seed_of(seed, 0))?;
        let outcomes = vec![StepOutcome::default(); rovers.len()];
        let mut fleet = Fleet { config, recorder, rovers, outcomes, own: seed, number: 0 };
        fleet.begin_number(0)?;
        Ok(fleet)
    }

    /// The number of rovers.
    pub fn len(&self) -> usize {
        self.rovers.len()
    }

    /// Whether there are none, which does not happen.
    pub fn is_empty(&self) -> bool {
        self.rovers.is_empty()
    }

    /// The rovers' names, in their order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.rovers.iter().map(|rover| rover.name.as_str())
    }

    /// The numbers in an action of one.
    pub const fn actions(&self) -> usize {
        ACTIONS
    }

    /// The numbers in an observation of one.
    pub const fn observations(&self) -> usize {
        OBSERVATIONS
    }

    /// Begins the first episode of another seed.
    ///
    /// # Errors
    /// [`EpisodesError::Run`] when the run cannot start.
    pub fn begin(&mut self, seed: Seed) -> Result<(), EpisodesError> {
        self.own = seed;
        self.begin_number(0)
    }

    /// Begins the next episode of the seed that it has.
    ///
    /// # Errors
    /// As of [`begin`](Self::begin).
    pub fn begin_next(&mut self) -> Result<(), EpisodesError> {
        self.begin_number(self.number + 1)
    }

    /// Writes what all rovers observe now, one after the other.
    ///
    /// # Errors
    /// [`EpisodesError::Count`] unless there are as many places; nothing is written then.
    pub fn observe(&self, observations: &mut [f32]) -> Result<(), EpisodesError> {
        self.check_count("places for observations", observations.len(), OBSERVATIONS)?;
        let frame = self.recorder.frame();
        each(
            self.rovers.iter().zip(observations.chunks_mut(OBSERVATIONS)),
            || (),
            |(), (rover, row)| observe_goal(&rover.goal, &rover.moment(frame, &pose(frame, rover.id)), row),
        );
        Ok(())
    }

    /// Acts in the run for a tick: the rovers' actions one after the other, each number cut to `[-1, 1]`. Those of
    /// rovers that have ended mean nothing. Writes what all observe then, and returns what each earned.
    ///
    /// # Errors
    /// [`EpisodesError`] for wrong numbers of actions or places, and for the first action that is not finite and means
    /// something; nothing has changed then. [`EpisodesError::Command`] when the script of the run is full.
    pub fn step(&mut self, actions: &[f32], observations: &mut [f32]) -> Result<&[StepOutcome], EpisodesError> {
        self.check_count("numbers in actions", actions.len(), ACTIONS)?;
        self.check_count("places for observations", observations.len(), OBSERVATIONS)?;
        let acting = || self.rovers.iter().zip(actions.chunks(ACTIONS)).enumerate();
        let is_bad =
            |(rover, action): (&FleetRover, &[f32])| rover.end.is_none() && action.iter().any(|a| !a.is_finite());
        if let Some((i, _)) = acting().find(|(_, item)| is_bad(*item)) {
            return Err(EpisodesError::NotFinite(i));
        }
        for (rover, action) in self.rovers.iter_mut().zip(actions.chunks(ACTIONS)) {
            let frame = self.recorder.frame();
            rover.before = pose(frame, rover.id);
            let cut: Vec<f32> = action.iter().map(|a| a.clamp(-1.0, 1.0)).collect();
            let input = if rover.end.is_some() { RobotInput::Drive(0, 0) } else { channels(&cut) };
            let is_held = frame.robots.get(rover.id).is_some_and(|state| holds(state, &input));
            if !is_held {
                self.recorder.input(&rover.name, input).map_err(Box::new)?;
            }
        }
        self.recorder.step();
        self.judge();
        self.observe(observations)?;
        Ok(&self.outcomes)
    }

    /// What each rover earned in the last step.
    pub fn outcomes(&self) -> &[StepOutcome] {
        &self.outcomes
    }

    /// How each rover ended; `None` for one that goes on.
    pub fn ends(&self) -> impl Iterator<Item = Option<EpisodeEnd>> {
        self.rovers.iter().map(|rover| rover.end)
    }

    /// The rovers' goals.
    pub fn goals(&self) -> impl Iterator<Item = Point2> {
        self.rovers.iter().map(|rover| rover.goal)
    }

    /// The frame of the run.
    pub fn frame(&self) -> &Frame {
        self.recorder.frame()
    }

    /// The run so far as a log, simulated anew.
    ///
    /// # Errors
    /// [`EpisodesError::Run`], which does not happen with a run of its own.
    pub fn log(&mut self) -> Result<Log, EpisodesError> {
        Ok(self.recorder.log()?)
    }

    fn begin_number(&mut self, number: u64) -> Result<(), EpisodesError> {
        let seed = seed_of(self.own, number);
        let recorder = Recorder::new(Arc::clone(&self.config), seed)?;
        (self.recorder, self.number) = (recorder, number);
        let frame = self.recorder.frame();
        let draws = Stream::new(seed, "task");
        for (i, rover) in (0..).zip(&mut self.rovers) {
            rover.before = pose(frame, rover.id);
            rover.goal = rover.draw_goal(&mut draws.at(i));
            rover.end = None;
        }
        self.outcomes.fill(StepOutcome::default());
        Ok(())
    }

    /// Judges all rovers that have not ended.
    fn judge(&mut self) {
        let frame = self.recorder.frame();
        for (rover, outcome) in self.rovers.iter_mut().zip(&mut self.outcomes) {
            *outcome = StepOutcome::default();
            if rover.end.is_some() {
                continue;
            }
            let q = pose(frame, rover.id);
            let Judgement { reward, end } = judge_goal(&rover.goal, &rover.moment(frame, &q));
            rover.end = end.or((frame.tick >= TICKS).then_some(EpisodeEnd::OutOfTime));
            *outcome = StepOutcome { reward, end: rover.end };
        }
    }

    fn check_count(&self, what: &'static str, numbers: usize, each: usize) -> Result<(), EpisodesError> {
        let (episodes, right) = (self.len(), self.len() * each);
        if numbers == right { Ok(()) } else { Err(EpisodesError::Count { what, numbers, right, each, episodes }) }
    }
}

impl FleetRover {
    /// A place on the route, 1 to 4 m away.
    fn draw_goal(&self, draws: &mut Stream) -> Point2 {
        let draw = |draws: &mut Stream| self.route.at(draws.uniform(0.0, self.route.length())).position();
        first(draws, draw, |goal| (1.0..=4.0).contains(&distance(&self.before, goal)))
    }

    fn moment<'a>(&'a self, frame: &'a Frame, q: &'a Pose2) -> EpisodeMoment<'a, Rusty> {
        // the run's sensor comes first of a robot's
        let first = frame.scans.partition_point(|scan| (scan.robot as usize) < self.id);
        let ranges = frame.scans.get(first).map_or(&[][..], |scan| &scan.ranges);
        let in_contact = frame.robots.get(self.id).is_some_and(|state| state.in_contact);
        EpisodeMoment { before: &self.before, q, ranges, in_contact }
    }
}

/// The rovers of a world that follow a route.
fn rovers(world: &World) -> Vec<FleetRover> {
    let residents = world.robots.iter().enumerate().filter(|(_, robot)| robot.kind == RobotKind::RUSTY.name);
    let on_route = |(id, robot): (usize, &Resident)| {
        let route = world.routes.iter().find(|route| Some(&route.name) == robot.route.as_ref())?.path().ok()?;
        let (goal, before) = (Point2::origin(), Pose2::IDENTITY);
        Some(FleetRover { id, name: robot.name.clone(), route, goal, before, end: None })
    };
    residents.filter_map(on_route).collect()
}

/// The pose of a rover.
fn pose(frame: &Frame, id: usize) -> Pose2 {
    let q = frame.robots.get(id).map_or(&[][..], |state| &state.configuration);
    let at = |i: usize| q.get(i).copied().unwrap_or_default();
    Pose2 { x: at(0), y: at(1), theta: at(2) }
}

/// Whether a robot is driven by this input already.
fn holds(state: &RobotState, input: &RobotInput) -> bool {
    let [a, b] = state.channels;
    state.manual && state.target.is_empty() && *input == RobotInput::Drive(a, b)
}
