//! A task's obstacles as the lab's black box has them: its pieces in parry's own types, under its tree.

use parry2d_f64::math::Vector;
use parry2d_f64::shape::Segment;

use super::Task;
use super::pieces::{ParryPieces, ParryShape};

pub struct Obstacles {
    pub pieces: ParryPieces,
    /// The obstacles as segments, where all are segments.
    pub segments: Vec<Segment>,
}

/// A placed shape: a radius, then the vertices of the core.
fn shape(numbers: &[f64]) -> ParryShape {
    let core = numbers[1..].chunks(2).map(|p| Vector::new(p[0], p[1])).collect();
    ParryShape::of_core(core, numbers[0]).expect("a convex core")
}

impl Obstacles {
    pub fn new(task: &Task) -> Self {
        let shapes: Vec<ParryShape> = task.obstacles.iter().map(|numbers| shape(numbers)).collect();
        let segments = shapes.iter().filter_map(|at| at.shape.as_segment().copied()).collect();
        Obstacles { pieces: ParryPieces::new(shapes), segments }
    }
}
