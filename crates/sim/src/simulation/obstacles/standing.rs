//! The scenes of a run's worlds, and the worlds as they stand: how they follow the obstacles' placements.

use std::sync::Arc;

use bevy::prelude::World;

use super::roster::{ObstacleRoster, RosterEntry, ShapeSource, WorldObstacles};
use crate::simulation::{SceneRevision, StandingWorld, WorldScene};
use motion_lab_core::collision::{ObstacleId, Scene};
use motion_lab_core::worlds::{Door, Obstacle, World as WorldModel};

/// The part of a scene's obstacles that may be changed one by one; of more the scene is made anew.
const ONE_BY_ONE: usize = 8;

/// Gives every world whose obstacles were changed its new scene, under a new revision.
pub(crate) fn refresh(world: &mut World, roster: &mut ObstacleRoster) {
    for ground in roster.grounds.iter_mut().filter(|ground| ground.is_stale || !ground.placed.is_empty()) {
        let is_followed = ground.follow(world).is_some();
        let made = (!is_followed).then(|| ground.made_anew());
        // looked up now, for an observer may despawn what it sees
        if let Ok(mut entity) = world.get_entity_mut(ground.entity) {
            if let Some((scene, model)) = made {
                entity.insert((WorldScene(scene), SceneRevision::new(), StandingWorld(model)));
            } else {
                entity.insert(SceneRevision::new());
            }
        }
    }
}

/// A change of an obstacle in a scene.
struct ObstacleEdit {
    /// Its number among the obstacles that stand, before the change and after it.
    number: usize,
    /// Whether it stood.
    is_out: bool,
    /// Where it stands now.
    put_in: Option<Obstacle>,
    /// The number of the door, of a door.
    door: Option<usize>,
}

fn change_scene(scene: &mut Scene, edits: &[ObstacleEdit]) {
    for ObstacleEdit { number, is_out, put_in, .. } in edits {
        let id = ObstacleId(*number as u32);
        if *is_out {
            scene.remove_obstacle(id);
        }
        if let Some(obstacle) = put_in {
            scene.insert_obstacle(id, obstacle);
        }
    }
}

fn change_model(model: &mut WorldModel, edits: Vec<ObstacleEdit>) {
    for ObstacleEdit { number, is_out, put_in, door } in edits {
        match (door, put_in) {
            (Some(door), leaf) => model.doors[door].open = leaf.is_none(),
            (None, Some(obstacle)) if is_out => model.obstacles[number] = obstacle,
            (None, Some(obstacle)) => model.obstacles.insert(number, obstacle),
            (None, None) if is_out => _ = model.obstacles.remove(number),
            (None, None) => {}
        }
    }
}

impl WorldObstacles {
    /// The scene and the world as it stands, made of the placements.
    fn made_anew(&mut self) -> (Arc<Scene>, Arc<WorldModel>) {
        self.note_all();
        let model = self.standing();
        (Arc::new(Scene::of_world(&model)), model)
    }

    /// Changes the world's scene and the world as it stands by what was placed: they are then as if made anew. `None`
    /// where they have to be, because too much has changed, or because they are not what is known of them.
    ///
    /// They are changed in place unless somebody else has them; then they are copied first.
    fn follow(&mut self, world: &mut World) -> Option<()> {
        let (file, doors) = (self.start.obstacles.len(), self.start.doors.len());
        let closed = self.in_scene.count_in(file..file + doors);
        let count = self.in_scene.count_in(0..self.entries.len());
        let is_known = world.get::<WorldScene>(self.entity)?.0.obstacle_count() == count
            && world.get::<StandingWorld>(self.entity)?.0.obstacles.len() == count - closed;
        if self.is_stale || !is_known || self.placed.len() * ONE_BY_ONE > count {
            return None;
        }
        let placed = std::mem::take(&mut self.placed);
        let edits: Vec<ObstacleEdit> = placed.into_iter().filter_map(|entry| self.edit(entry)).collect();
        let change = |scene: &mut WorldScene| change_scene(Arc::make_mut(&mut scene.0), &edits);
        world.modify_component(self.entity, change).ok()??;
        let change = |standing: &mut StandingWorld| {
            if self.changed.is_empty() {
                standing.0 = Arc::clone(&self.start);
            } else {
                change_model(Arc::make_mut(&mut standing.0), edits);
            }
        };
        world.modify_component(self.entity, change).ok()?
    }

    /// The change that an entry asks of the scene, noted as made; `None` for one that is not there any more.
    fn edit(&mut self, entry: usize) -> Option<ObstacleEdit> {
        let (number, is_out) = (self.number_in_scene(entry), self.in_scene.holds(entry));
        let RosterEntry { source, now, .. } = self.entries.get(entry)?;
        let door = if let ShapeSource::Door(door) = source { Some(*door) } else { None };
        let put_in = match door {
            // a leaf hangs where the file has it
            Some(door) => self.start.doors.get(door).filter(|_| now.present).map(Door::leaf),
            None => self.placed(entry, now),
        };
        self.in_scene.set(entry, put_in.is_some());
        Some(ObstacleEdit { number, is_out, put_in, door })
    }

    /// The number that an entry has in the scene, or would have: the world's obstacles come first, then the added ones,
    /// then the closed doors.
    fn number_in_scene(&self, entry: usize) -> usize {
        let file = self.start.obstacles.len();
        let added = file + self.start.doors.len();
        let in_file = self.in_scene.count_in(0..file.min(entry));
        if entry < file {
            in_file
        } else if entry >= added {
            in_file + self.in_scene.count_in(added..entry)
        } else {
            in_file + self.in_scene.count_in(added..self.entries.len()) + self.in_scene.count_in(file..entry)
        }
    }

    /// The world as it stands now: its obstacles where they are, then the added ones, and its doors open or closed.
    pub(super) fn standing(&self) -> Arc<WorldModel> {
        if self.changed.is_empty() {
            return Arc::clone(&self.start);
        }
        // the obstacles, of which there may be many, are not copied first
        let WorldModel { name, bounds, obstacles: _, doors, places, marks, routes, robots } = &*self.start;
        let mut model = WorldModel {
            name: name.clone(),
            bounds: *bounds,
            obstacles: Vec::with_capacity(self.entries.len()),
            doors: doors.clone(),
            places: places.clone(),
            marks: marks.clone(),
            routes: routes.clone(),
            robots: robots.clone(),
        };
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
