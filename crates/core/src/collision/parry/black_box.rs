//! `ParryScene`, the chapter's black box: the four questions, answered by parry's own rounded queries.

use parry2d_f64::math::Vector;

use super::super::{Collision, ObstacleId, Scene, Witness};
use super::pieces::{ParryPieces, ParryShape};
use crate::geometry::{Footprint, Part, Placed, Point2, Vector2};

/// A scene whose questions parry2d-f64 answers, as the book's second chapter has it: parry's shapes under its tree of
/// bounding volumes, `intersection_test`, `closest_points`, `cast_shapes`. It stands beside the exact [`Scene`] that it
/// is made from, and numbers the obstacles as that does.
///
/// It keeps the contract of [`Collision`] as well as rounded arithmetic can. Kept are: touching counts as contact;
/// `intersects` exactly when `distance` is 0; the witness attains the distance; infinity and `None` in an empty scene;
/// what is not valid, or what parry has no shape or no answer for, is in contact; ties. Not kept are the exactness of
/// `intersects`, the 16 ulp of `distance` and the soundness of `swept`:
/// the page `docs/black-box.md` shows where it errs.
///
/// It proves nothing, and nothing can be proven by it: [`distance_of_hull`](Collision::distance_of_hull) is 0 and
/// [`clears`](Collision::clears) false, so a march through it finds no motion free.
///
/// ```
/// use motion_lab_core::collision::ParryScene;
/// use motion_lab_core::prelude::*;
/// let scene = Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))]);
/// let (black_box, rusty) = (ParryScene::of_scene(&scene), Footprint::disc(Point2::new(2.0, 1.0), 0.11));
/// assert!((black_box.distance(&rusty) - scene.distance(&rusty)).abs() < 1e-12);
/// ```
#[derive(Clone)]
pub struct ParryScene {
    pieces: ParryPieces,
    /// The obstacle of each piece.
    owners: Vec<ObstacleId>,
    /// The first obstacle with a piece that parry can't decide about: every footprint is in contact with it.
    undecided: Option<ObstacleId>,
}

impl std::fmt::Debug for ParryScene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParryScene").field("pieces", &self.owners.len()).finish_non_exhaustive()
    }
}

fn vector(p: Point2) -> Vector {
    Vector::new(p.x, p.y)
}

fn point(v: Vector) -> Point2 {
    Point2::new(v.x, v.y)
}

/// parry's shape for a placed one; `None` where parry can't decide about it.
fn shape_of(placed: &Placed) -> Option<ParryShape> {
    let core = || placed.core().iter().copied().map(vector).collect();
    placed.is_valid().then(|| ParryShape::of_core(core(), placed.radius())).flatten()
}

/// A part in contact, at a point of it.
fn contact(part: usize, obstacle: ObstacleId, at: Point2) -> Witness {
    Witness { on_robot: at, on_obstacle: at, dist: 0.0, part, obstacle }
}

/// The first vertex of a part's core.
fn some_point(part: &Part) -> Point2 {
    part.placed().core().first().copied().unwrap_or_default()
}

impl ParryScene {
    /// The obstacles of a scene in parry's own types.
    pub fn of_scene(scene: &Scene) -> Self {
        let (mut shapes, mut owners, mut undecided) = (Vec::new(), Vec::new(), None);
        for (obstacle, piece) in scene.pieces() {
            match shape_of(piece) {
                Some(shape) => {
                    shapes.push(shape);
                    owners.push(obstacle);
                }
                None => undecided = undecided.or(Some(obstacle)),
            }
        }
        ParryScene { pieces: ParryPieces::new(shapes), owners, undecided }
    }

    fn owner(&self, piece: u32) -> ObstacleId {
        self.owners[piece as usize]
    }

