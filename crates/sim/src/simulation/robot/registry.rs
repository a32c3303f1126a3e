//! `RobotKinds`, the kinds and the types of robots that an app knows.

use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::request::SpawnRequest;
use crate::simulation::truth::component_name::name_of;
use crate::simulation::truth::last_values::{FollowedValues, LastValues, follow};
use crate::simulation::truth::thing::RunThing;
use crate::simulation::{
    Configuration, Contacts, Control, Cut, DrawnTour, DriveMode, OwnState, PreviousConfiguration, ResidesIn, RobotId,
    RobotModel, RobotName, RobotOps, RobotRefusal, SimulatedRobot, Slip, SpawnError, TickMotion,
};
use crate::tour::RouteTours;
use motion_lab_core::configuration::{Kinds, RobotKind};
use motion_lab_core::geometry::Footprint;
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// Spawns one robot of a kind.
pub(crate) type Spawner = Arc<dyn Fn(&mut World, &SpawnRequest) -> Result<Entity, SpawnError> + Send + Sync>;

/// The resident that an entity of a kind is, from what a resident of its name is otherwise like, in its world with its
/// routes.
pub(crate) type Describer =
    Arc<dyn Fn(&World, Entity, Resident, (&WorldModel, &RouteTours)) -> Result<Resident, RobotRefusal> + Send + Sync>;

/// Adds a kind's plugin to an app.
pub(crate) type Adder = Arc<dyn Fn(&mut App) + Send + Sync>;

/// The kinds of robots that worlds may name.
#[derive(Resource, Clone, Default)]
pub struct RobotKinds {
    kinds: BTreeMap<String, RegisteredKind>,
    about: BTreeMap<String, &'static RobotKind>,
    /// The footprints of the kinds that are not the lab's.
    known: Kinds,
    /// The plugins by kind, in the order of registration.
    plugins: Vec<(String, Adder)>,
    /// The types of robots, in the order of registration.
    types: Vec<RobotType>,
}

/// A kind of robots.
#[derive(Clone)]
pub(crate) struct RegisteredKind {
    /// The number of its type.
    pub(crate) of_type: usize,
    pub(crate) spawn: Spawner,
    pub(crate) describe: Describer,
}

/// What the plugin of a kind registers.
pub(crate) struct KindPlugin<'a> {
    pub(crate) kind: &'a str,
    pub(crate) spawn: Spawner,
    pub(crate) describe: Describer,
    pub(crate) add: Adder,
    pub(crate) about: Option<&'static RobotKind>,
}

/// What can be done with entities of one type of robots.
#[derive(Clone, Copy)]
pub(crate) struct RobotType {
    pub(crate) id: TypeId,
    /// The entities with a model of the type.
    pub(crate) models: fn(&mut World) -> Vec<Entity>,
    /// The name of the component that makes an entity such a robot, if it has it.
    pub(crate) model_name: fn(&World, Entity) -> Option<String>,
    /// Takes the type's components off an entity.
    pub(crate) strip: fn(&mut World, Entity),
    /// Takes all components of a robot off an entity.
    pub(crate) undress: fn(&mut World, Entity),
    /// Takes what others have written into an entity of the type at tick 0.
    pub(crate) follow: fn(&mut World, Entity) -> FollowedValues,
    /// What puts the values that the simulation wrote last onto an entity.
    pub(crate) last_values: fn(&World, Entity) -> Option<ValueWriter>,
}

/// Puts values onto an entity.
pub(crate) type ValueWriter = Box<dyn FnOnce(&mut World, Entity)>;

impl RobotType {
    fn of<R: SimulatedRobot>() -> Self {
        RobotType {
            id: TypeId::of::<R>(),
            models: |world| world.query_filtered::<Entity, With<RobotModel<R>>>().iter(world).collect(),
            model_name: |world, entity| world.get::<RobotModel<R>>(entity).map(|_| name_of::<RobotModel<R>>()),
            strip: strip::<R>,
            undress: |world, entity| {
                strip::<R>(world, entity);
                if let Ok(mut robot) = world.get_entity_mut(entity) {
                    robot.remove::<(RobotId, RobotName, ResidesIn, RobotOps, Slip, RunThing)>();
                }
            },
            follow: follow::<R>,
            last_values: |world, entity| {
                let kept = world.get::<LastValues<R>>(entity)?.clone();
                Some(Box::new(move |world, entity| {
                    if let Ok(mut robot) = world.get_entity_mut(entity) {
                        robot.insert(kept.into_parts());
                    }
                }))
            },
        }
    }
}

fn strip<R: SimulatedRobot>(world: &mut World, entity: Entity) {
    if let Ok(mut robot) = world.get_entity_mut(entity) {
        robot.remove::<(RobotModel<R>, RobotValues<R>, LastValues<R>)>();
    }
}

/// The components of a robot beside its model.
type RobotValues<R> = (
    Configuration<R>,
    PreviousConfiguration<R>,
    Control<R>,
    Contacts<R>,
    DriveMode<R>,
    OwnState<R>,
    DrawnTour<R>,
    TickMotion<R>,
    Cut<R>,
);

impl RobotKinds {
    /// The names of the kinds, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.kinds.keys().map(String::as_str)
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

    /// Registers a kind of robots of type `R`, in place of an older one of its name. `footprint` is that of the kind's
    /// robots at their start coordinates. Returns the number of the type.
    pub(crate) fn register<R: SimulatedRobot>(
        &mut self,
        plugin: KindPlugin,
        footprint: impl Fn(&[f64]) -> Option<Footprint> + Send + Sync + 'static,
    ) -> usize {
        let KindPlugin { kind, spawn, describe, add, about } = plugin;
        if RobotKind::of(kind).is_none() {
            self.known = std::mem::take(&mut self.known).with_footprint(kind, footprint);
        }
        self.remember(kind, add);
        let known = self.types.iter().position(|known| known.id == TypeId::of::<R>());
        let of_type = known.unwrap_or(self.types.len());
        if known.is_none() {
            self.types.push(RobotType::of::<R>());
        }
        self.kinds.insert(kind.to_owned(), RegisteredKind { of_type, spawn, describe });
        match about {
            Some(about) => _ = self.about.insert(kind.to_owned(), about),
            None => _ = self.about.remove(kind),
        }
        of_type
    }

    fn remember(&mut self, kind: &str, add: Adder) {
        match self.plugins.iter_mut().find(|(name, _)| name == kind) {
            Some((_, older)) => *older = add,
            None => self.plugins.push((kind.to_owned(), add)),
        }
    }

    pub(crate) fn kind(&self, kind: &str) -> Option<&RegisteredKind> {
        self.kinds.get(kind)
    }

    /// The types of robots, by their numbers.
    pub(crate) fn types(&self) -> &[RobotType] {
        &self.types
    }
}
