//! `RobotPlugin`, one kind of robot in the simulation.

use std::sync::Arc;

use bevy::prelude::*;

use super::describe::describe;
use super::registry::{KindPlugin, RobotKinds, Spawner};
use super::spawn::spawn_robot;
use crate::simulation::schedule::{KindSystems, TickPhase};
use crate::simulation::state::StateTakers;
use crate::simulation::tick::{drive, settle};
use crate::simulation::truth::last_values::LastValues;
use crate::simulation::truth::touched::AtStart::{Followed, Model, WithModel};
use crate::simulation::truth::watch::{watch as watch_unnamed, watch_components};
use crate::simulation::{
    Configuration, Contacts, Control, Cut, DrawnTour, DriveMode, OwnState, PreviousConfiguration, RobotModel, RobotOps,
    SimulatedRobot, SimulationSchedule, SimulationSystems, TickMotion,
};
use motion_lab_core::configuration::{Configuration as _, RobotKind};
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

/// Watches the components of a type of robots.
fn watch<R: SimulatedRobot>(world: &mut World) {
    watch_components!(world, Followed, Configuration<R>, DriveMode<R>);
    watch_components!(world, WithModel, PreviousConfiguration<R>, Control<R>, Contacts<R>, OwnState<R>);
    watch_components!(world, WithModel, DrawnTour<R>, TickMotion<R>, Cut<R>);
    let kept = world.register_component::<LastValues<R>>();
    watch_unnamed(world, &[kept]);
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
    watch::<R>(world);
    StateTakers::add::<R>(world);
    world.resource_mut::<Schedules>().add_systems(
        SimulationSchedule,
        (
            drive::drive::<R>.in_set(KindSystems::Drive(number)).in_set(SimulationSystems::Drive),
            drive::plan::<R>.in_set(KindSystems::Plan(number)).in_set(TickPhase::Plan),
            settle::cut::<R>.in_set(KindSystems::Cut(number)).in_set(TickPhase::Cut),
            settle::settle::<R>.in_set(KindSystems::Settle(number)).in_set(TickPhase::Settle),
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
        let spawn: Spawner = Arc::new(move |world, request| {
            install::<R>(world);
            spawn_robot(world, &model, ops, request)
        });
        let model = self.model.clone();
        let describe =
            Arc::new(move |world: &World, entity, base, at: (&_, &_)| describe(world, entity, &model, base, at));
        let plugin = self.clone();
        let add = Arc::new(move |app: &mut App| _ = app.add_plugins(plugin.clone()));
        let model = self.model.clone();
        let known = move |start: &[f64]| footprint(&model, start);
        let mut kinds = app.world_mut().get_resource_or_init::<RobotKinds>();
        let kind = KindPlugin { kind: &self.kind, spawn, describe, add, about: self.about };
        let number = kinds.register::<R>(kind, known);
        if app.world().contains_resource::<SystemsOf<R>>() {
            return;
        }
        watch_components!(app.world_mut(), Model, RobotModel<R>);
        app.insert_resource(SystemsOf::<R> { number, installed: false, of: std::marker::PhantomData });
        let sets = [KindSystems::Drive, KindSystems::Plan, KindSystems::Cut, KindSystems::Settle];
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
