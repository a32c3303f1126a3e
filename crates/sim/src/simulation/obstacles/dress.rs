//! The components of the entities of worlds and obstacles, as the run has them.

use std::sync::Arc;

use bevy::prelude::*;

use super::roster::{ObstacleRoster, with_roster};
use super::standing::refresh;
use crate::simulation::truth::thing::RunThing;
use crate::simulation::truth::touched::{ForeignTouches, at_work};
use crate::simulation::{Door, ObstacleOf, ObstacleShape, Obstacles, Placement, Roster, SimulatedWorld};

/// Gives a world of the run its components and its scene anew, on an entity of its own if it has lost it.
pub(crate) fn dress_world(world: &mut World, number: usize) {
    with_roster(world, |world, roster| {
        let Some(ground) = roster.grounds.get_mut(number) else { return };
        if world.get_entity(ground.entity).is_err() {
            ground.entity = world.spawn_empty().id();
            world.resource_mut::<Roster>().worlds[number] = ground.entity;
        }
        let model = Arc::clone(&ground.start);
        let at = SimulatedWorld { index: number as u32, model };
        if let Ok(mut entity) = world.get_entity_mut(ground.entity) {
            entity.insert((at, RunThing::World(number)));
        }
        ground.is_stale = true;
        refresh(world, roster);
    });
}

/// Gives an obstacle of the run its components.
pub(crate) fn dress_obstacle(world: &mut World, w: usize, number: usize) {
    with_roster(world, |world, roster| {
        if let Some(ground) = roster.grounds.get_mut(w) {
            ground.dress(world, number);
        }
    });
}

/// Takes the components of an obstacle off an entity.
pub(crate) fn undress(world: &mut World, entity: Entity) {
    if let Ok(mut entity) = world.get_entity_mut(entity) {
        entity.remove::<(ObstacleShape, Placement, Door, ObstacleOf, RunThing)>();
    }
}

/// The obstacles of a world that are not listed there, by their numbers.
pub(crate) fn missing(world: &World, w: usize) -> Vec<(usize, Entity)> {
    let Some(ground) = world.resource::<ObstacleRoster>().grounds.get(w) else { return Vec::new() };
    let listed = world.get::<Obstacles>(ground.entity).map_or(0, |obstacles| obstacles.len());
    if listed == ground.entries.len() {
        return Vec::new();
    }
    let is_missing = |entity| world.get::<ObstacleOf>(entity).is_none_or(|of| of.0 != ground.entity);
    let entities = ground.entries.iter().map(|entry| entry.entity).enumerate();
    entities.filter(|&(_, entity)| is_missing(entity)).collect()
}

/// Gives the entities of obstacles their placements. That comes when a step or a seek is over, because whoever observes
/// placements is called by it.
pub(crate) fn show(world: &mut World) {
    if world.resource::<ObstacleRoster>().grounds.iter().all(|ground| ground.unshown.is_empty()) {
        return;
    }
    let mut placed: Vec<(Entity, Placement)> = Vec::new();
    for ground in &mut world.resource_mut::<ObstacleRoster>().grounds {
        let unshown = std::mem::take(&mut ground.unshown);
        let entries = unshown.into_iter().filter_map(|number| ground.entries.get(number));
        placed.extend(entries.map(|entry| (entry.entity, entry.now)));
    }
    at_work(world, |world| {
        for (entity, placement) in placed {
            if let Ok(mut entity) = world.get_entity_mut(entity) {
                entity.insert(placement);
            }
        }
    });
    world.resource_mut::<ForeignTouches>().has_shown = true;
}
