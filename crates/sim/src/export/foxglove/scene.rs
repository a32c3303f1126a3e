//! Worlds, robots and their paths as scene entities: flat areas with an edge and lines, in the colours of their roles.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::simulation::RobotView;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::picture::{Role, Theme, polygon_of};
use motion_lab_core::worlds::{Obstacle, World};

use super::frames;
use super::message::{
    Color, Duration, LinePrimitive, Pose, SceneEntity, SceneEntityDeletion, SceneUpdate, Timestamp,
    TriangleListPrimitive, Vector3, line,
};
use super::paths::RunPath;

/// Height of the robots above their world, so that neither hides in the other, metres.
const ABOVE: f64 = 0.01;
/// Half the width of the cross at a contact, metres.
const CROSS: f64 = 0.05;
/// The width of a line on the screen, pixels.
const LINE_PX: f64 = 2.0;

/// The marks, obstacles, walls and closed doors of all worlds, an entity for each; `None` where nothing has changed
/// since they were shown. What is gone is deleted. All of it is written whenever a part changes: a viewer that goes to
/// another time takes the last message only.
pub fn changed_worlds(tick: u64, shown: &[Arc<World>], now: &[Arc<World>]) -> Option<SceneUpdate> {
    let same = shown.len() == now.len() && shown.iter().zip(now).all(|(old, new)| Arc::ptr_eq(old, new));
    if same {
        return None;
    }
    let entities = worlds(tick, now);
    let deletions = gone(tick, &worlds(tick, shown), &entities);
    Some(SceneUpdate { deletions, entities })
}

/// The deletions of the entities of `before` that are not in `now`.
fn gone(tick: u64, before: &[SceneEntity], now: &[SceneEntity]) -> Vec<SceneEntityDeletion> {
    let there: BTreeSet<&str> = now.iter().map(|e| e.id.as_str()).collect();
    let timestamp = Some(Timestamp::of_tick(tick));
    let gone = before.iter().filter(|e| !there.contains(e.id.as_str()));
    gone.map(|e| SceneEntityDeletion { timestamp, id: e.id.clone() }).collect()
}

fn worlds(tick: u64, worlds: &[Arc<World>]) -> Vec<SceneEntity> {
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
    entities
}

/// The robots' parts, an entity for each in its part's frame; `None` where all parts are those of the tick before. What
/// is gone, as a detached trailer is, is deleted.
pub fn changed_robots(tick: u64, before: &[RobotView], now: &[RobotView]) -> Option<SceneUpdate> {
    let same = before.len() == now.len() && before.iter().zip(now).all(|(old, new)| frames::same_parts(old, new));
    if same {
        return None;
    }
    let part = |id: &String| PartStyle { id: id.clone(), role: Role::Robot, z: ABOVE };
    let entities = parts(tick, now, part);
    let deletions = gone(tick, &parts(tick, before, part), &entities);
    Some(SceneUpdate { deletions, entities })
}

/// The robots of which a contact flashes, in red, above themselves; `None` where they are those of the tick before.
pub fn changed_flashes(tick: u64, before: &[RobotView], now: &[RobotView]) -> Option<SceneUpdate> {
    let flashing =
        |robots: &[RobotView]| -> Vec<RobotView> { robots.iter().filter(|robot| robot.flash > 0).cloned().collect() };
    let part = |id: &String| PartStyle { id: format!("contact/{id}"), role: Role::Goal, z: 2.0 * ABOVE };
    let entities = parts(tick, &flashing(now), part);
    let old = parts(tick, &flashing(before), part);
    let ids = |entities: &[SceneEntity]| entities.iter().map(|e| e.id.clone()).collect::<Vec<_>>();
    if ids(&old) == ids(&entities) {
        return None;
    }
    Some(SceneUpdate { deletions: gone(tick, &old, &entities), entities })
}

/// How a part is drawn.
struct PartStyle {
    id: String,
    role: Role,
    z: f64,
}

/// An entity for each part of the robots, as `look` says for the part's frame.
fn parts(tick: u64, robots: &[RobotView], look: impl Fn(&String) -> PartStyle) -> Vec<SceneEntity> {
    let mut entities = Vec::new();
    for robot in robots {
        for (k, part) in robot.footprint.parts().iter().enumerate() {
            let frame_id = frames::of_part(&robot.name, k);
            let PartStyle { id, role, z } = look(&frame_id);
            let mut entity = SceneEntity { frame_id, id, frame_locked: true, ..empty(tick) };
            draw(&mut entity, &polygon_of(&part.shape().place(&Pose2::IDENTITY)), role, 0.85, z);
            entities.push(entity);
        }
    }
    entities
}

/// The paths of the whole run, a line for each robot, with a cross where each contact began.
pub fn paths(paths: &[RunPath]) -> SceneUpdate {
    let mut entities = Vec::new();
    for path in paths {
        let entity = |kind: &str| {
            let id = format!("{kind}/{}", path.robot);
            SceneEntity { id, frame_id: path.frame.clone(), ..empty(0) }
        };
        entities
            .push(SceneEntity { lines: vec![edge(&path.points, line::STRIP, Role::Path, ABOVE)], ..entity("path") });
        if !path.contacts.is_empty() {
            let ends = path.contacts.iter().flat_map(|&p| {
                [[-CROSS, -CROSS], [CROSS, CROSS], [-CROSS, CROSS], [CROSS, -CROSS]]
                    .map(|[x, y]| Point2::new(p.x + x, p.y + y))
            });
            let ends: Vec<Point2> = ends.collect();
            entities
                .push(SceneEntity { lines: vec![edge(&ends, line::LIST, Role::Goal, ABOVE)], ..entity("contacts") });
        }
    }
    SceneUpdate { deletions: Vec::new(), entities }
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
pub fn colour(role: Role, opacity: f64) -> Color {
    let [r, g, b] = Theme::Dark.palette().colour(role).0.map(|c| f64::from(c) / 255.0);
    Color { r, g, b, a: opacity }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Foxglove's schema of a scene's entity: a lifetime of 0 means that it stays until it is replaced or deleted.
    #[test]
    fn what_is_drawn_stays_until_it_is_replaced() {
        let entities = changed_worlds(0, &[], &[Arc::new(World::lot())]).unwrap().entities;
        assert!(entities.len() > 5, "walls, parked cars and marks");
        for entity in &entities {
            assert_eq!(entity.lifetime, Some(Duration { seconds: 0, nanos: 0 }), "{}", entity.id);
        }
    }
}
