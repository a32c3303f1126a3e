//! Makes a run at tick 0 follow its entities.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use bevy::prelude::*;

use super::foreign_change::ForeignChange;
use super::last_values::FollowedValues;
use super::lookup::{thing_name, thing_of};
use super::put_back::{put_scans_back, refuse, take_off};
use super::residents::{self, FoundRobots};
use super::robot_refusal::RobotRefusal;
use super::script_fit::{begin_with, fit};
use super::thing::RunThing;
use super::touched::{ForeignTouches, Touch, at_work};
use super::worlds::put_worlds_back;
use crate::run::RobotInput;
use crate::simulation::obstacles::dress::undress as undress_obstacle;
use crate::simulation::obstacles::start::follow_obstacles;
use crate::simulation::obstacles::sync::sync_added;
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
    let scans = put_scans_back(world);
    let mut values = follow_values(world);
    values.said.extend(scans);
    let mut touched = world.resource_mut::<ForeignTouches>();
    let is_unsettled = std::mem::take(&mut touched.is_unsettled) || values.has_moved;
    let touched = std::mem::take(&mut touched.entities);
    if !is_unsettled && values.inputs.is_empty() {
        return;
    }
    let before =
        (Arc::clone(world.resource::<RunConfig>().config()), world.resource::<PendingInput>().script().clone());
    if is_unsettled {
        let lost = put_worlds_back(world, &touched);
        follow_new_values(world, &mut values);
        at_work(world, |world| follow_entities(world, &lost));
        refuse_put_back(world, &touched, &values.said);
    }
    follow_script(world, values.inputs);
    let is_other =
        **world.resource::<RunConfig>().config() != *before.0 || *world.resource::<PendingInput>().script() != before.1;
    begin_anew(world, is_other);
}

/// What others have written into the robots.
#[derive(Default)]
struct WrittenValues {
    /// Whether a configuration or a model is another.
    has_moved: bool,
    /// The inputs that drive modes stand for, by the robot, whose name and id may change yet.
    inputs: Vec<(Entity, Vec<RobotInput>)>,
    /// What was refused, by entity and component.
    said: BTreeSet<(Entity, String)>,
}

/// Takes what others have written into the robots of the run.
fn follow_values(world: &mut World) -> WrittenValues {
    let mut values = WrittenValues::default();
    for id in 0..world.resource::<Roster>().robots.len() {
        let robot = world.resource::<Roster>().robots[id];
        let Some(RobotOps { follow, .. }) = world.get::<RobotOps>(robot).copied() else { continue };
        let followed = at_work(world, |world| follow(world, robot));
        take_values(world, robot, |world| thing_name(world, RunThing::Robot(id)), followed, &mut values);
    }
    values
}

/// Takes the drive modes of entities that are yet to become robots of the run, or robots of another type.
fn follow_new_values(world: &mut World, values: &mut WrittenValues) {
    let types = world.resource::<RobotKinds>().types().to_vec();
    for of_type in types {
        for robot in (of_type.models)(world) {
            let is_known = matches!(thing_of(world, robot), Some(RunThing::Robot(_)));
            if is_known && world.get::<RobotOps>(robot).is_some_and(|ops| ops.of_type == of_type.id) {
                continue;
            }
            let followed = at_work(world, |world| (of_type.follow)(world, robot));
            let name = |world: &World| {
                format!("robot {:?}", world.get::<RobotName>(robot).map_or("", |name| name.name.as_str()))
            };
            take_values(world, robot, name, followed, values);
        }
    }
}

fn take_values(
    world: &mut World,
    entity: Entity,
    name: impl FnOnce(&World) -> String,
    followed: FollowedValues,
    values: &mut WrittenValues,
) {
    let FollowedValues { is_moved, inputs, refused } = followed;
    values.has_moved |= is_moved;
    if !inputs.is_empty() {
        values.inputs.push((entity, inputs));
    }
    if refused.is_empty() {
        return;
    }
    values.said.extend(refused.iter().map(|component| (entity, component.clone())));
    let thing = name(world);
    let change = |component| ForeignChange { entity, thing: thing.clone(), component, is_of_run: true };
    refuse(world, refused.into_iter().map(change).collect());
}

/// Says which components of robots and sensors that are still there were put back, but for what was `said` already.
fn refuse_put_back(world: &mut World, touched: &BTreeMap<Entity, Touch>, said: &BTreeSet<(Entity, String)>) {
    for (&entity, touch) in touched.iter().filter(|(_, touch)| touch.thing.is_some()) {
        let Some(thing @ (RunThing::Robot(_) | RunThing::Sensor(_))) = thing_of(world, entity) else { continue };
        let put_back = world.resource::<ForeignTouches>().put_back_at_start(touch);
        let unsaid: Vec<String> =
            put_back.into_iter().filter(|component| !said.contains(&(entity, component.clone()))).collect();
        if unsaid.is_empty() {
            continue;
        }
        let thing = thing_name(world, thing);
        let change = |component| ForeignChange { entity, thing: thing.clone(), component, is_of_run: true };
        refuse(world, unsaid.into_iter().map(change).collect());
    }
}

/// Makes configuration and rosters those of the entities, and the components of the entities those of the
/// configuration.
fn follow_entities(world: &mut World, lost: &BTreeSet<usize>) {
    let old = Arc::clone(world.resource::<RunConfig>().config());
    let mut config = TourConfig::clone(&old);
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

/// Makes the script one that a run of the configuration holds, and that drives these robots from the start on.
fn follow_script(world: &mut World, inputs: Vec<(Entity, Vec<RobotInput>)>) {
    let config = Arc::clone(world.resource::<RunConfig>().config());
    let mut script = world.resource::<PendingInput>().script().clone();
    // a robot that is not in the run was refused
    let id_of = |robot: Entity| match thing_of(world, robot)? {
        RunThing::Robot(id) => Some(id),
        _ => None,
    };
    let by_id = inputs.into_iter().filter_map(|(robot, inputs)| Some((id_of(robot)?, inputs))).collect();
    begin_with(&mut script, &config, by_id);
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
