//! `ObstacleRoster`, the obstacles and doors of a run by world and number, and where each is now.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use bevy::prelude::*;

use super::number_set::NumberSet;
use crate::run::{ObstacleState, ObstacleStates, WorldChange};
use crate::simulation::truth::thing::RunThing;
use crate::simulation::truth::touched::at_work;
use crate::simulation::{Door, ObstacleOf, ObstacleShape, Placement};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::worlds::{Obstacle, World as WorldModel};

/// Where an obstacle's shape comes from.
#[derive(Debug)]
pub(super) enum ShapeSource {
    /// The world's obstacle of this number.
    File(usize),
    /// The world's door of this number.
    Door(usize),
    Added(Obstacle),
}

#[derive(Debug)]
pub(super) struct RosterEntry {
    pub(super) entity: Entity,
    pub(super) source: ShapeSource,
    pub(super) at_first: Placement,
    pub(super) now: Placement,
}

/// The obstacles of one world of the run.
#[derive(Debug)]
pub(crate) struct WorldObstacles {
    pub(super) entity: Entity,
    /// The world's number.
    pub(super) number: usize,
    /// The world at the start of the run.
    pub(super) start: Arc<WorldModel>,
    pub(super) entries: Vec<RosterEntry>,
    pub(super) numbers: BTreeMap<String, usize>,
    /// The states of the entries that are not as they were at first, as frames hold them.
    pub(super) changed: ObstacleStates,
    /// The numbers of the entries whose entities are yet to be given their placements.
    pub(super) unshown: BTreeSet<usize>,
    /// Whether the scene is older than the placements in ways that nobody has listed, and has to be made anew.
    pub(super) is_stale: bool,
    /// The entries that are in the scene.
    pub(super) in_scene: NumberSet,
    /// The numbers of the entries that were placed since the scene followed.
    pub(super) placed: BTreeSet<usize>,
}

/// The obstacles and doors of the run, by world and number. It decides what robots meet. The entities carry the same.
#[derive(Resource, Default, Debug)]
pub struct ObstacleRoster {
    pub(crate) grounds: Vec<WorldObstacles>,
}

impl WorldObstacles {
    /// The ground of a world whose obstacles and doors have these entities, in their order.
    /// [`dress_all`](Self::dress_all) spawns those that are missing or `None`.
    pub(crate) fn new(entity: Entity, number: usize, start: Arc<WorldModel>, entities: &[Option<Entity>]) -> Self {
        let (changed, unshown, numbers) = (ObstacleStates::new(), BTreeSet::new(), BTreeMap::new());
        let mut ground = WorldObstacles {
            entity,
            number,
            start: Arc::clone(&start),
            entries: vec![],
            numbers,
            changed,
            unshown,
            is_stale: true,
            in_scene: NumberSet::default(),
            placed: BTreeSet::new(),
        };
        let obstacles = start.obstacles.iter().enumerate().map(|(i, o)| (&o.name, ShapeSource::File(i), true));
        let doors = start.doors.iter().enumerate().map(|(i, d)| (&d.name, ShapeSource::Door(i), !d.open));
        let entities = entities.iter().copied().chain(std::iter::repeat(None));
        for ((name, source, present), entity) in obstacles.chain(doors).zip(entities) {
            let placement = Placement { present, ..Placement::default() };
            ground.push(name, entity.unwrap_or(Entity::PLACEHOLDER), source, placement);
        }
        ground
    }

    /// The ground of a world whose scene was made with it.
    pub(crate) fn fresh(mut self) -> Self {
        self.note_all();
        self
    }

    /// Notes that the scene is that of the placements.
    pub(super) fn note_all(&mut self) {
        self.is_stale = false;
        self.placed.clear();
        self.in_scene = self.entries.iter().map(|entry| entry.now.present).collect();
    }

    /// Gives every obstacle the components that the run has for it.
    pub(crate) fn dress_all(&mut self, world: &mut World) {
        (0..self.entries.len()).for_each(|number| self.dress(world, number));
    }

    /// Gives an obstacle the components that the run has for it, on an entity of its own if it has none.
    pub(super) fn dress(&mut self, world: &mut World, number: usize) {
        let at = (RunThing::Obstacle(self.number, number), ObstacleOf(self.entity));
        let Some(shape) = self.obstacle(number).map(|obstacle| shape_of(&obstacle)) else { return };
        let entry = &mut self.entries[number];
        if world.get_entity(entry.entity).is_err() {
            entry.entity = world.spawn_empty().id();
        }
        let (entity, now, is_door) = (entry.entity, entry.now, matches!(entry.source, ShapeSource::Door(_)));
        if let Ok(mut entity) = world.get_entity_mut(entity) {
            entity.insert((shape, now, at));
        }
        // looked up anew, for an observer may despawn what it sees
        if let Ok(mut entity) = world.get_entity_mut(entity) {
            if is_door {
                entity.insert(Door)
            } else {
                entity.remove::<Door>()
            };
        }
    }

    fn push(&mut self, name: &str, entity: Entity, source: ShapeSource, at_first: Placement) {
        self.numbers.insert(name.to_owned(), self.entries.len());
        self.entries.push(RosterEntry { entity, source, at_first, now: at_first });
    }

