//! The pairs of nearest points: the witness, and the pairs that tie with it.

use super::feature::{Feature, edges, feature_of};
use motion_lab_core::collision::{Collision, ObstacleId, Scene, Witness};
use motion_lab_core::geometry::{Footprint, Placed, Point2, Segment};
use motion_lab_core::num::hypot;

/// Largest difference between two distances that tie, metres: far above rounding, far below what a picture shows.
pub const TIE: f64 = 1e-9;

/// Two pairs count as one when their points are at most this far apart on both sides, metres.
const APART: f64 = 1e-6;

/// Largest number of pairs listed.
const MAX_PAIRS: usize = 8;

/// A pair of nearest points, and the features on which they lie.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NearestPair {
    /// The points, part and obstacle.
    pub witness: Witness,
    /// The feature of the robot on which the point a* lies.
    pub on_robot: Feature,
    /// The feature of the obstacle on which the point b* lies.
    pub on_obstacle: Feature,
}

/// The witness, then the pairs that tie with it within [`TIE`], by part and then in file order: at most eight in all.
/// Each tied pair has a corner or an end on at least one side. In contact the witness alone; empty in an empty scene.
///
/// The witness is the checker's. The others come from comparing every vertex of a part with every piece of the scene,
/// and the reverse. So for two parallel edges both ends of the nearest stretch are listed.
pub fn nearest_pairs(scene: &Scene, footprint: &Footprint) -> Vec<NearestPair> {
    let Some(first) = scene.witness(footprint) else { return Vec::new() };
    let mut found = vec![first];
    if first.dist > 0.0 {
        for (part, shape) in footprint.parts().iter().enumerate() {
            for (obstacle, piece) in scene.pieces() {
                for (on_robot, on_obstacle, dist) in candidates(shape.placed(), piece) {
                    let w = Witness { on_robot, on_obstacle, dist, part, obstacle };
                    if dist <= first.dist + TIE && found.len() < MAX_PAIRS && !found.iter().any(|f| one(f, &w)) {
                        found.push(w);
                    }
                }
            }
        }
    }
    found.into_iter().map(|witness| described(scene, footprint, witness)).collect()
}

/// Whether two pairs count as one.
fn one(a: &Witness, b: &Witness) -> bool {
    let near = |p: Point2, q: Point2| hypot(p.x - q.x, p.y - q.y) <= APART;
    near(a.on_robot, b.on_robot) && near(a.on_obstacle, b.on_obstacle)
}

fn described(scene: &Scene, footprint: &Footprint, witness: Witness) -> NearestPair {
    let on_robot =
        footprint.parts().get(witness.part).map_or(Feature::Inside, |p| feature_of(p.placed(), witness.on_robot));
    NearestPair { witness, on_robot, on_obstacle: on_obstacle(scene, witness.obstacle, witness.on_obstacle) }
}

/// The feature on which a point of an obstacle lies, from the piece that has the point on its border. An end that two
/// pieces share is a corner of the wall.
fn on_obstacle(scene: &Scene, obstacle: ObstacleId, p: Point2) -> Feature {
    let pieces = scene.pieces().filter(|(id, _)| *id == obstacle).map(|(_, piece)| feature_of(piece, p));
    let mut features: Vec<Feature> = pieces.filter(|f| *f != Feature::Inside).collect();
    let ends = features.iter().filter(|f| matches!(f, Feature::End(_))).count();
    match features.iter().position(|f| matches!(f, Feature::Corner(_) | Feature::End(_))) {
        Some(i) => match features.swap_remove(i) {
            Feature::End(p) if ends > 1 => Feature::Corner(p),
            feature => feature,
        },
        None => features.first().copied().unwrap_or(Feature::Inside),
    }
}

/// The pairs of a vertex of one shape's core and the nearest point on each edge of the other's, moved out by the radii,
/// with their distance.
fn candidates(a: &Placed, b: &Placed) -> Vec<(Point2, Point2, f64)> {
    let border = |core: &[Point2]| -> Vec<Segment> {
        if core.len() == 1 { vec![Segment::new(core[0], core[0])] } else { edges(core).collect() }
    };
    let mut out = Vec::new();
    for &p in a.core() {
        out.extend(border(b.core()).iter().map(|edge| (p, edge.closest_point(p))));
    }
    for &q in b.core() {
        out.extend(border(a.core()).iter().map(|edge| (edge.closest_point(q), q)));
    }
    out.into_iter()
        .map(|(p, q)| {
            let d = hypot(q.x - p.x, q.y - p.y);
            let way = if d > 0.0 { (q - p) / d } else { q - p };
            (p + way * a.radius(), q - way * b.radius(), d - a.radius() - b.radius())
        })
        .collect()
}
