//! Checks of worlds whose files are valid: residents that touch something, obstacles outside the bounds.

use motion_lab_core::collision::{ObstacleId, Scene};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::Footprint;
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::{Door, Obstacle, ObstacleKind, World};

/// The largest number of problems reported for one world.
const MAX_REPORTED: usize = 10;

/// The problems of a world, each by name: residents that touch an obstacle or one another at their starts, and
/// obstacles wholly outside the bounds. Robots of a program's own kinds are left out.
pub fn problems(world: &World) -> Vec<String> {
    let footprint = |resident| AnyRobot::of_resident(resident).map(|(robot, q)| robot.footprint(&q));
    let residents: Vec<(&str, Footprint)> =
        world.robots.iter().filter_map(|r| Some((r.name.as_str(), footprint(r)?))).collect();
    let scene = Scene::of_world(world);
    let in_contact = residents.iter().filter_map(|(name, footprint)| {
        let obstacle = scene.obstacle_name(*scene.touched(footprint).first()?)?;
        Some(format!("{name:?} starts in contact with {obstacle:?}"))
    });
    let crowd = &crowd(world, &residents);
    let neighbours = residents.iter().zip(0..).flat_map(|((name, footprint), i)| {
        let after = crowd.touched(footprint).into_iter().filter(move |other| *other > ObstacleId(i));
        after.map(move |other| {
            format!("{name:?} and {:?} touch at their starts", crowd.obstacle_name(other).unwrap_or("?"))
        })
    });
    in_contact.chain(neighbours).chain(outside(world)).take(MAX_REPORTED).collect()
}

/// The robots of kinds that the lab does not have, whose starts are not checked; `None` when there are none.
pub fn unknown(world: &World) -> Option<String> {
    let strangers = world.robots.iter().filter(|r| RobotKind::of(&r.kind).is_none());
    let named: Vec<String> =
        strangers.map(|r| format!("{:?} of the kind {:?}", r.name, r.kind)).take(MAX_REPORTED).collect();
    (!named.is_empty()).then(|| format!("not checked, as this program has no such kind: {}", named.join(", ")))
}

/// The residents as the obstacles of a scene, in their order.
fn crowd(world: &World, residents: &[(&str, Footprint)]) -> Scene {
    let obstacle = |(name, footprint): &(&str, Footprint)| {
        let pieces = footprint.parts().iter().map(|part| (*part.pose(), part.shape().clone())).collect();
        Obstacle::new(*name, ObstacleKind::Solid, pieces)
    };
    let obstacles = residents.iter().map(obstacle).collect();
    Scene::of_world(&World { obstacles, ..World::empty("", world.bounds) })
}

/// The obstacles wholly outside the bounds, by the bounding boxes of their pieces.
fn outside(world: &World) -> impl Iterator<Item = String> {
    let things = world.obstacles.iter().cloned().chain(world.doors.iter().map(Door::leaf));
    let beyond = things.filter(move |obstacle| {
        obstacle.pieces.iter().all(|(pose, shape)| shape.place(pose).bounds().is_apart(&world.bounds))
    });
    beyond.map(|obstacle| format!("{:?} lies outside the bounds", obstacle.name))
}
