//! Observers of sensor entities: before a run begins its sensors are taken anew, later a change is refused.

use bevy::ecs::world::DeferredWorld;
use bevy::prelude::*;

use super::refusal::{SensorRefusal, SensorRefused};
use super::roster::SensorRoster;
use super::start::robot_of;
use crate::simulation::{MountedOn, SensorModel, SensorMount, SensorName, SensorNoise};

/// The components that say what a sensor is.
type SensorParts = (SensorModel, SensorName, SensorMount, SensorNoise, MountedOn);

/// A part of a sensor was inserted.
pub fn changed(on: On<Insert, SensorParts>, world: DeferredWorld) {
    note(world, on.entity);
}

/// Observes that a part of a sensor was removed or replaced, or that the sensor despawned. Before a run's first tick,
/// the sensors are then read anew. In a run the change is refused with a
/// [`SensorRefused`].
pub fn removed(on: On<Discard, SensorParts>, world: DeferredWorld) {
    note(world, on.entity);
}

fn note(mut world: DeferredWorld, sensor: Entity) {
    let Some(roster) = world.get_resource::<SensorRoster>() else { return };
    if !roster.fixed {
        world.resource_mut::<SensorRoster>().stale = true;
        return;
    }
    // a run that is being started, and one that is given up, have no robots in the roster of the run under way
    let robot = world.get::<MountedOn>(sensor).and_then(|on| robot_of(&world, on.0)).map(str::to_owned);
    if robot.is_some() && world.get::<SensorModel>(sensor).is_some() {
        let name = world.get::<SensorName>(sensor).map_or_else(String::new, |name| name.0.clone());
        let refused = SensorRefused { robot, sensor: name, reason: SensorRefusal::Fixed };
        if world.resource_mut::<SensorRoster>().refuse(&refused) {
            world.write_message(refused);
        }
    }
}
