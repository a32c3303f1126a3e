//! The components of a sensor's entity, as the run has them.

use bevy::prelude::*;

use super::OfConfiguration;
use super::roster::SensorRoster;
use crate::simulation::truth::thing::RunThing;
use crate::simulation::{LatestFrame, MountedOn, Roster, Scan, SensorModel, SensorMount, SensorName, SensorNoise};

/// What makes an entity a sensor.
type SensorParts = (SensorModel, SensorName, SensorMount, SensorNoise, MountedOn, Scan, OfConfiguration, RunThing);

/// Gives a sensor of the run its components, on an entity of its own if it has lost it.
pub(in crate::simulation) fn dress_sensor(world: &mut World, k: usize) {
    let Some(sensor) = world.resource::<SensorRoster>().sensors.get(k) else { return };
    let (entity, noise) = (sensor.entity, sensor.noise.as_ref().map(|(noise, _)| SensorNoise(*noise)));
    let parts = (SensorModel(sensor.rays), SensorName(sensor.name.clone()), SensorMount(sensor.mount));
    let Some(robot) = world.resource::<Roster>().robots.get(sensor.id as usize).copied() else { return };
    let scan = world.resource::<LatestFrame>().0.scans.get(k).map(|scan| Scan(scan.ranges.clone()));
    let entity = if world.get_entity(entity).is_ok() { entity } else { world.spawn_empty().id() };
    if let Ok(mut dressed) = world.get_entity_mut(entity) {
        dressed.insert((parts, MountedOn(robot), scan.unwrap_or_default(), OfConfiguration, RunThing::Sensor(k)));
    }
    // looked up anew, for an observer may despawn what it sees
    if let Ok(mut dressed) = world.get_entity_mut(entity) {
        match noise {
            Some(noise) => dressed.insert(noise),
            None => dressed.remove::<SensorNoise>(),
        };
    }
    if let Some(sensor) = world.resource_mut::<SensorRoster>().sensors.get_mut(k) {
        (sensor.entity, sensor.robot) = (entity, robot);
    }
}

/// Takes the components of a sensor off an entity.
pub(in crate::simulation) fn undress(world: &mut World, entity: Entity) {
    if let Ok(mut entity) = world.get_entity_mut(entity) {
        entity.remove::<SensorParts>();
    }
}
