//! `RobotPlugin`, one kind of robot in the simulation.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::spawn::{SpawnRequest, spawn_robot};
use crate::simulation::schedule::{CrowdSystems, KindSystems, TickPhase};
use crate::simulation::tick::{drive, settle};
use crate::simulation::{RobotOps, SimulatedRobot, SimulationSchedule, SimulationSystems, SpawnError, state};
use motion_lab_core::configuration::{Configuration as _, Kinds, RobotKind};
use motion_lab_core::geometry::Footprint;

/// Registers robots of type `R` with the simulation under the name of a kind. Worlds name the kind in their residents.
/// Add it after [`SimulationPlugin`](crate::simulation::SimulationPlugin) and before a run starts.
///
/// `SimulationPlugin` registers the kinds `rusty`, `reach`, `reach3` and `hitch`. A kind registered again replaces the
/// older one.
#[derive(Clone, Debug)]
pub struct RobotPlugin<R: SimulatedRobot> {
    kind: String,
    model: R,
    about: Option<&'static RobotKind>,
}

impl<R: SimulatedRobot> RobotPlugin<R> {
    /// A plugin whose robots of kind `kind` are copies of `model`.
    pub fn new(kind: impl Into<String>, model: R) -> Self {
        let kind = kind.into();
        RobotPlugin { about: RobotKind::of(&kind), kind, model }
    }

    /// Describes the kind to figures, plots and the window: its coordinates, its spaces and whether it drives. Without
    /// a description they show a robot of a program's own kind by its footprint and its readout alone.
    #[must_use]
    pub fn described(self, about: &'static RobotKind) -> Self {
        RobotPlugin { about: Some(about), ..self }
    }
}

/// Spawns one robot of a kind.
type Spawner = Arc<dyn Fn(&mut World, &SpawnRequest) -> Result<Entity, SpawnError> + Send + Sync>;

/// Adds a kind's plugin to an app.
type Adder = Arc<dyn Fn(&mut App) + Send + Sync>;

/// The kinds of robots that worlds may name.
#[derive(Resource, Clone, Default)]
pub struct RobotKinds {
    spawners: BTreeMap<String, Spawner>,
    about: BTreeMap<String, &'static RobotKind>,
    /// The footprints of the kinds that are not the lab's.
    known: Kinds,
    /// The plugins by kind, in the order of registration.
    plugins: Vec<(String, Adder)>,
    types: usize,
}

impl RobotKinds {
    /// The names of the kinds, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.spawners.keys().map(String::as_str)
    }

    /// The description of a kind, if it has one.
    pub fn about(&self, kind: &str) -> Option<&'static RobotKind> {
        self.about.get(kind).copied()
    }

    /// What is known of the kinds, for what has no simulator: descriptions and, of a program's own kinds, footprints.
    /// The atlas and a run's last lines use them.
    pub fn known(&self) -> Kinds {
        self.about.iter().fold(self.known.clone(), |kinds, (name, about)| kinds.with(name.as_str(), about))
    }

    /// Registers the same kinds in another app, which has the
    /// [`SimulationPlugin`](crate::simulation::SimulationPlugin). A window hands its kinds on so to what records and
    /// draws its runs.
    ///
    /// ```
    /// use motion_lab_sim::recording::Run;
    /// use motion_lab_sim::simulation::{RobotKinds, headless_app};
    /// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
    ///
    /// let app = headless_app(); // with plugins of your own
    /// let kinds = app.world().resource::<RobotKinds>();
    /// let config = TourConfig { ticks: 5, ..TourConfig::default() };
    /// let log = Run::record_with_robots(config, BOOK_SEED, |recorder| kinds.add_to(recorder))?;
    /// assert_eq!(log.frames().len(), 5);
    /// # Ok::<(), motion_lab_sim::recording::RunError>(())
    /// ```
    pub fn add_to(&self, app: &mut App) {
        self.plugins.iter().for_each(|(_, add)| add(app));
    }

    fn remember(&mut self, kind: &str, add: Adder) {
        match self.plugins.iter_mut().find(|(name, _)| name == kind) {
            Some((_, older)) => *older = add,
            None => self.plugins.push((kind.to_owned(), add)),
        }
    }

    pub(crate) fn spawner(&self, kind: &str) -> Option<Spawner> {
        self.spawners.get(kind).cloned()
    }
}

