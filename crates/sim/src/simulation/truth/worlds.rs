//! Puts the run's worlds back that others have changed at tick 0: a run's worlds are those that it was started with.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use bevy::prelude::*;

use super::put_back::{put_thing_back, refuse};
use super::thing::RunThing;
use super::touched::{Touch, at_work};
use crate::simulation::obstacles::roster::ObstacleRoster;
use crate::simulation::{ObstacleOf, Obstacles, Residents, ResidesIn, Roster, RunConfig};

/// Puts back what others have changed of the worlds, and says so. Returns the numbers of those that were despawned, and
/// with them all that was in them.
pub(super) fn put_worlds_back(world: &mut World, touched: &BTreeMap<Entity, Touch>) -> BTreeSet<usize> {
    let mut lost = BTreeSet::new();
    for (&entity, touch) in touched {
        let Some(thing) = touch.thing else { continue };
        at_work(world, |world| mark_again(world, entity, thing));
        let RunThing::World(w) = thing else { continue };
        if world.get_entity(entity).is_err() {
            lost.insert(w);
        } else {
            at_work(world, |world| give_back(world, w, entity));
        }
        let changes = at_work(world, |world| put_thing_back(world, entity, thing, touch));
        refuse(world, changes);
    }
    lost
}

/// Marks an entity of the run as what it is, if it has lost its mark along with other components.
fn mark_again(world: &mut World, entity: Entity, thing: RunThing) {
    if let Ok(mut entity) = world.get_entity_mut(entity)
        && !entity.contains::<RunThing>()
    {
        entity.insert(thing);
    }
}

/// Gives a world the robots and obstacles back that it has lost along with the component that lists them.
fn give_back(world: &mut World, w: usize, entity: Entity) {
    let config = Arc::clone(world.resource::<RunConfig>().config());
    let before = config.worlds[..w].iter().map(|model| model.robots.len()).sum();
    let robots = world.resource::<Roster>().robots.iter().skip(before).take(config.worlds[w].robots.len());
    let robots: Vec<Entity> = robots.copied().collect();
    let ground = world.resource::<ObstacleRoster>().grounds.get(w);
    let obstacles: Vec<Entity> = ground.into_iter().flat_map(|ground| ground.entities()).collect();
    if world.get::<Residents>(entity).is_none() {
        robots.into_iter().for_each(|robot| give::<ResidesIn>(world, robot, ResidesIn(entity)));
    }
    if world.get::<Obstacles>(entity).is_none() {
        obstacles.into_iter().for_each(|obstacle| give::<ObstacleOf>(world, obstacle, ObstacleOf(entity)));
    }
}

/// Gives an entity a component that it lacks.
fn give<C: Component>(world: &mut World, entity: Entity, component: C) {
    if let Ok(mut entity) = world.get_entity_mut(entity)
        && !entity.contains::<C>()
    {
        entity.insert(component);
    }
}
