//! Edges of a car: one rectangle, whose reference point goes along a line while it turns.

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::NonlinearRigidMotion;
use parry2d_f64::shape::Cuboid;

use super::obstacles::Obstacles;
use super::samples::{Mover, contenders_of, first_contact};
use super::{Contender, Task};

struct Car {
    /// From the reference point to the rectangle's middle, in the car's frame.
    middle: Vector,
    body: Cuboid,
    obstacles: Obstacles,
}

/// A motion from a place and heading, and its number of samples.
struct Edge {
    from: Vector,
    heading: f64,
    by: Vector,
    turn: f64,
    samples: usize,
}

impl Car {
    fn pose(&self, edge: &Edge, s: f64) -> Pose {
        Pose::new(edge.from + edge.by * s, edge.heading + edge.turn * s) * Pose::from_translation(self.middle)
    }
}

impl Mover for Car {
    type Edge = Edge;

    fn samples(edge: &Edge) -> usize {
        edge.samples
    }

    fn meets(&self, edge: &Edge, s: f64) -> bool {
        self.obstacles.pieces.meets(&self.pose(edge, s), &self.body)
    }

    fn cast(&self, edge: &Edge, any: bool) -> Option<f64> {
        let motion = NonlinearRigidMotion::new(self.pose(edge, 0.0), -self.middle, edge.by, edge.turn);
        first_contact(&self.obstacles, &self.body, &motion, 1.0, any)
    }
}

/// Settings: the rectangle's middle in the car's frame, and its half sides. A case: x, y and heading, by how much each
/// changes, the last sample's number. The answer is as for the arm.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    let [x, y, half_length, half_width] = task.settings[..] else { return Vec::new() };
    let any = task.kind.ends_with("free");
    let body = Cuboid::new(Vector::new(half_length, half_width));
    let car = Car { middle: Vector::new(x, y), body, obstacles: Obstacles::new(task) };
    let edge = |c: &Vec<f64>| Edge {
        from: Vector::new(c[0], c[1]),
        heading: c[2],
        by: Vector::new(c[3], c[4]),
        turn: c[5],
        samples: c[6] as usize,
    };
    contenders_of(car, task.cases.iter().map(edge).collect(), any)
}
