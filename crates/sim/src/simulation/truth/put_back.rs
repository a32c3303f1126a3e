//! Puts back what others have changed of a run under way, and says so.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::component_name::name_of;
use super::foreign_change::ForeignChange;
use super::lookup::{shape_name, thing_name, thing_of, world_number};
use super::thing::RunThing;
use super::touched::{ForeignTouches, Touch, at_work};
use crate::simulation::obstacles::dress as obstacles;
use crate::simulation::robot::spawn::respawn;
use crate::simulation::sensors::dress as sensors;
use crate::simulation::{
    CommandError, CommandRefused, LatestFrame, MountedOn, ObstacleOf, ObstacleShape, ResidesIn, RobotKinds, RobotOps,
    Roster, Scan, SensorModel, SensorName, SensorRoster, WorldScene,
};

/// Puts back the components that were inserted, replaced or removed, and the entities that were despawned. An entity
/// that became an obstacle, a sensor or a robot in a run loses its components of the run.
pub(crate) fn put_back(world: &mut World) {
    let all = std::mem::take(&mut world.resource_mut::<ForeignTouches>().entities);
    let (fresh, touched): (BTreeMap<_, _>, BTreeMap<_, _>) = all.into_iter().partition(|(_, touch)| touch.is_fresh);
    world.resource_mut::<ForeignTouches>().entities = fresh;
    if touched.is_empty() {
        return;
    }
    let mut touched: Vec<(Entity, Touch)> = touched.into_iter().collect();
    // worlds before robots before obstacles before sensors, which refer to those before them
    touched.sort_by_key(|(entity, touch)| (touch.thing.is_none(), touch.thing, *entity));
    let mut changes = Vec::new();
    at_work(world, |world| {
        for (entity, touch) in &touched {
            changes.extend(match touch.thing {
                Some(thing) => put_thing_back(world, *entity, thing, touch),
                None => take_off(world, *entity),
            });
        }
    });
    refuse(world, changes);
}

/// Puts back a thing of the run.
pub(super) fn put_thing_back(world: &mut World, entity: Entity, thing: RunThing, touch: &Touch) -> Vec<ForeignChange> {
    let name = thing_name(world, thing);
    let change = |component: &str| ForeignChange {
        entity,
        thing: name.clone(),
        component: component.to_owned(),
        is_of_run: true,
    };
    let changes = if world.get_entity(entity).is_err() {
        vec![change("")]
    } else {
        let touched = world.resource::<ForeignTouches>();
        touch.components.iter().map(|&component| change(touched.name(component))).collect()
    };
    dress(world, thing);
    changes
}

/// Gives a thing of the run the entity and the components that the run has for it.
fn dress(world: &mut World, thing: RunThing) {
    match thing {
        RunThing::World(w) => obstacles::dress_world(world, w),
        RunThing::Robot(id) => respawn(world, id),
        RunThing::Obstacle(w, number) => obstacles::dress_obstacle(world, w, number),
        RunThing::Sensor(k) => sensors::dress_sensor(world, k),
    }
}

/// Takes the run's components off an entity that is not the run's, where they make it an obstacle, a sensor or a robot.
pub(super) fn take_off(world: &mut World, entity: Entity) -> Vec<ForeignChange> {
    let mut changes = Vec::new();
    let change = |thing: String, component: &str| ForeignChange {
        entity,
        thing,
        component: component.to_owned(),
        is_of_run: false,
    };
    let Ok(found) = world.get_entity(entity) else { return changes };
    let resides = |of: Option<Entity>| of.is_some_and(|of| world_number(world, of).is_some());
    let is_obstacle = found.contains::<ObstacleShape>() && resides(found.get::<ObstacleOf>().map(|of| of.0));
    let is_mounted = found.get::<MountedOn>().is_some_and(|on| thing_of(world, on.0).is_some());
    let is_sensor = found.contains::<SensorModel>() && is_mounted;
    if is_obstacle {
        changes.push(change(format!("obstacle {:?}", shape_name(world, entity)), "ObstacleShape"));
        obstacles::undress(world, entity);
    }
    if is_sensor {
        let name = world.get::<SensorName>(entity).map_or("", |name| name.0.as_str());
        changes.push(change(format!("sensor {name:?}"), "SensorModel"));
        sensors::undress(world, entity);
    }
    let types = world.resource::<RobotKinds>().types().to_vec();
    for kind in types {
        if let Some(model) = (kind.model_name)(world, entity) {
            let name = world.get::<crate::simulation::RobotName>(entity).map_or("", |name| name.name.as_str());
            changes.push(change(format!("robot {name:?}"), &model));
            (kind.undress)(world, entity);
        }
    }
    changes
}

