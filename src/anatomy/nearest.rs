//! The pairs of nearest points: the witness, and those that tie with it.

use super::feature::{Feature, edges, feature_of};
use crate::collision::{Collision, ObstacleId, Scene, Witness};
use crate::geometry::{Footprint, Placed, Point2, Segment};
use crate::num::hypot;

/// Two distances that differ by no more than this tie, metres: far above what rounding does to them, far below what shows.
pub const TIE: f64 = 1e-9;

/// Pairs whose points are both nearer than this to another pair's are that pair, metres.
const APART: f64 = 1e-6;

/// At most this many pairs are told.
const MOST: usize = 8;

/// A pair of nearest points, and what they lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPair {
    /// The points, part and obstacle.
    pub witness: Witness,
    /// What the point a* lies on.
    pub on_robot: Feature,
    /// What the point b* lies on.
    pub on_obstacle: Feature,
}

/// The witness first, then every other pair of a corner or end and what is opposite that is as near, within [`TIE`]: by part,
/// then in file order, at most eight. In contact the witness alone; none in an empty scene.
///
/// The witness is the checker's. The others are found by comparing every vertex of a part with every piece of the scene and
/// the reverse, so that where two edges are parallel both ends of the stretch that is nearest are told.
pub fn nearest_pairs(scene: &Scene, footprint: &Footprint) -> Vec<NearestPair> {
    let Some(first) = scene.witness(footprint) else { return Vec::new() };
    let mut found = vec![first];
    if first.dist > 0.0 {
        for (part, shape) in footprint.parts().iter().enumerate() {
            for (obstacle, piece) in scene.pieces() {
                for (on_robot, on_obstacle, dist) in candidates(shape.placed(), piece) {
                    let w = Witness { on_robot, on_obstacle, dist, part, obstacle };
                    if dist <= first.dist + TIE && found.len() < MOST && !found.iter().any(|f| one(f, &w)) {
                        found.push(w);
                    }
                }
            }
        }
    }
    found.into_iter().map(|witness| described(scene, footprint, witness)).collect()
}

/// Whether two pairs are one.
fn one(a: &Witness, b: &Witness) -> bool {
    let near = |p: Point2, q: Point2| hypot(p.x - q.x, p.y - q.y) <= APART;
    near(a.on_robot, b.on_robot) && near(a.on_obstacle, b.on_obstacle)
}

fn described(scene: &Scene, footprint: &Footprint, witness: Witness) -> NearestPair {
    let on_robot =
        footprint.parts().get(witness.part).map_or(Feature::Inside, |p| feature_of(p.placed(), witness.on_robot));
    NearestPair { witness, on_robot, on_obstacle: on_obstacle(scene, witness.obstacle, witness.on_obstacle) }
}

/// What a point of an obstacle lies on: of its pieces the one that has it on its border. An end that two pieces share is a
/// corner of the wall.
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

/// The pairs of a vertex of one shape's core and the nearest point of the other's border, moved out by the radii, and how far
/// apart they are.
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
