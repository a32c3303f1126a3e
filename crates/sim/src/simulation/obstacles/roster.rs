//! `ObstacleRoster`, the obstacles and doors of a run by world and number, and where each is now.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use bevy::prelude::*;

use crate::run::{ObstacleState, WorldChange, WorldEvent};
use crate::simulation::{
    Door, ObstacleOf, ObstacleShape, Obstacles, Placement, RestoreError, Roster, SceneRevision, SimulatedWorld,
    StandingWorld, WorldScene,
};
use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::worlds::{Obstacle, World as WorldModel};

/// Where an obstacle's shape comes from.
#[derive(Debug)]
enum ShapeSource {
    /// The world's obstacle of this number.
    File(usize),
    /// The world's door of this number.
    Door(usize),
    Added(Obstacle),
}

#[derive(Debug)]
struct RosterEntry {
    entity: Entity,
    source: ShapeSource,
    at_first: Placement,
    now: Placement,
}

/// The obstacles of one world of the run.
#[derive(Debug)]
pub(crate) struct WorldObstacles {
    entity: Entity,
    /// The world at the start of the run.
    start: Arc<WorldModel>,
    entries: Vec<RosterEntry>,
    numbers: BTreeMap<String, usize>,
    /// The numbers of the entries that are not as they were at first.
    changed: BTreeSet<usize>,
    /// Whether the scene is older than the placements.
    is_stale: bool,
}

/// The obstacles and doors of the run, by world and number. It decides what robots meet. The entities carry the same.
#[derive(Resource, Default, Debug)]
pub struct ObstacleRoster {
    pub(crate) grounds: Vec<WorldObstacles>,
    /// The number of the next scene's revision; it never comes back in one app.
    next_revision: u64,
    /// Whether the simulation itself is changing obstacles.
    pub(crate) is_at_work: bool,
    /// Whether an obstacle was changed from outside before tick 0.
    pub(crate) is_unsettled: bool,
}

impl WorldObstacles {
    /// Whether the world's entities are the ground's own, each where it is by the ground.
    fn is_as_spawned(&self, world: &World) -> bool {
        let there = world.get::<Obstacles>(self.entity()).map_or(0, |obstacles| obstacles.len());
        let is_placed = |(number, entity)| world.get::<Placement>(entity).copied() == self.placement(number);
        there == self.entities().count() && self.entities().enumerate().all(is_placed)
    }

    /// Spawns the obstacles and the doors of a world, as children of its entity.
    pub(crate) fn spawn(world: &mut World, entity: Entity, start: Arc<WorldModel>) -> Self {
        let mut ground = WorldObstacles {
            entity,
            start: Arc::clone(&start),
            entries: Vec::new(),
            numbers: BTreeMap::new(),
            changed: BTreeSet::new(),
            is_stale: false,
        };
        let there = Placement::default();
        for (i, obstacle) in start.obstacles.iter().enumerate() {
            let id = world.spawn((shape_of(obstacle), there, ObstacleOf(entity))).id();
            ground.push(&obstacle.name, id, ShapeSource::File(i), there);
        }
        for (i, door) in start.doors.iter().enumerate() {
            let placement = Placement { present: !door.open, ..there };
            let id = world.spawn((shape_of(&door.leaf()), placement, Door, ObstacleOf(entity))).id();
            ground.push(&door.name, id, ShapeSource::Door(i), placement);
        }
        ground
    }

    /// The ground of a world whose obstacles and doors have these entities, in their order.
    pub(crate) fn of_entities(entity: Entity, start: Arc<WorldModel>, entities: &[Entity]) -> Self {
        let (changed, numbers) = (BTreeSet::new(), BTreeMap::new());
        let mut ground =
            WorldObstacles { entity, start: Arc::clone(&start), entries: vec![], numbers, changed, is_stale: true };
        let obstacles = start.obstacles.iter().enumerate().map(|(i, o)| (&o.name, ShapeSource::File(i), true));
        let doors = start.doors.iter().enumerate().map(|(i, d)| (&d.name, ShapeSource::Door(i), !d.open));
        for ((name, source, present), &entity) in obstacles.chain(doors).zip(entities) {
            ground.push(name, entity, source, Placement { present, ..Placement::default() });
        }
        ground
    }

    fn push(&mut self, name: &str, entity: Entity, source: ShapeSource, at_first: Placement) {
        self.numbers.insert(name.to_owned(), self.entries.len());
        self.entries.push(RosterEntry { entity, source, at_first, now: at_first });
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
        let entry = self.entries.get(number).filter(|_| placement.present)?;
        let leaf;
        let obstacle = match &entry.source {
            ShapeSource::File(i) => self.start.obstacles.get(*i)?,
            ShapeSource::Door(i) => {
                leaf = self.start.doors.get(*i)?.leaf();
                &leaf
            }
            ShapeSource::Added(obstacle) => obstacle,
        };
        Some(moved(obstacle, &placement.pose))
    }

