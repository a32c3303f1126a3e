//! `Recorder`, a run without a window, tick by tick.

use std::sync::Arc;

use bevy::app::App;
use bevy::ecs::world::World;

use super::frame_list::{FrameList, FramesError};
use crate::run::{Event, Frame, Log, Recipe, RobotInput, RunInput, Script, WorldChange};
use crate::simulation::{
    CommandError, Keyframes, Later, LatestFrame, PendingInput, PhaseState, PhaseStates, Refusals, RestoreError,
    RobotCommand, RobotView, Roster, RunConfig, SensorView, SimulationPlugin, SpawnError, StandingWorld, Transport,
    WorldCommand, give_change, give_input, restore, seek, sensors, start_recipe, step_alone, view,
};
use crate::tour::TourConfig;
use motion_lab_core::worlds::World as WorldModel;

/// Why a run cannot be recorded or replayed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The run cannot start.
    #[error(transparent)]
    Spawn(#[from] SpawnError),
    /// A frame does not fit the run.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// Frames that take too much memory.
    #[error(transparent)]
    Frames(#[from] FramesError),
}

/// A run under way without a window: the same plugin and the same schedule as with one, run directly.
///
/// It shares nothing with other recorders: each may run on a thread of its own.
pub struct Recorder {
    world: World,
    ticks: u64,
}

impl Recorder {
    /// The run at tick 0.
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn new(config: impl Into<Arc<TourConfig>>, input: impl Into<RunInput>) -> Result<Self, RunError> {
        Self::with_robots(config, input, |_| {})
    }

    /// The run at tick 0 in an app that `add` has added further kinds of robots to, by
    /// [`RobotPlugin`](crate::simulation::RobotPlugin).
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn with_robots(
        config: impl Into<Arc<TourConfig>>,
        input: impl Into<RunInput>,
        add: impl FnOnce(&mut App),
    ) -> Result<Self, RunError> {
        Self::of_with_robots(&Recipe::new(config, input), add)
    }

    /// The run of a recipe at tick 0.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of(recipe: &Recipe) -> Result<Self, RunError> {
        Self::of_with_robots(recipe, |_| {})
    }

    /// The run of a recipe at tick 0, as [`with_robots`](Self::with_robots).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_with_robots(recipe: &Recipe, add: impl FnOnce(&mut App)) -> Result<Self, RunError> {
        let mut app = App::new();
        app.add_plugins(SimulationPlugin);
        add(&mut app);
        let mut world = std::mem::take(app.world_mut());
        start_recipe(&mut world, recipe.clone())?;
        Ok(Recorder { world, ticks: recipe.config.ticks })
    }

    /// The same run with no keyframe but that of tick 0: however long it goes on, it takes the same memory. Moving it
    /// back simulates from tick 0.
    #[must_use]
    pub fn without_keyframes(mut self) -> Self {
        self.world.resource_mut::<Keyframes>().set_budget(0);
        self
    }

    /// The run's configuration. It says the sensors and the obstacles that the run has, whoever spawned, changed or
    /// removed them before its first tick.
    pub fn config(&self) -> &TourConfig {
        self.world.resource::<RunConfig>().config()
    }

    /// The same, shared.
    pub fn shared_config(&self) -> Arc<TourConfig> {
        Arc::clone(self.world.resource::<RunConfig>().config())
    }

    /// The frame of the last tick; at first the frame of tick 0.
    pub fn frame(&self) -> &Frame {
        self.world.resource::<LatestFrame>().frame()
    }

    /// Whether the run has reached its configuration's number of ticks. It can go on.
    pub fn is_complete(&self) -> bool {
        self.frame().tick >= self.ticks
    }

    /// Runs one tick and returns its frame.
    pub fn step(&mut self) -> &Frame {
        step_alone(&mut self.world);
        self.frame()
    }

    /// Gives a robot an input. It applies before the next tick, after what the script has for it, and the script holds
    /// it from now on. Where the run was moved back, it goes on from here: what came after this tick is forgotten.
    ///
    /// What only the tick can refuse, such as a teleport onto an obstacle, is counted there
    /// ([`refusals`](Self::refusals)).
    ///
    /// ```
    /// use motion_lab_sim::recording::{Recorder, verify};
    /// use motion_lab_sim::run::RobotInput;
    /// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
    ///
    /// let mut live = Recorder::new(TourConfig::default(), BOOK_SEED)?;
    /// live.input("Rusty", RobotInput::Drive(128, 0)).unwrap();
    /// (0..20).for_each(|_| _ = live.step());
    /// let log = live.log()?;
    /// assert!(log.recipe.script.events[0].tick == 1 && log.ticks() == 20);
    /// assert_eq!(verify(&log, |_| {})?.identical, 20);
    /// # Ok::<(), motion_lab_sim::recording::RunError>(())
    /// ```
    ///
    /// # Errors
    /// [`CommandError::Script`] for an input that no script could hold: an unknown robot, a channel out of range. It is
    /// counted and changes nothing.
    pub fn input(&mut self, robot: &str, input: RobotInput) -> Result<(), CommandError> {
        give_input(&mut self.world, RobotCommand { robot: robot.to_owned(), input }, Later::Kept)
    }

    /// Gives a robot an input at the next tick in place of all that the script has for it from there on. What others
    /// get stays. For branches of a run, which are no part of what it has recorded.
    pub(crate) fn input_instead(&mut self, robot: &str, input: RobotInput) {
        let tick = self.frame().tick + 1;
        self.world.resource_mut::<PendingInput>().instead(Event { tick, robot: robot.to_owned(), input });
    }

    /// Changes a world before the next tick, as [`input`](Self::input).
    ///
    /// # Errors
    /// [`CommandError`] for a change that no script could hold, or that would be refused now: a robot is in the way.
    pub fn change(&mut self, world: &str, change: WorldChange) -> Result<(), CommandError> {
        give_change(&mut self.world, WorldCommand { world: world.to_owned(), change }, Later::Kept)
    }

    /// The run up to the present tick as a log with all its inputs, which verifies. The run is simulated anew for it
    /// and stands where it stood.
    ///
    /// # Errors
    /// [`RunError::Frames`] of a run that is too long for it. [`RunError::Restore`], which cannot happen with the run's
    /// own keyframes.
    pub fn log(&mut self) -> Result<Log, RunError> {
        let ticks = self.frame().tick;
        FrameList::try_new(self.frame(), ticks)?;
        let initial = self.seek(0)?.clone();
        let frames = self.frames(ticks);
        if frames.is_err() {
            self.seek(ticks)?;
        }
        let frames = frames?;
        let config = Arc::new(TourConfig { ticks, ..self.config().clone() });
        let recipe = Recipe { seed: self.transport().seed, config, script: self.script().clone() };
        Ok(Log::with_frames(recipe, initial, frames))
    }

    /// Runs this many ticks and returns their frames.
    ///
    /// # Errors
    /// [`RunError::Frames`] where they are too many to be kept.
    pub(super) fn frames(&mut self, ticks: u64) -> Result<Vec<Frame>, RunError> {
        let mut kept = FrameList::try_new(self.frame(), ticks)?;
        for _ in 0..ticks {
            kept.push(self.step())?;
        }
        Ok(kept.into_frames())
    }

    /// Moves to a tick, back or ahead, and returns its frame.
    ///
    /// # Errors
    /// [`RunError::Restore`], which cannot happen with the run's own keyframes.
    pub fn seek(&mut self, tick: u64) -> Result<&Frame, RunError> {
        seek(&mut self.world, tick)?;
        Ok(self.frame())
    }

    /// Goes on from a frame of this run.
    ///
    /// # Errors
    /// [`RunError::Restore`] when the frame is not one of this run.
    pub fn restore(&mut self, frame: &Frame) -> Result<(), RunError> {
        Ok(restore(&mut self.world, frame)?)
    }

    /// The robots as a view shows them.
    pub fn view(&self) -> Vec<RobotView> {
        view(&self.world)
    }

    /// The sensors as a view shows them: one for each scan of the frame, in the same order.
    pub fn sensors(&self) -> Vec<SensorView> {
        sensors(&self.world)
    }

    /// The inputs of the script that were refused so far, to robots and to worlds: how many, and why the first.
    ///
    /// ```
    /// use motion_lab_core::configuration::T2;
    /// use motion_lab_sim::recording::Recorder;
    /// use motion_lab_sim::run::Script;
    /// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
    ///
    /// let script = Script::of_moves("Hitch", [T2::new(0.0, 0.0), T2::new(0.0, 0.1)]).unwrap();
    /// let mut run = Recorder::new(TourConfig::default(), (BOOK_SEED, script))?;
    /// run.seek(2)?;
    /// let first = run.refusals().first().unwrap();
    /// assert_eq!(run.refusals().count(), 2);
    /// assert!(first.to_string().starts_with("tick 1: robot \"Hitch\" refused MoveTo: "));
    /// # Ok::<(), motion_lab_sim::recording::RunError>(())
    /// ```
    pub fn refusals(&self) -> &Refusals {
        self.world.resource::<Refusals>()
    }

    /// The tick at which the run stands, and how it plays.
    pub fn transport(&self) -> &Transport {
        self.world.resource::<Transport>()
    }

    /// The run's script: all its inputs and changes, past and still to come, in order of their ticks.
    pub fn script(&self) -> &Script {
        self.world.resource::<PendingInput>().script()
    }

    /// The run's worlds as they stand, in order: obstacles where they are now, doors open or closed. A world that has
    /// not changed from one tick to the next is the same `Arc`.
    pub fn standing_worlds(&self) -> Vec<Arc<WorldModel>> {
        let worlds = self.world.get_resource::<Roster>().map_or(&[][..], Roster::worlds);
        worlds.iter().filter_map(|&w| Some(Arc::clone(&self.world.get::<StandingWorld>(w)?.0))).collect()
    }

    /// What stood after the phases of the last tick, of a run that keeps it.
    pub(super) fn take_phases(&mut self) -> Vec<PhaseState> {
        self.world.get_resource_mut::<PhaseStates>().map_or_else(Vec::new, |mut kept| std::mem::take(&mut kept.0))
    }

    /// The Bevy world that the run lives in.
    pub fn world(&self) -> &World {
        &self.world
    }
}
