//! Edges of an arm of two links.

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::NonlinearRigidMotion;
use parry2d_f64::shape::Capsule;

use super::obstacles::Obstacles;
use super::samples::{Mover, contenders_of, first_contact};
use super::{Contender, Task};

/// How far the elbow may be from the line that a cast takes it along, metres: half of what samples leave out.
const ELBOW: f64 = 0.001;

struct Arm {
    base: Vector,
    lengths: [f64; 2],
    links: [Capsule; 2],
    obstacles: Obstacles,
}

/// A motion of the joints from `from` by `by`, and its number of samples.
struct Edge {
    from: [f64; 2],
    by: [f64; 2],
    samples: usize,
}

impl Arm {
    fn poses(&self, edge: &Edge, s: f64) -> [Pose; 2] {
        let [one, two] = [0, 1].map(|k| edge.from[k] + s * edge.by[k]);
        let first = Pose::new(self.base, one);
        let elbow = first * Vector::new(self.lengths[0], 0.0);
        [first, Pose::new(elbow, one + two)]
    }
}

impl Mover for Arm {
    type Edge = Edge;

    fn samples(edge: &Edge) -> usize {
        edge.samples
    }

    fn meets(&self, edge: &Edge, s: f64) -> bool {
        self.poses(edge, s).iter().zip(&self.links).any(|(pose, link)| self.obstacles.pieces.meets(pose, link))
    }

    /// The second link turns about an elbow that goes along the chords of its arc.
    fn cast(&self, edge: &Edge, any: bool) -> Option<f64> {
        let [turn, more] = edge.by;
        let pieces = (turn.abs() * (self.lengths[0] / (8.0 * ELBOW)).sqrt()).ceil().max(1.0);
        for piece in 0..pieces as usize {
            let [begin, end] = [piece, piece + 1].map(|k| self.poses(edge, k as f64 / pieces));
            let elbow = end[1].translation - begin[1].translation;
            let motions = [(begin[0], Vector::ZERO, turn), (begin[1], elbow, turn + more)];
            let mut first: Option<f64> = None;
            for ((start, velocity, turn), link) in motions.into_iter().zip(&self.links) {
                let motion = NonlinearRigidMotion::new(start, Vector::ZERO, velocity, turn / pieces);
                first = first_contact(&self.obstacles, link, &motion, first.unwrap_or(1.0), any).or(first);
                if any && first.is_some() {
                    break;
                }
            }
            if let Some(first) = first {
                return Some((piece as f64 + first) / pieces);
            }
        }
        None
    }
}

/// Settings: x and y of the base, both lengths, the radius. A case: both angles, by how much they change, the last
/// sample's number. The answer is the parameter of the first contact, or of some contact where only freedom is asked;
/// infinite without one.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    let [x, y, one, two, radius] = task.settings[..] else { return Vec::new() };
    let any = task.kind.ends_with("free");
    let link = |length: f64| Capsule::new(Vector::ZERO, Vector::new(length, 0.0), radius);
    let (base, obstacles) = (Vector::new(x, y), Obstacles::new(task));
    let arm = Arm { base, lengths: [one, two], links: [link(one), link(two)], obstacles };
    let edge = |c: &Vec<f64>| Edge { from: [c[0], c[1]], by: [c[2], c[3]], samples: c[4] as usize };
    contenders_of(arm, task.cases.iter().map(edge).collect(), any)
}
