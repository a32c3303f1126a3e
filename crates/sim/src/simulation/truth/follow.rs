//! Makes a run at tick 0 follow its entities.

use std::collections::BTreeSet;
use std::sync::Arc;

use bevy::prelude::*;

use super::foreign_change::ForeignChange;
use super::last_values::FollowedValues;
use super::lookup::{thing_name, thing_of};
use super::put_back::{refuse, take_off};
use super::residents::{self, FoundRobots};
use super::robot_refusal::RobotRefusal;
use super::script_fit::{begin_with, fit};
use super::thing::RunThing;
use super::touched::{ForeignTouches, at_work};
use crate::run::RobotInput;
use crate::simulation::obstacles::roster::{dress_world, sync_added, undress as undress_obstacle};
use crate::simulation::obstacles::start::follow_obstacles;
use crate::simulation::robot::spawn::{RobotEntities, spawn_robots};
use crate::simulation::sensors::dress::undress as undress_sensor;
use crate::simulation::sensors::start::take_sensors;
use crate::simulation::tick::sense::sense_now;
use crate::simulation::tick::world_crowds::WorldCrowds;
use crate::simulation::{
    CommandError, CommandRefused, History, Keyframes, MountedOn, ObstacleOf, ObstacleShape, PendingInput, Refusals,
    RobotKinds, RobotName, RobotOps, Roster, RunConfig, SensorModel, Transport, state,
};
use crate::tour::TourConfig;
use motion_lab_core::worlds::Resident;

/// Makes the run follow its entities, if others have changed one. The robots keep the order of their ids, then come new
/// ones by their names; so do obstacles. What can't be in the run is refused.
pub(super) fn follow(world: &mut World) {
    let (has_moved, inputs) = follow_values(world);
    let is_unsettled = std::mem::take(&mut world.resource_mut::<ForeignTouches>().is_unsettled) || has_moved;
    let touched = std::mem::take(&mut world.resource_mut::<ForeignTouches>().entities);
    if !is_unsettled && inputs.is_empty() {
        return;
    }
    let before =
        (Arc::clone(world.resource::<RunConfig>().config()), world.resource::<PendingInput>().script().clone());
    if is_unsettled {
        let is_lost = |entity: &Entity| world.get_entity(*entity).is_err();
        let lost: BTreeSet<usize> = touched
            .iter()
            .filter(|(e, _)| is_lost(e))
            .filter_map(|(_, t)| match t.thing? {
                RunThing::World(w) => Some(w),
                _ => None,
            })
            .collect();
        let gone = touched.iter().filter_map(|(&entity, touch)| match touch.thing? {
            thing @ RunThing::World(_) => Some(ForeignChange {
                entity,
                thing: thing_name(world, thing),
                component: String::new(),
                is_of_run: true,
            }),
            _ => None,
        });
        let gone: Vec<ForeignChange> = gone.filter(|change| is_lost(&change.entity)).collect();
        refuse(world, gone);
        at_work(world, |world| follow_entities(world, &lost));
    }
    follow_script(world, inputs);
    let is_other =
        **world.resource::<RunConfig>().config() != *before.0 || *world.resource::<PendingInput>().script() != before.1;
    begin_anew(world, is_other);
}

/// Takes what others have written into the robots: whether a configuration or a model is another, and the inputs that
/// drive modes stand for.
fn follow_values(world: &mut World) -> (bool, Vec<(String, RobotInput)>) {
    let (mut has_moved, mut inputs) = (false, Vec::new());
    for id in 0..world.resource::<Roster>().robots.len() {
        let robot = world.resource::<Roster>().robots[id];
        let Some(RobotOps { follow, .. }) = world.get::<RobotOps>(robot).copied() else { continue };
        let FollowedValues { is_moved, input, refused } = follow(world, robot);
        has_moved |= is_moved;
        if let Some(input) = input {
            // by the name that it is to have
            inputs.extend(world.get::<RobotName>(robot).map(|name| (name.name.clone(), input)));
        }
        if !refused.is_empty() {
            let thing = thing_name(world, RunThing::Robot(id));
            let change = |component| ForeignChange { entity: robot, thing: thing.clone(), component, is_of_run: true };
            refuse(world, refused.into_iter().map(change).collect());
        }
    }
    (has_moved, inputs)
}

