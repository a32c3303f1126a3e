//! The start of a run whose obstacles were changed from outside before tick 0.

use std::collections::BTreeSet;
use std::sync::Arc;

use bevy::prelude::*;

use super::dress::undress;
use super::roster::{WorldObstacles, moved, with_roster};
use super::standing::refresh;
use crate::simulation::truth::thing::RunThing;
use crate::simulation::{
    CommandError, CommandRefused, Door, ObstacleOf, ObstacleShape, Obstacles, Placement, SimulatedWorld,
};
use crate::tour::TourConfig;
use motion_lab_core::geometry::{Pose2, Shape};
use motion_lab_core::worlds::{Door as DoorModel, Obstacle, World as WorldModel};

/// Makes the obstacle entities of a run at tick 0 what its robots meet: the worlds of `config`, whose robots are those
/// of the run to be, and their scenes follow from them. The worlds in `lost` were despawned: they keep what they had.
///
/// The world file's obstacles keep their order, then come the others by their names. An entity that is no obstacle of a
/// world file (a taken or bad name, no valid piece) is left out, and a [`CommandRefused`] says so.
pub(crate) fn follow_obstacles(world: &mut World, config: &mut TourConfig, lost: &BTreeSet<usize>) {
    with_roster(world, |world, roster| {
        for (w, (ground, model)) in roster.grounds.iter_mut().zip(&mut config.worlds).enumerate() {
            let mut entities = Vec::new();
            if !lost.contains(&w) {
                let found = gather(world, ground, model);
                (model.obstacles, model.doors, entities) = found;
            }
            // what the script adds is spawned anew, unless somebody has made it an obstacle of the world
            let added: Vec<Entity> = ground.added().filter(|added| !entities.contains(&Some(*added))).collect();
            added.into_iter().for_each(|added| _ = world.try_despawn(added));
            let (start, entity) = (Arc::new(model.clone()), ground.entity());
            *ground = WorldObstacles::new(entity, w, Arc::clone(&start), &entities);
            ground.dress_all(world);
            if let Ok(mut entity) = world.get_entity_mut(entity) {
                entity.insert((SimulatedWorld { index: w as u32, model: start }, RunThing::World(w)));
            }
        }
        refresh(world, roster);
    });
}

/// The obstacles and the doors of a world's entities, and the entities in the same order.
fn gather(
    world: &mut World,
    ground: &WorldObstacles,
    model: &WorldModel,
) -> (Vec<Obstacle>, Vec<DoorModel>, Vec<Option<Entity>>) {
    let is_here = |entity: &Entity| world.get::<ObstacleOf>(*entity).is_some_and(|of| of.0 == ground.entity());
    let there: BTreeSet<Entity> =
        world.get::<Obstacles>(ground.entity()).into_iter().flat_map(Obstacles::iter).filter(is_here).collect();
    let known: Vec<Entity> = ground.entities().filter(|e| there.contains(e)).collect();
    let of_file: BTreeSet<Entity> = known.iter().copied().collect();
    let mut new: Vec<(&str, Entity)> = there
        .iter()
        .filter(|e| !of_file.contains(e))
        .filter_map(|&e| Some((world.get::<ObstacleShape>(e)?.name.as_str(), e)))
        .collect();
    new.sort_unstable();
    let start = ground.start();
    let (mut taken, mut left_out) = (other_names(model), Vec::new());
    let (mut obstacles, mut doors): (Vec<(Obstacle, Entity)>, Vec<(DoorModel, Entity)>) = (Vec::new(), Vec::new());
    for entity in known.into_iter().chain(new.into_iter().map(|(_, e)| e)) {
        let Some(shape) = world.get::<ObstacleShape>(entity) else { continue };
        let placement = world.get::<Placement>(entity).copied().unwrap_or_default();
        let is_door = world.get::<Door>(entity).is_some();
        if !placement.present && !is_door {
            continue;
        }
        let is_good = motion_lab_core::worlds::check_name(&shape.name).is_ok() && taken.insert(shape.name.clone());
        let made = if is_good { Some(shape).filter(|s| are_valid(s, &placement.pose)) } else { None };
        match made.map(|shape| {
            if is_door { door(shape, &placement).map(StartObstacle::Door) } else { Some(StartObstacle::Obstacle) }
        }) {
            Some(Some(StartObstacle::Door(made))) => doors.push((made, entity)),
            Some(Some(StartObstacle::Obstacle)) => obstacles.push((obstacle(start, shape, &placement.pose), entity)),
            _ => left_out.push((entity, start.name.clone(), shape.name.clone())),
        }
    }
    for (entity, of_world, name) in left_out {
        undress(world, entity);
        world.write_message(CommandRefused(CommandError::NoObstacle { world: of_world, name }));
    }
    let entities = obstacles.iter().map(|(_, e)| Some(*e)).chain(doors.iter().map(|(_, e)| Some(*e))).collect();
    (obstacles.into_iter().map(|(o, _)| o).collect(), doors.into_iter().map(|(d, _)| d).collect(), entities)
}

enum StartObstacle {
    Door(DoorModel),
    Obstacle,
}

/// The names in a world of what is neither an obstacle nor a door.
fn other_names(world: &WorldModel) -> BTreeSet<String> {
    let names = world.places.iter().map(|p| &p.name).chain(world.marks.iter().map(|m| &m.name));
    names.chain(world.robots.iter().map(|r| &r.name)).cloned().collect()
}

fn are_valid(shape: &ObstacleShape, pose: &Pose2) -> bool {
    pose.is_finite() && !shape.pieces.is_empty() && shape.pieces.iter().all(|(frame, s)| s.place(frame).is_valid())
}

/// The obstacle of an entity. One that is as the world file has it is the file's own, with its outlines.
fn obstacle(start: &WorldModel, shape: &ObstacleShape, pose: &Pose2) -> Obstacle {
    let is_at_first = *pose == Pose2::IDENTITY;
    let own = start.obstacle(&shape.name).filter(|o| is_at_first && o.kind == shape.kind && o.pieces == shape.pieces);
    own.cloned().unwrap_or_else(|| moved(&Obstacle::new(&shape.name, shape.kind, shape.pieces.clone()), pose))
}

/// The door of an entity: its one piece must be a segment.
fn door(shape: &ObstacleShape, placement: &Placement) -> Option<DoorModel> {
    let [(_, Shape::Segment { .. })] = &shape.pieces[..] else { return None };
    let leaf = moved(&Obstacle::new(&shape.name, shape.kind, shape.pieces.clone()), &placement.pose);
    let placed = leaf.placed().next()?;
    let [a, b] = *placed.core() else { return None };
    Some(DoorModel { name: shape.name.clone(), a, b, open: !placement.present })
}
