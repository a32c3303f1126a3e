//! The sensor entities of a robot by their names, and the one without a name.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use bevy::prelude::*;

use crate::simulation::{RobotOps, SensorModel, SensorMount, SensorName, SensorNoise, Sensors};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::sensors::RangeSensor;

/// Marks the entity of a sensor that the run's configuration has.
#[derive(Component, Clone, Copy, Debug)]
pub(in crate::simulation) struct OfConfiguration;

/// The sensor entities of a robot by the bytes of their names.
pub(super) fn by_name(world: &World, robot: Entity) -> BTreeMap<&str, Vec<Entity>> {
    let mut named: BTreeMap<&str, Vec<Entity>> = BTreeMap::new();
    let there = world.get::<Sensors>(robot).into_iter().flat_map(|sensors| sensors.iter());
    for entity in there.filter(|&e| world.get::<SensorModel>(e).is_some()) {
        if let Some(SensorName(name)) = world.get(entity) {
            named.entry(name).or_default().push(entity);
        }
    }
    named
}

/// The one of several entities with one name that is taken: the configuration's own. `None` where there is none, since
/// another choice would depend on the order of entities.
pub(super) fn chosen(world: &World, entities: &[Entity]) -> Option<Entity> {
    if let [one] = entities {
        return Some(*one);
    }
    let mut own = entities.iter().filter(|&&e| world.get::<OfConfiguration>(e).is_some());
    own.next().copied().filter(|_| own.next().is_none())
}

/// Whether two sensors have the same rays, mount and noise.
pub(super) fn are_alike(world: &World, a: Entity, b: Entity) -> bool {
    let numbers = |e| (world.get::<SensorModel>(e), world.get::<SensorMount>(e), world.get::<SensorNoise>(e));
    numbers(a) == numbers(b)
}

/// Whether a run that has a sensor of its own gives this robot one.
pub(super) fn senses(world: &World, robot: Entity) -> bool {
    world.get::<RobotOps>(robot).is_some_and(|ops| (ops.senses)(world, robot))
}

/// The run's own sensor, as the unnamed sensors of its robots have it: every robot that senses has one, all with the
/// same rays over a full turn, in the middle of its frame. `None` when they do not agree.
pub(super) fn own_sensor(world: &World, robots: &[Entity]) -> Option<RangeSensor> {
    let mut own = robots.iter().filter(|&&robot| senses(world, robot)).map(|&robot| unnamed(world, robot));
    let first = own.next()??;
    own.all(|other| other == Some(first)).then_some(first)
}

/// The unnamed sensor of a robot, if it is as a run gives one.
fn unnamed(world: &World, robot: Entity) -> Option<RangeSensor> {
    let entity = chosen(world, by_name(world, robot).get("")?)?;
    let SensorModel(rays) = world.get(entity)?;
    let noise = world.get::<SensorNoise>(entity);
    let is_good = rays.check().is_ok() && noise.is_none_or(|noise| noise.0.try_new().is_ok());
    let is_plain = rays.field_of_view == TAU && world.get::<SensorMount>(entity)?.0 == Pose2::IDENTITY;
    (is_good && is_plain).then_some(rays.sensor)
}
