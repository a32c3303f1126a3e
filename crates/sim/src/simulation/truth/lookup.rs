//! Finds the things of the run by their entities, and their names.

use bevy::prelude::*;

use super::run_config::RunConfig;
use super::thing::RunThing;
use crate::simulation::obstacles::roster::ObstacleRoster;
use crate::simulation::{ObstacleShape, Roster, SensorRoster, SimulatedWorld};

/// What an entity is in the run under way; `None` for one that is not the run's.
pub(crate) fn thing_of(world: &World, entity: Entity) -> Option<RunThing> {
    world.get::<RunThing>(entity).copied().filter(|thing| entity_of(world, *thing) == Some(entity))
}

/// The entity of a thing. It may be despawned.
fn entity_of(world: &World, thing: RunThing) -> Option<Entity> {
    match thing {
        RunThing::World(w) => world.get_resource::<Roster>()?.worlds.get(w).copied(),
        RunThing::Robot(id) => world.get_resource::<Roster>()?.robots.get(id).copied(),
        RunThing::Obstacle(w, n) => world.get_resource::<ObstacleRoster>()?.grounds.get(w)?.entity_of(n),
        RunThing::Sensor(k) => Some(world.get_resource::<SensorRoster>()?.sensors.get(k)?.entity),
    }
}

/// What a thing is and its name, for messages.
pub(crate) fn thing_name(world: &World, thing: RunThing) -> String {
    let config = world.get_resource::<RunConfig>().map(RunConfig::config);
    let world_name = |w: usize| config.and_then(|c| c.worlds.get(w)).map_or("", |w| w.name.as_str());
    let robot_name = |id: usize| config.and_then(|c| c.resident(id)).map_or("", |(_, robot)| robot.name.as_str());
    match thing {
        RunThing::World(w) => format!("world {:?}", world_name(w)),
        RunThing::Robot(id) => format!("robot {:?}", robot_name(id)),
        RunThing::Obstacle(w, n) => {
            let grounds = world.get_resource::<ObstacleRoster>().map(|roster| &roster.grounds);
            let name = grounds.and_then(|grounds| grounds.get(w)?.name_of(n));
            format!("obstacle {:?} in world {:?}", name.unwrap_or_default(), world_name(w))
        }
        RunThing::Sensor(k) => {
            let sensor = world.get_resource::<SensorRoster>().and_then(|roster| roster.sensors.get(k));
            let (name, robot) = sensor.map_or(("", 0), |s| (s.name.as_str(), s.id as usize));
            format!("sensor {name:?} of robot {:?}", robot_name(robot))
        }
    }
}

/// The number of the world that an entity is, in the run under way.
pub(crate) fn world_number(world: &World, entity: Entity) -> Option<usize> {
    let number = world.get::<SimulatedWorld>(entity)?.index as usize;
    (world.get_resource::<Roster>()?.worlds.get(number) == Some(&entity)).then_some(number)
}

/// The name that an obstacle's entity gives itself, for messages.
pub(crate) fn shape_name(world: &World, obstacle: Entity) -> String {
    world.get::<ObstacleShape>(obstacle).map_or_else(String::new, |shape| shape.name.clone())
}
