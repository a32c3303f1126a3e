//! Imported worlds: each format by a small sample with known walls.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

mod cells;
mod drawing;
mod images;
mod irsim;
mod irsim_limits;
mod movingai;
mod svg;

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::worlds::World;

/// A file of `tests/samples`.
fn sample(name: &str) -> String {
    std::fs::read_to_string(format!("{}/../../tests/samples/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The points of a wall, without the last one where the wall is closed.
fn corners(world: &World, name: &str) -> Vec<(f64, f64)> {
    let placed: Vec<_> = world.obstacle(name).unwrap().placed().collect();
    placed.iter().map(|p| (p.core()[0].x, p.core()[0].y)).collect()
}

/// Whether an obstacle lies within 1 mm of a point.
fn is_hit(world: &World, x: f64, y: f64) -> bool {
    Scene::of_world(world).intersects(&Footprint::disc(Point2::new(x, y), 1e-3))
}

/// Checks that reading the world's own text gives the same world, bytes and hash.
#[track_caller]
fn assert_prints_as_itself(world: &World) {
    let text = world.to_ron();
    let again = World::parse("printed", &text).unwrap();
    assert_eq!(&again, world);
    assert_eq!((again.to_ron(), again.content_hash()), (text, world.content_hash()));
}
