//! What a world that was read must be good for.

use motion_lab::collision::{Collision, Scene};
use motion_lab::robots::{AnyRobot, Robot};
use motion_lab::worlds::World;

/// Most shapes of a world whose scene is built: that of more takes longer than an input may.
const MAX_SHAPES: usize = 3000;

/// Checks that a world's text reads back as the same world, in one text, and that its scene answers for every robot
/// at its start: the distance is a number from 0 on, infinite in an empty scene alone, and 0 exactly where they touch.
pub fn check(world: &World) {
    let text = world.to_ron();
    let again = World::parse_recorded("again", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(again, *world, "{text}");
    assert_eq!(again.to_ron(), text);
    assert_eq!(again.content_hash(), world.content_hash());
    let shapes: usize = world.obstacles.iter().map(|obstacle| obstacle.pieces.len()).sum();
    if shapes > MAX_SHAPES {
        return;
    }
    let scene = Scene::of_world(world);
    for (robot, q) in world.robots.iter().filter_map(AnyRobot::of_resident).take(20) {
        let footprint = robot.footprint(&q);
        let distance = scene.distance(&footprint);
        assert!(distance >= 0.0, "{distance}\n{text}");
        assert_eq!(distance == f64::INFINITY, scene.obstacle_count() == 0, "{distance}\n{text}");
        assert_eq!(distance == 0.0, scene.intersects(&footprint), "{distance}\n{text}");
        if let Some(witness) = scene.witness(&footprint) {
            assert_eq!(witness.dist.to_bits(), distance.to_bits(), "{text}");
        }
    }
}