/// Puts back the values of robots and the readings of sensors that others have written, and the things of the run that
/// are not whole any more: what observers of others do while the simulation itself changes entities is not told from
/// its own changes.
pub(crate) fn put_values_back(world: &mut World) {
    for w in 0..world.resource::<Roster>().worlds.len() {
        let entity = world.resource::<Roster>().worlds[w];
        if world.get::<WorldScene>(entity).is_none() {
            put_missing_back(world, entity, RunThing::World(w));
        }
        for (number, entity) in obstacles::missing(world, w) {
            put_missing_back(world, entity, RunThing::Obstacle(w, number));
        }
    }
    for id in 0..world.resource::<Roster>().robots.len() {
        let robot = world.resource::<Roster>().robots[id];
        let ops = world.get::<RobotOps>(robot).copied();
        match ops.and_then(|ops| (ops.put_back)(world, robot)) {
            Some(components) if components.is_empty() => {}
            Some(components) => {
                let thing = thing_name(world, RunThing::Robot(id));
                let change =
                    |component| ForeignChange { entity: robot, thing: thing.clone(), component, is_of_run: true };
                refuse(world, components.into_iter().map(change).collect());
            }
            None => put_missing_back(world, robot, RunThing::Robot(id)),
        }
    }
    for k in 0..world.resource::<SensorRoster>().sensors.len() {
        let entity = world.resource::<SensorRoster>().sensors[k].entity;
        if world.get::<Scan>(entity).is_none() {
            put_missing_back(world, entity, RunThing::Sensor(k));
        }
    }
    put_scans_back(world);
}

/// Puts back the readings of sensors that others have written. Returns what was refused, by entity and component.
pub(super) fn put_scans_back(world: &mut World) -> Vec<(Entity, String)> {
    let mut said = Vec::new();
    for k in 0..world.resource::<SensorRoster>().sensors.len() {
        let entity = world.resource::<SensorRoster>().sensors[k].entity;
        let ranges = world.resource::<LatestFrame>().0.scans.get(k).map(|scan| Arc::clone(&scan.ranges));
        let (Some(ranges), Some(mut scan)) = (ranges, world.get_mut::<Scan>(entity)) else { continue };
        if !Arc::ptr_eq(&ranges, &scan.0) {
            scan.0 = ranges;
            let thing = thing_name(world, RunThing::Sensor(k));
            said.push((entity, name_of::<Scan>()));
            refuse(world, vec![ForeignChange { entity, thing, component: name_of::<Scan>(), is_of_run: true }]);
        }
    }
    said
}

/// Puts back a thing of the run that is not whole.
fn put_missing_back(world: &mut World, entity: Entity, thing: RunThing) {
    let component = if world.get_entity(entity).is_err() { "" } else { "one of its components" };
    let thing_name = thing_name(world, thing);
    at_work(world, |world| dress(world, thing));
    refuse(world, vec![ForeignChange { entity, thing: thing_name, component: component.into(), is_of_run: true }]);
}

/// Says what was put back.
pub(super) fn refuse(world: &mut World, changes: Vec<ForeignChange>) {
    for change in changes {
        world.write_message(CommandRefused(CommandError::Foreign(change)));
    }
}

/// Whether an entity resides in a world of the run, and in which.
pub(super) fn residence(world: &World, robot: Entity) -> Option<usize> {
    world_number(world, world.get::<ResidesIn>(robot)?.0)
}