    /// Adds an obstacle, which is not there yet.
    pub(super) fn add(&mut self, world: &mut World, obstacle: Obstacle) {
        let (name, absent) = (obstacle.name.clone(), Placement { present: false, ..Placement::default() });
        self.push(&name, Entity::PLACEHOLDER, ShapeSource::Added(obstacle), absent);
        self.dress(world, self.entries.len() - 1);
    }

    pub(crate) fn entity(&self) -> Entity {
        self.entity
    }

    /// The world at the start of the run.
    pub(crate) fn start(&self) -> &Arc<WorldModel> {
        &self.start
    }

    /// The entities of the obstacles and doors of the world's file, in their order.
    pub(crate) fn entities(&self) -> impl Iterator<Item = Entity> + '_ {
        self.entries.iter().filter(|e| !matches!(e.source, ShapeSource::Added(_))).map(|e| e.entity)
    }

    /// The entities of the obstacles that the script adds.
    pub(crate) fn added(&self) -> impl Iterator<Item = Entity> + '_ {
        self.entries.iter().filter(|e| matches!(e.source, ShapeSource::Added(_))).map(|e| e.entity)
    }

    /// The entity of an obstacle. It may be despawned.
    pub(crate) fn entity_of(&self, number: usize) -> Option<Entity> {
        Some(self.entries.get(number)?.entity)
    }

    /// The name of an obstacle.
    pub(crate) fn name_of(&self, number: usize) -> Option<&str> {
        self.numbers.iter().find(|(_, n)| **n == number).map(|(name, _)| name.as_str())
    }

    /// The number of the obstacle or the door of this name.
    pub(crate) fn number(&self, name: &str) -> Option<usize> {
        self.numbers.get(name).copied()
    }

    /// Where an obstacle is now.
    pub(crate) fn placement(&self, number: usize) -> Option<Placement> {
        Some(self.entries.get(number)?.now)
    }

    /// The obstacle as it would be at a placement, or `None` where it would not be there.
    pub(crate) fn placed(&self, number: usize, placement: &Placement) -> Option<Obstacle> {
        let obstacle = if placement.present { self.obstacle(number)? } else { return None };
        Some(moved(&obstacle, &placement.pose))
    }

    /// The obstacle where its pieces are at first.
    fn obstacle(&self, number: usize) -> Option<Cow<'_, Obstacle>> {
        Some(match &self.entries.get(number)?.source {
            ShapeSource::File(i) => Cow::Borrowed(self.start.obstacles.get(*i)?),
            ShapeSource::Door(i) => Cow::Owned(self.start.doors.get(*i)?.leaf()),
            ShapeSource::Added(obstacle) => Cow::Borrowed(obstacle),
        })
    }
}

/// The component of an obstacle.
pub(crate) fn shape_of(obstacle: &Obstacle) -> ObstacleShape {
    ObstacleShape { name: obstacle.name.clone(), kind: obstacle.kind, pieces: obstacle.pieces.clone() }
}

/// An obstacle after a rigid motion.
pub(crate) fn moved(obstacle: &Obstacle, pose: &Pose2) -> Obstacle {
    if *pose == Pose2::IDENTITY {
        return obstacle.clone();
    }
    let pieces = obstacle.pieces.iter().map(|(frame, shape)| (pose.compose(frame), shape.clone())).collect();
    Obstacle::new(&obstacle.name, obstacle.kind, pieces)
}

impl ObstacleRoster {
    /// Appends the states of the obstacles that are not as they were at the start, as frames hold them.
    pub(crate) fn add_states_to(&self, states: &mut ObstacleStates) {
        self.grounds.iter().for_each(|ground| states.append(&ground.changed));
    }

    /// The number of the world of this name.
    pub(crate) fn world(&self, name: &str) -> Option<usize> {
        self.grounds.iter().position(|ground| ground.start.name == name)
    }
}

/// Runs `work` on the roster. What it changes of the entities is the simulation's own doing.
pub(crate) fn with_roster<T>(world: &mut World, work: impl FnOnce(&mut World, &mut ObstacleRoster) -> T) -> T {
    at_work(world, |world| {
        let mut roster = std::mem::take(&mut *world.resource_mut::<ObstacleRoster>());
        let done = work(world, &mut roster);
        *world.resource_mut::<ObstacleRoster>() = roster;
        done
    })
}

/// Puts an obstacle somewhere. The scene follows with [`refresh`](super::standing::refresh), its entity with
/// [`show`](super::dress::show).
pub(crate) fn place(ground: &mut WorldObstacles, number: usize, placement: Placement) {
    let Some(entry) = ground.entries.get_mut(number).filter(|e| e.now != placement) else { return };
    entry.now = placement;
    let (world, obstacle, Placement { present, pose }) = (ground.number as u32, number as u32, placement);
    if entry.now == entry.at_first {
        ground.changed.remove((world, obstacle));
    } else {
        ground.changed.set(ObstacleState { world, obstacle, present, pose });
    }
    ground.placed.insert(number);
    ground.unshown.insert(number);
}

/// The placement that a change asks for, of the obstacle with which number.
pub(crate) fn wanted(ground: &WorldObstacles, change: &WorldChange) -> Option<(usize, Placement)> {
    let number = ground.number(change.name())?;
    let placement = match change {
        WorldChange::Close(_) | WorldChange::Add { .. } => Placement::default(),
        WorldChange::Open(_) | WorldChange::Remove(_) => Placement { present: false, ..Placement::default() },
        WorldChange::Move { .. } => Placement { present: true, pose: change.pose()? },
    };
    Some((number, placement))
}