    /// The world as it stands now: its obstacles where they are, then the added ones, and its doors open or closed.
    fn standing(&self) -> Arc<WorldModel> {
        if self.changed.is_empty() {
            return Arc::clone(&self.start);
        }
        let mut model = WorldModel { obstacles: Vec::new(), ..WorldModel::clone(&self.start) };
        for (number, entry) in self.entries.iter().enumerate() {
            if let ShapeSource::Door(i) = entry.source {
                model.doors[i].open = !entry.now.present;
            } else {
                model.obstacles.extend(self.placed(number, &entry.now));
            }
        }
        Arc::new(model)
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
    /// The obstacles that are not as they were at the start, as frames hold them.
    pub(crate) fn states(&self) -> impl Iterator<Item = ObstacleState> + '_ {
        self.grounds.iter().zip(0..).flat_map(|(ground, world)| {
            ground.changed.iter().filter_map(move |&number| {
                let Placement { present, pose } = ground.entries.get(number)?.now;
                Some(ObstacleState { world, obstacle: number as u32, present, pose })
            })
        })
    }

    /// The number of the world of this name.
    pub(crate) fn world(&self, name: &str) -> Option<usize> {
        self.grounds.iter().position(|ground| ground.start.name == name)
    }
}

/// Runs `work` on the roster. What it changes of the entities is the simulation's own doing.
pub(crate) fn at_work<T>(world: &mut World, work: impl FnOnce(&mut World, &mut ObstacleRoster) -> T) -> T {
    let mut roster = std::mem::take(&mut *world.resource_mut::<ObstacleRoster>());
    world.resource_mut::<ObstacleRoster>().is_at_work = true;
    let done = work(world, &mut roster);
    *world.resource_mut::<ObstacleRoster>() = roster;
    done
}

/// Puts an obstacle somewhere. The scene follows with [`refresh`].
pub(crate) fn place(world: &mut World, ground: &mut WorldObstacles, number: usize, placement: Placement) {
    let Some(entry) = ground.entries.get_mut(number).filter(|e| e.now != placement) else { return };
    entry.now = placement;
    if entry.now == entry.at_first {
        ground.changed.remove(&number)
    } else {
        ground.changed.insert(number)
    };
    ground.is_stale = true;
    if let Ok(mut entity) = world.get_entity_mut(entry.entity) {
        entity.insert(placement);
    }
}

/// Gives every world whose obstacles were changed its new scene, under a new revision.
pub(crate) fn refresh(world: &mut World, roster: &mut ObstacleRoster) {
    for ground in roster.grounds.iter_mut().filter(|ground| ground.is_stale) {
        ground.is_stale = false;
        roster.next_revision += 1;
        let model = ground.standing();
        let scene = Arc::new(Scene::of_world(&model));
        if let Ok(mut entity) = world.get_entity_mut(ground.entity) {
            entity.insert((WorldScene(scene), SceneRevision(roster.next_revision), StandingWorld(model)));
        }
    }
}

/// Makes the entities of added obstacles those of these changes: spawns what they add, and despawns what they don't.
pub(crate) fn sync_added(world: &mut World, changes: &[WorldEvent]) {
    let mut added: BTreeMap<&str, Vec<Obstacle>> = BTreeMap::new();
    for WorldEvent { world, change, .. } in changes {
        if let Some(Ok(obstacle)) = change.added() {
            added.entry(world).or_default().push(obstacle);
        }
    }
    at_work(world, |world, roster| {
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
            ground.changed.split_off(&kept);
            let absent = Placement { present: false, ..Placement::default() };
            for obstacle in wanted.into_iter().skip(kept - file) {
                let entity = world.spawn((shape_of(&obstacle), absent, ObstacleOf(ground.entity))).id();
                let name = obstacle.name.clone();
                ground.push(&name, entity, ShapeSource::Added(obstacle), absent);
            }
        }
        refresh(world, roster);
    });
}

/// Puts every obstacle where a frame has it.
///
/// # Errors
/// [`RestoreError::Obstacle`], with nothing changed, when the frame has an obstacle that the run does not have.
pub(crate) fn restore(world: &mut World, tick: u64, states: &[ObstacleState]) -> Result<(), RestoreError> {
    at_work(world, |world, roster| {
        for state in states {
            let ground = roster.grounds.get(state.world as usize);
            if ground.is_none_or(|g| state.obstacle as usize >= g.entries.len()) {
                return Err(RestoreError::Obstacle { tick, world: state.world, obstacle: state.obstacle });
            }
        }
        for (ground, number) in roster.grounds.iter_mut().zip(0..) {
            let own: BTreeMap<usize, &ObstacleState> =
                states.iter().filter(|s| s.world == number).map(|s| (s.obstacle as usize, s)).collect();
            let back: Vec<usize> = ground.changed.iter().copied().filter(|n| !own.contains_key(n)).collect();
            for number in back {
                let at_first = ground.entries[number].at_first;
                place(world, ground, number, at_first);
            }
            for (number, state) in own {
                place(world, ground, number, Placement { present: state.present, pose: state.pose });
            }
        }
        refresh(world, roster);
        Ok(())
    })
}

/// Gives every world of the run its residents, at its start and as it stands. Obstacles and scenes stay.
pub(crate) fn set_residents(world: &mut World, models: &[WorldModel]) {
    at_work(world, |world, roster| {
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

/// Begins the roster of a run, in place of the last run's. The worlds' entities are those of the run's [`Roster`].
pub(crate) fn begin(world: &mut World, grounds: Vec<WorldObstacles>) {
    let next_revision = world.resource::<ObstacleRoster>().next_revision;
    debug_assert_eq!(grounds.len(), world.resource::<Roster>().worlds().len());
    // observers of what the start spawned may have changed it already
    let is_unsettled = grounds.iter().any(|ground| !ground.is_as_spawned(world));
    world.insert_resource(ObstacleRoster { grounds, next_revision, is_at_work: false, is_unsettled });
}