/// Makes configuration and rosters those of the entities, and the components of the entities those of the
/// configuration.
fn follow_entities(world: &mut World, lost: &BTreeSet<usize>) {
    let old = Arc::clone(world.resource::<RunConfig>().config());
    let mut config = TourConfig::clone(&old);
    lost.iter().for_each(|&w| dress_world(world, w));
    let FoundRobots { worlds: robots, refused } = residents::find(world, &old, lost);
    for refusal in &refused {
        let (entity, name, reason, stays) =
            (refusal.entity, refusal.name.clone(), Box::new(refusal.reason.clone()), refusal.stays);
        world.write_message(CommandRefused(CommandError::NoRobot { entity, name, reason, stays }));
        if !stays {
            take_off(world, entity);
        }
    }
    let entities: Vec<Vec<Option<Entity>>> =
        robots.iter().map(|robots| robots.iter().map(|robot| robot.entity).collect()).collect();
    for (model, robots) in config.worlds.iter_mut().zip(robots) {
        model.robots = robots.into_iter().map(|robot| robot.resident).collect::<Vec<Resident>>();
    }
    follow_obstacles(world, &mut config, lost);
    take_robots(world, &old, &mut config, entities);
    world.insert_resource(WorldCrowds::new(config.worlds.iter().map(|w| w.robots.len())));
    if config != *old {
        world.resource_mut::<RunConfig>().0 = Arc::new(config);
    }
    take_sensors(world);
}

/// Makes these entities the robots of the run. Where no run with all of them would start, as with too many, the run
/// keeps the robots that it had, on entities of their own.
fn take_robots(world: &mut World, old: &TourConfig, config: &mut TourConfig, entities: Vec<Vec<Option<Entity>>>) {
    let seed = world.resource::<Transport>().seed;
    let worlds = world.resource::<Roster>().worlds.clone();
    let spawn = |world: &mut World, config: &TourConfig, entities: &RobotEntities| {
        config.validate()?;
        let all: Vec<usize> = (0..config.robot_names().count()).collect();
        spawn_robots(world, (config, seed), (&worlds, entities), &all)
    };
    let entities = RobotEntities(entities);
    let spawned = spawn(world, config, &entities).or_else(|error| {
        for (entity, name) in entities.0.iter().flatten().zip(config.robot_names()) {
            let Some(entity) = *entity else { continue };
            let (name, reason) = (name.to_owned(), Box::new(RobotRefusal::Spawn(error.clone())));
            world.write_message(CommandRefused(CommandError::NoRobot { entity, name, reason, stays: false }));
            take_off(world, entity);
        }
        for (model, old) in config.worlds.iter_mut().zip(&old.worlds) {
            model.robots = old.robots.clone();
        }
        spawn(world, config, &RobotEntities::none(config))
    });
    let robots = spawned.unwrap_or_default();
    let roster = world.resource_mut::<Roster>().into_inner();
    roster.names = config.robot_names().map(str::to_owned).zip(robots.iter().copied()).collect();
    let before = std::mem::replace(&mut roster.robots, robots);
    let now: BTreeSet<Entity> = world.resource::<Roster>().robots.iter().copied().collect();
    // those that have lost what makes a robot
    let types = world.resource::<RobotKinds>().types().to_vec();
    for robot in before.into_iter().filter(|robot| !now.contains(robot)) {
        types.iter().for_each(|of_type| (of_type.undress)(world, robot));
    }
}

/// Makes the script one that a run of the configuration holds.
fn follow_script(world: &mut World, inputs: Vec<(String, RobotInput)>) {
    let config = Arc::clone(world.resource::<RunConfig>().config());
    let mut script = world.resource::<PendingInput>().script().clone();
    begin_with(&mut script, inputs);
    for error in fit(&mut script, &config) {
        world.write_message(CommandRefused(CommandError::Script(error)));
    }
    at_work(world, |world| sync_added(world, &script.changes));
    if *world.resource::<PendingInput>().script() != script {
        world.insert_resource(PendingInput::new(script));
    }
}

/// Takes frame 0 anew. What was known of another run is forgotten.
fn begin_anew(world: &mut World, is_other: bool) {
    if is_other {
        world.resource_mut::<Keyframes>().clear();
        if world.contains_resource::<History>() {
            world.insert_resource(History::default());
        }
        world.insert_resource(Refusals::default());
        world.resource_mut::<Transport>().frontier = 0;
    }
    sense_now(world);
    state::record(world);
}

/// The run leaves tick 0: what is an obstacle or a sensor of it by its components, and was not taken into it, is none
/// any more.
pub(in crate::simulation) fn leave_start(world: &mut World) {
    let obstacles = world.query_filtered::<Entity, (With<ObstacleShape>, With<ObstacleOf>)>().iter(world).collect();
    let sensors = world.query_filtered::<Entity, (With<SensorModel>, With<MountedOn>)>().iter(world).collect();
    let others = |entities: Vec<Entity>| -> Vec<Entity> {
        entities.into_iter().filter(|&entity| thing_of(world, entity).is_none()).collect()
    };
    let (obstacles, sensors) = (others(obstacles), others(sensors));
    at_work(world, |world| {
        obstacles.into_iter().for_each(|entity| undress_obstacle(world, entity));
        sensors.into_iter().for_each(|entity| undress_sensor(world, entity));
    });
}
