//! Obstacles in parry's own types, under its tree of bounding volumes.
//!
//! The tree's page advises `Ploc` where the scene stays and queries matter more than building:
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/partitioning/enum.BvhBuildStrategy.html>

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry2d_f64::query;
use parry2d_f64::shape::{Ball, Capsule, ConvexPolygon, RoundShape, Segment, Shape};

use super::Task;

pub struct Obstacles {
    /// Where each shape stands: the identity for what has its vertices in world coordinates.
    pub shapes: Vec<(Pose, Box<dyn Shape>)>,
    /// The obstacles as segments, where all are segments.
    pub segments: Vec<Segment>,
    pub tree: Bvh,
}

/// A placed shape: a radius, then the vertices of the core.
fn shape(numbers: &[f64]) -> (Pose, Box<dyn Shape>) {
    let radius = numbers[0];
    let core: Vec<Vector> = numbers[1..].chunks(2).map(|p| Vector::new(p[0], p[1])).collect();
    let shape: Box<dyn Shape> = match core[..] {
        [centre] => return (Pose::from_translation(centre), Box::new(Ball::new(radius))),
        [a, b] if radius > 0.0 => Box::new(Capsule::new(a, b, radius)),
        [a, b] => Box::new(Segment::new(a, b)),
        _ => {
            let inner_shape = ConvexPolygon::from_convex_polyline(core).expect("a convex core");
            if radius > 0.0 {
                Box::new(RoundShape { inner_shape, border_radius: radius })
            } else {
                Box::new(inner_shape)
            }
        }
    };
    (Pose::IDENTITY, shape)
}

impl Obstacles {
    pub fn new(task: &Task) -> Self {
        let shapes: Vec<_> = task.obstacles.iter().map(|numbers| shape(numbers)).collect();
        let boxes: Vec<Aabb> = shapes.iter().map(|(pose, shape)| shape.compute_aabb(pose)).collect();
        let segments = shapes.iter().filter_map(|(_, shape)| shape.as_segment().copied()).collect();
        Obstacles { shapes, segments, tree: Bvh::from_leaves(BvhBuildStrategy::Ploc, &boxes) }
    }

    /// Whether a shape meets any obstacle; stops at the first.
    pub fn meet(&self, pose: &Pose, shape: &dyn Shape) -> bool {
        let around = shape.compute_aabb(pose);
        self.tree.intersect_aabb(&around).any(|i| {
            let (at, obstacle) = &self.shapes[i as usize];
            query::intersection_test(pose, shape, at, &**obstacle).is_ok_and(|test| test.intersecting)
        })
    }
}
