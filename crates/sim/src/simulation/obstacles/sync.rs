//! The obstacles of a run, made those of a script or of a frame.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::roster::{RosterEntry, ShapeSource, place, with_roster};
use super::standing::refresh;
use crate::run::{ObstacleState, ObstacleStates, WorldEvent};
use crate::simulation::{Placement, RestoreError, SimulatedWorld, StandingWorld};
use motion_lab_core::worlds::{Obstacle, World as WorldModel};

/// Spawns the entity of the obstacle that a change adds, which comes after all others of its world.
pub(crate) fn add_obstacle(world: &mut World, event: &WorldEvent) {
    let Some(Ok(obstacle)) = event.change.added() else { return };
    with_roster(world, |world, roster| {
        let number = roster.world(&event.world);
        if let Some(ground) = number.and_then(|number| roster.grounds.get_mut(number)) {
            ground.add(world, obstacle);
        }
    });
}

/// Makes the entities of added obstacles those of these changes: spawns what they add, and despawns what they don't.
pub(crate) fn sync_added(world: &mut World, changes: &[WorldEvent]) {
    let mut added: BTreeMap<&str, Vec<Obstacle>> = BTreeMap::new();
    for WorldEvent { world, change, .. } in changes {
        if let Some(Ok(obstacle)) = change.added() {
            added.entry(world).or_default().push(obstacle);
        }
    }
    with_roster(world, |world, roster| {
        for ground in &mut roster.grounds {
            let wanted = added.remove(ground.start.name.as_str()).unwrap_or_default();
            let file = ground.start.obstacles.len() + ground.start.doors.len();
            let is_kept = |(entry, obstacle): &(&RosterEntry, &Obstacle)| matches!(&entry.source, ShapeSource::Added(own) if own == *obstacle);
            let kept = file + ground.entries[file..].iter().zip(&wanted).take_while(is_kept).count();
            for entry in ground.entries.drain(kept..) {
                if let ShapeSource::Added(obstacle) = &entry.source {
                    ground.numbers.remove(&obstacle.name);
                }
                ground.is_stale |= entry.now.present;
                world.despawn(entry.entity);
            }
            ground.changed.truncate_before((ground.number as u32, kept as u32));
            wanted.into_iter().skip(kept - file).for_each(|obstacle| ground.add(world, obstacle));
        }
        refresh(world, roster);
    });
}

/// Puts every obstacle where a frame has it.
///
/// # Errors
/// [`RestoreError::Obstacle`], with nothing changed, when the frame has an obstacle that the run does not have.
pub(crate) fn restore(world: &mut World, tick: u64, states: &ObstacleStates) -> Result<(), RestoreError> {
    with_roster(world, |world, roster| {
        for state in states.iter() {
            let ground = roster.grounds.get(state.world as usize);
            if ground.is_none_or(|g| state.obstacle as usize >= g.entries.len()) {
                return Err(RestoreError::Obstacle { tick, world: state.world, obstacle: state.obstacle });
            }
        }
        for (ground, number) in roster.grounds.iter_mut().zip(0..) {
            let own: BTreeMap<usize, &ObstacleState> =
                states.iter().filter(|s| s.world == number).map(|s| (s.obstacle as usize, s)).collect();
            let back: Vec<usize> =
                ground.changed.iter().map(|s| s.obstacle as usize).filter(|n| !own.contains_key(n)).collect();
            for number in back {
                let at_first = ground.entries[number].at_first;
                place(ground, number, at_first);
            }
            for (number, state) in own {
                place(ground, number, Placement { present: state.present, pose: state.pose });
            }
        }
        refresh(world, roster);
        Ok(())
    })
}

/// Gives every world of the run its residents, at its start and as it stands. Obstacles and scenes stay.
pub(crate) fn set_residents(world: &mut World, models: &[WorldModel]) {
    with_roster(world, |world, roster| {
        for (ground, model) in roster.grounds.iter_mut().zip(models).filter(|(g, m)| g.start.robots != m.robots) {
            let robots = model.robots.clone();
            ground.start = Arc::new(WorldModel { robots, ..WorldModel::clone(&ground.start) });
            let index = world.get::<SimulatedWorld>(ground.entity).map_or(0, |w| w.index);
            if let Ok(mut entity) = world.get_entity_mut(ground.entity) {
                let model = Arc::clone(&ground.start);
                entity.insert((SimulatedWorld { index, model }, StandingWorld(ground.standing())));
            }
        }
    });
}
