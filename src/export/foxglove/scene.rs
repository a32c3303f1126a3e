//! Worlds and robots as scene entities: flat areas with an edge, in the colours of their roles.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::geometry::{Point2, Pose2};
use crate::picture::{Role, Theme, polygon_of};
use crate::simulation::RobotView;
use crate::worlds::{Obstacle, World};

use super::frames;
use super::message::{
    Color, Duration, LinePrimitive, Pose, SceneEntity, SceneEntityDeletion, SceneUpdate, Timestamp,
    TriangleListPrimitive, Vector3, line,
};

/// Height of the robots above their world, so that neither hides in the other, metres.
const ABOVE: f64 = 0.01;
/// The width of a line on the screen, pixels.
const LINE_PX: f64 = 2.0;

/// The marks, obstacles, walls and closed doors of those worlds that are not as they were shown: an entity for each.
/// What is gone is deleted. `None` where nothing has changed.
pub fn changed_worlds(tick: u64, shown: &[Arc<World>], now: &[Arc<World>]) -> Option<SceneUpdate> {
    let is_shown = |i: usize, world: &Arc<World>| shown.get(i).is_some_and(|old| Arc::ptr_eq(old, world));
    let changed: Vec<usize> = (0..now.len()).filter(|&i| !is_shown(i, &now[i])).collect();
    if changed.is_empty() {
        return None;
    }
    let mut update = worlds(tick, changed.iter().map(|&i| &*now[i]));
    let there: BTreeSet<&str> = update.entities.iter().map(|e| e.id.as_str()).collect();
    let before = worlds(tick, changed.iter().filter_map(|&i| Some(&**shown.get(i)?)));
    let timestamp = Some(Timestamp::of_tick(tick));
    let gone = before.entities.into_iter().filter(|e| !there.contains(e.id.as_str()));
    let deletions = gone.map(|e| SceneEntityDeletion { timestamp, id: e.id }).collect();
    update.deletions = deletions;
    Some(update)
}

fn worlds<'a>(tick: u64, worlds: impl Iterator<Item = &'a World>) -> SceneUpdate {
    let mut entities = Vec::new();
    for world in worlds {
        let entity = |kind: &str, name: &str| {
            let id = format!("{}/{kind}/{name}", frames::of_world(world));
            SceneEntity { id, frame_id: frames::of_world(world), ..empty(tick) }
        };
        for mark in &world.marks {
            let strip = edge(&mark.points, line::STRIP, Role::Muted, 0.0);
            entities.push(SceneEntity { lines: vec![strip], ..entity("mark", &mark.name) });
        }
        let doors: Vec<Obstacle> = world.closed_doors().collect();
        for obstacle in world.obstacles.iter().chain(&doors) {
            let mut entity = entity("obstacle", &obstacle.name);
            for (pose, shape) in &obstacle.pieces {
                draw(&mut entity, &polygon_of(&shape.place(pose)), Role::Obstacle, 0.35, 0.0);
            }
            entities.push(entity);
        }
    }
    SceneUpdate { deletions: Vec::new(), entities }
}

/// The robots after a tick: an entity for each part, red while a contact flashes. `seen` are the parts shown so far.
/// Those of them that are gone, as a detached trailer is, are deleted.
pub fn robots(tick: u64, robots: &[RobotView], seen: &mut BTreeSet<String>) -> SceneUpdate {
    let mut entities = Vec::new();
    for robot in robots {
        let role = if robot.flash > 0 { Role::Goal } else { Role::Robot };
        for (k, part) in robot.footprint.parts().iter().enumerate() {
            let id = frames::of_part(&robot.name, k);
            let mut entity = SceneEntity { frame_id: id.clone(), id, frame_locked: true, ..empty(tick) };
            draw(&mut entity, &polygon_of(&part.shape().place(&Pose2::IDENTITY)), role, 0.85, ABOVE);
            entities.push(entity);
        }
    }
    let there: BTreeSet<String> = entities.iter().map(|e| e.id.clone()).collect();
    let timestamp = Some(Timestamp::of_tick(tick));
    let gone = seen.difference(&there).map(|id| SceneEntityDeletion { timestamp, id: id.clone() });
    let deletions = gone.collect();
    seen.extend(there);
    SceneUpdate { deletions, entities }
}

/// An empty entity, which stays until it is replaced.
fn empty(tick: u64) -> SceneEntity {
    SceneEntity {
        timestamp: Some(Timestamp::of_tick(tick)),
        lifetime: Some(Duration { seconds: 0, nanos: 0 }),
        ..SceneEntity::default()
    }
}

/// Adds a convex polygon with its edge, or a bare segment.
fn draw(entity: &mut SceneEntity, corners: &[Point2], role: Role, opacity: f64, z: f64) {
    if corners.len() < 3 {
        entity.lines.push(edge(corners, line::STRIP, role, z));
        return;
    }
    entity.lines.push(edge(corners, line::LOOP, role, z));
    entity.triangles.push(TriangleListPrimitive {
        pose: Some(Pose::raised(z)),
        points: corners.iter().map(|&p| Vector3::of(p, 0.0)).collect(),
        color: Some(colour(role, opacity)),
        indices: (1..corners.len() as u32 - 1).flat_map(|k| [0, k, k + 1]).collect(),
    });
}

fn edge(points: &[Point2], kind: i32, role: Role, z: f64) -> LinePrimitive {
    LinePrimitive {
        r#type: kind,
        pose: Some(Pose::raised(z)),
        thickness: LINE_PX,
        scale_invariant: true,
        points: points.iter().map(|&p| Vector3::of(p, 0.0)).collect(),
        color: Some(colour(role, 1.0)),
    }
}

/// The role's colour on dark paper, as viewers have a dark background.
fn colour(role: Role, opacity: f64) -> Color {
    let [r, g, b] = Theme::Dark.palette().colour(role).0.map(|c| f64::from(c) / 255.0);
    Color { r, g, b, a: opacity }
}
