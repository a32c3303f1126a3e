//! Tests of the built-in worlds and of reading and printing.

mod built_in;
mod refusals;
mod round_trip;
mod routes;
mod sizes;

use super::World;
use crate::geometry::{Placed, Point2, Segment, orientation};
use crate::num;

/// The exact distance from a point to a world's obstacles, 0 inside.
pub(super) fn point_distance(world: &World, p: Point2) -> f64 {
    let distances = world.obstacles.iter().flat_map(|o| o.placed()).map(|shape| shape_distance(&shape, p));
    distances.fold(f64::INFINITY, num::lesser)
}

fn shape_distance(shape: &Placed, p: Point2) -> f64 {
    let core = shape.core();
    let edge = |i: usize| (core[i], core[(i + 1) % core.len()]);
    if core.len() > 2 && (0..core.len()).all(|i| orientation(edge(i).0, edge(i).1, p) >= 0.0) {
        return 0.0;
    }
    let to_edge = |i: usize| (Segment::new(edge(i).0, edge(i).1).closest_point(p) - p).norm();
    num::greater(0.0, (0..core.len()).map(to_edge).fold(f64::INFINITY, num::lesser) - shape.radius())
}