/// The place of the systems of `R` among those of all types, and whether they are in the schedule.
#[derive(Resource)]
struct SystemsOf<R> {
    number: usize,
    installed: bool,
    of: std::marker::PhantomData<fn() -> R>,
}

/// Adds the systems of `R` to the schedule, once. This waits for the first such robot, so that a tick does not pay for
/// types without robots.
fn install<R: SimulatedRobot>(world: &mut World) {
    let Some(mut systems) = world.get_resource_mut::<SystemsOf<R>>() else { return };
    if std::mem::replace(&mut systems.installed, true) {
        return;
    }
    let number = systems.number;
    world.resource_mut::<Schedules>().add_systems(
        SimulationSchedule,
        (
            drive::drive::<R>.in_set(KindSystems::Drive(number)).in_set(SimulationSystems::Drive),
            drive::plan::<R>.in_set(KindSystems::Plan(number)).in_set(TickPhase::Plan),
            settle::cut::<R>.in_set(KindSystems::Cut(number)).in_set(TickPhase::Cut),
            settle::settle::<R>.in_set(KindSystems::Settle(number)).in_set(TickPhase::Settle),
            state::encode::<R>.in_set(KindSystems::Encode(number)).in_set(TickPhase::Encode).in_set(CrowdSystems),
        ),
    );
}

/// The footprint of a robot at these start coordinates; `None` where a run would not start.
fn footprint<R: SimulatedRobot>(model: &R, start: &[f64]) -> Option<Footprint> {
    let q = model.configuration_at(&R::Configuration::from_coordinates(start)?, start)?;
    let robot = model.fitted(&q);
    robot.check(&q).ok()?;
    Some(robot.footprint(&q))
}

impl<R: SimulatedRobot> Plugin for RobotPlugin<R> {
    fn build(&self, app: &mut App) {
        let model = self.model.clone();
        let ops = RobotOps::of::<R>();
        let spawner: Spawner = Arc::new(move |world, request| {
            install::<R>(world);
            spawn_robot(world, &model, ops, request)
        });
        let plugin = self.clone();
        let mut kinds = app.world_mut().get_resource_or_init::<RobotKinds>();
        if RobotKind::of(&self.kind).is_none() {
            let model = self.model.clone();
            let known = std::mem::take(&mut kinds.known);
            kinds.known = known.with_footprint(&self.kind, move |start| footprint(&model, start));
        }
        kinds.remember(&self.kind, Arc::new(move |app: &mut App| _ = app.add_plugins(plugin.clone())));
        kinds.spawners.insert(self.kind.clone(), spawner);
        match self.about {
            Some(about) => _ = kinds.about.insert(self.kind.clone(), about),
            None => _ = kinds.about.remove(&self.kind),
        }
        let number = kinds.types;
        if app.world().contains_resource::<SystemsOf<R>>() {
            return;
        }
        app.world_mut().resource_mut::<RobotKinds>().types += 1;
        app.insert_resource(SystemsOf::<R> { number, installed: false, of: std::marker::PhantomData });
        let sets = [KindSystems::Drive, KindSystems::Plan, KindSystems::Cut, KindSystems::Settle, KindSystems::Encode];
        for set in sets {
            if let Some(before) = number.checked_sub(1) {
                app.configure_sets(SimulationSchedule, set(number).after(set(before)));
            }
        }
    }

    fn name(&self) -> &str {
        &self.kind
    }

    /// A kind may be registered again.
    fn is_unique(&self) -> bool {
        false
    }
}