    /// The nearest points of a part, nearer than `limit`, metres.
    fn nearest(&self, number: usize, part: &Part, limit: f64) -> Option<Witness> {
        if let Some(obstacle) = self.undecided {
            return Some(contact(number, obstacle, some_point(part)));
        }
        let Some(ParryShape { pose, shape }) = shape_of(part.placed()) else {
            return self.owners.first().map(|obstacle| contact(number, *obstacle, some_point(part)));
        };
        let touching = |piece: u32| {
            let common = self.pieces.common_point(piece, &pose, &*shape);
            contact(number, self.owner(piece), common.map_or_else(|| some_point(part), point))
        };
        if let Some(piece) = self.pieces.first_met(&pose, &*shape) {
            return Some(touching(piece));
        }
        let near = self.pieces.first_nearest(&pose, &*shape, limit)?;
        match near.points {
            Some([a, b]) if near.distance > 0.0 => Some(Witness {
                on_robot: point(a),
                on_obstacle: point(b),
                dist: near.distance,
                part: number,
                obstacle: self.owner(near.piece),
            }),
            _ => Some(touching(near.piece)),
        }
    }

    /// The nearest points by `closest_points` alone, as the chapter's `witness` and `distance` have them. Segments that
    /// cross it calls some 1e-16 m apart, and a march that trusts that goes through a wall: the page
    /// `docs/black-box.md` shows one. [`witness`](Collision::witness) asks `intersection_test` first. `None` in an
    /// empty scene, and for a footprint or an obstacle that is not valid.
    pub fn closest_points(&self, footprint: &Footprint) -> Option<Witness> {
        let parts = footprint.parts().iter().enumerate().filter(|_| self.undecided.is_none() && footprint.is_valid());
        let near = parts.filter_map(|(number, part)| {
            let ParryShape { pose, shape } = shape_of(part.placed())?;
            let near = self.pieces.first_nearest(&pose, &*shape, f64::INFINITY)?;
            let [a, b] = near.points.map_or([some_point(part); 2], |points| points.map(point));
            let obstacle = self.owner(near.piece);
            Some(Witness { on_robot: a, on_obstacle: b, dist: near.distance, part: number, obstacle })
        });
        near.reduce(|best, near| if near.dist < best.dist { near } else { best })
    }

    /// How far a ray goes from a point in a direction, a vector of length 1, before parry says that it meets an
    /// obstacle, metres: 0 inside one, infinity where it meets none within `range`. 0 for numbers that are not finite.
    pub fn range(&self, from: Point2, direction: Vector2, range: f64) -> f64 {
        let is_finite = [from.x, from.y, direction.x, direction.y].into_iter().all(f64::is_finite) && !range.is_nan();
        if !is_finite || self.undecided.is_some() {
            return 0.0;
        }
        let direction = Vector::new(direction.x, direction.y);
        self.pieces.cast_ray(vector(from), direction, range).unwrap_or(f64::INFINITY)
    }
}

impl Collision for ParryScene {
    /// `intersection_test`, and where that says apart `closest_points` too, so that both agree.
    fn intersects(&self, footprint: &Footprint) -> bool {
        let meets = |at: ParryShape| self.pieces.meets(&at.pose, &*at.shape);
        footprint.parts().iter().any(|part| shape_of(part.placed()).is_some_and(meets))
            || self.distance(footprint) == 0.0
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        if !footprint.is_valid() {
            return 0.0;
        }
        self.witness(footprint).map_or(f64::INFINITY, |witness| witness.dist)
    }

    /// 0: parry's distances are no proof.
    fn distance_of_hull(&self, _hull: Placed) -> f64 {
        0.0
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        if !footprint.is_valid() {
            return None;
        }
        let mut best: Option<Witness> = None;
        for (number, part) in footprint.parts().iter().enumerate() {
            best = self.nearest(number, part, best.map_or(f64::INFINITY, |w| w.dist)).or(best);
            if best.is_some_and(|w| w.dist == 0.0) {
                break;
            }
        }
        best
    }

    /// `intersects` at either end, and `cast_shapes` of each part between: from its first pose along the straight line
    /// of its frame's origin, as the chapter casts. The cast does not turn.
    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        let [from, to] = [a.parts(), b.parts()];
        let is_same = from.len() == to.len() && from.iter().zip(to).all(|(p, q)| p.shape() == q.shape());
        if !is_same || self.intersects(a) || self.intersects(b) {
            return true;
        }
        from.iter().zip(to).any(|(p, q)| {
            let way = vector(q.pose().position()) - vector(p.pose().position());
            let casts = |at: ParryShape| self.pieces.cast(&at.pose, way, &*at.shape).is_some();
            way != Vector::ZERO && shape_of(p.placed()).is_some_and(casts)
        })
    }
}
