//! `ParryPieces`, placed shapes in parry's own types under its tree, and parry's queries about them.
//!
//! This file uses nothing but parry. So the rivals of the table of times are this code too, compiled with parry as its
//! users build it (`benches/table/rivals`).
//!
//! The tree's page advises `Ploc` where the scene stays and queries matter more than building:
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/partitioning/enum.BvhBuildStrategy.html>

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost, BvhNode};
use parry2d_f64::query::{self, ClosestPoints, Ray, RayCast, ShapeCastOptions};
use parry2d_f64::shape::{Ball, Capsule, ConvexPolygon, RoundShape, Segment, Shape, SharedShape};

/// How much later than at a motion's end a cast may report its hit and still count.
const END: f64 = 1e-12;

/// How often a point is projected on both of two shapes that touch: it comes to a point of both.
const PROJECTIONS: u32 = 256;

/// One of parry's shapes where it stands.
#[derive(Clone)]
pub struct ParryShape {
    /// Its frame: the identity for what has its vertices in world coordinates.
    pub pose: Pose,
    /// The shape in its frame.
    pub shape: SharedShape,
}

impl ParryShape {
    /// All points within `radius` metres of the convex core with these vertices, in world coordinates: a ball for one
    /// vertex, a segment or a capsule for two, else a polygon with its vertices counter-clockwise. `None` where parry
    /// has no such shape: without a vertex, or with two neighbours that are one point to it.
    pub fn of_core(core: Vec<Vector>, radius: f64) -> Option<Self> {
        let is_round = radius > 0.0;
        let shape = match core[..] {
            [] => return None,
            [centre] => {
                return Some(ParryShape {
                    pose: Pose::from_translation(centre),
                    shape: SharedShape::new(Ball::new(radius)),
                });
            }
            [a, b] if is_round => SharedShape::new(Capsule::new(a, b, radius)),
            [a, b] => SharedShape::new(Segment::new(a, b)),
            _ => {
                let inner_shape = ConvexPolygon::from_convex_polyline_unmodified(core)?;
                if is_round {
                    SharedShape::new(RoundShape { inner_shape, border_radius: radius })
                } else {
                    SharedShape::new(inner_shape)
                }
            }
        };
        Some(ParryShape { pose: Pose::IDENTITY, shape })
    }
}

/// The piece nearest to a shape, by parry.
#[derive(Clone, Copy, Debug)]
pub struct ParryNearest {
    /// The piece's number.
    pub piece: u32,
    /// The distance, metres; 0 on contact, and for a pair that parry can't decide.
    pub distance: f64,
    /// The nearest points, on the shape and on the piece; `None` where parry says that they overlap.
    pub points: Option<[Vector; 2]>,
}

impl BvhLeafCost for ParryNearest {
    fn cost(&self) -> f64 {
        self.distance
    }
}

/// Placed shapes in parry's own types, numbered from 0, under its tree of bounding volumes.
#[derive(Clone)]
pub struct ParryPieces {
    /// The shapes.
    pub shapes: Vec<ParryShape>,
    /// The tree of their boxes.
    pub tree: Bvh,
}

/// The radius of a shape around its core, metres.
fn radius(shape: &dyn Shape) -> f64 {
    let round = shape.as_round_convex_polygon().map(|round| round.border_radius);
    let ball = || shape.as_ball().map(|ball| ball.radius);
    round.or_else(ball).or_else(|| shape.as_capsule().map(|capsule| capsule.radius)).unwrap_or(0.0)
}

/// A shape's core: its point, segment or polygon.
fn core(shape: &dyn Shape) -> Box<dyn Shape> {
    if let Some(round) = shape.as_round_convex_polygon() {
        Box::new(round.inner_shape.clone())
    } else if let Some(capsule) = shape.as_capsule() {
        Box::new(capsule.segment)
    } else if shape.as_ball().is_some() {
        Box::new(Ball::new(0.0))
    } else {
        shape.clone_dyn()
    }
}

/// The distance of two boxes, metres.
fn gap(around: &Aabb, node: &BvhNode) -> f64 {
    let (below, above) = (node.mins() - around.maxs, around.mins - node.maxs());
    below.max(above).max(Vector::ZERO).length()
}

impl ParryPieces {
    /// These shapes.
    pub fn new(shapes: Vec<ParryShape>) -> Self {
        let boxes: Vec<Aabb> = shapes.iter().map(|at| at.shape.compute_aabb(&at.pose)).collect();
        ParryPieces { shapes, tree: Bvh::from_leaves(BvhBuildStrategy::Ploc, &boxes) }
    }

    fn at(&self, piece: u32) -> &ParryShape {
        &self.shapes[piece as usize]
    }

    fn touches(&self, piece: u32, pose: &Pose, shape: &dyn Shape) -> bool {
        let ParryShape { pose: there, shape: other } = self.at(piece);
        query::intersection_test(pose, shape, there, &**other).map_or(true, |test| test.intersecting)
    }

    /// Whether a shape meets any piece; stops at the first.
    pub fn meets(&self, pose: &Pose, shape: &dyn Shape) -> bool {
        let around = shape.compute_aabb(pose);
        self.tree.intersect_aabb(&around).any(|piece| self.touches(piece, pose, shape))
    }

    /// The lowest number of a piece that a shape meets.
    pub fn first_met(&self, pose: &Pose, shape: &dyn Shape) -> Option<u32> {
        let around = shape.compute_aabb(pose);
        self.tree.intersect_aabb(&around).filter(|piece| self.touches(*piece, pose, shape)).min()
    }

    /// The nearest points of a shape and one piece; `None` where they are farther apart than `limit`, metres. A small
    /// limit lets far pairs end early.
    pub fn pair(&self, piece: u32, pose: &Pose, shape: &dyn Shape, limit: f64) -> Option<ParryNearest> {
        let ParryShape { pose: there, shape: other } = self.at(piece);
        match query::closest_points(pose, shape, there, &**other, limit) {
            Ok(ClosestPoints::Disjoint) => None,
            Ok(ClosestPoints::WithinMargin(a, b)) if a.distance(b) >= 0.0 => {
                Some(ParryNearest { piece, distance: a.distance(b), points: Some([a, b]) })
            }
            // NaN, or a pair that parry does not know: contact rather than free
            Ok(_) | Err(_) => Some(ParryNearest { piece, distance: 0.0, points: None }),
        }
    }

    /// The piece nearest to a shape, nearer than `limit`, metres; some piece where several are.
    pub fn nearest(&self, pose: &Pose, shape: &dyn Shape, limit: f64) -> Option<ParryNearest> {
        let around = shape.compute_aabb(pose);
        let found =
            self.tree.find_best(limit, |node, _| gap(&around, node), |piece, best| self.pair(piece, pose, shape, best));
        found.map(|(_, nearest)| nearest)
    }

    /// As [`nearest`](Self::nearest), and of several pieces that are as near the one with the lowest number.
    pub fn first_nearest(&self, pose: &Pose, shape: &dyn Shape, limit: f64) -> Option<ParryNearest> {
        let mut first = self.nearest(pose, shape, limit)?;
        let (around, least) = (shape.compute_aabb(pose), first.distance);
        for piece in self.tree.leaves(|node| gap(&around, node) <= least) {
            if piece < first.piece
                && let Some(near) = self.pair(piece, pose, shape, f64::INFINITY).filter(|near| near.distance == least)
            {
                first = near;
            }
        }
        Some(first)
    }

    /// A point of both a shape and a piece that it touches, as near as parry comes to one; `None` where that is no
    /// number. Of round shapes it lies on the line between the nearest points of their cores, else it is got by
    /// projecting a point on one and the other in turn.
    pub fn common_point(&self, piece: u32, pose: &Pose, shape: &dyn Shape) -> Option<Vector> {
        let there = self.at(piece);
        let ([own, other], [reach, _]) = ([core(shape), core(&*there.shape)], [shape, &*there.shape].map(radius));
        if let Ok(ClosestPoints::WithinMargin(a, b)) =
            query::closest_points(pose, &*own, &there.pose, &*other, f64::INFINITY)
        {
            let apart = a.distance(b);
            let share = if reach < apart { reach / apart } else { 1.0 };
            return Some(a + (b - a) * share).filter(|point| point.is_finite());
        }
        let contact = query::contact(pose, &*own, &there.pose, &*other, 0.0).ok().flatten();
        let mut point = contact.map_or_else(|| shape.compute_aabb(pose).center(), |contact| contact.point1);
        for _ in 0..PROJECTIONS {
            let before = point;
            let across = other.project_point(&there.pose, point, true).point;
            point = own.project_point(pose, across, true).point;
            if point == before {
                break;
            }
        }
        point.is_finite().then_some(point)
    }

    /// When a shape that moves by `way` without turning first meets a piece, from 0 to 1; `None` where it does not.
    /// The shape's box is cast against the tree as parry's own composite shapes cast theirs.
    pub fn cast(&self, pose: &Pose, way: Vector, shape: &dyn Shape) -> Option<f64> {
        let around = shape.compute_aabb(pose);
        let (ray, margin) = (Ray::new(around.center(), way), around.half_extents());
        let found = self.tree.find_best(
            1.0 + END,
            |node, best| {
                let fat = Aabb { mins: node.mins() - margin, maxs: node.maxs() + margin };
                fat.cast_local_ray(&ray, best, true).unwrap_or(f64::MAX)
            },
            |piece, best| {
                let ParryShape { pose: there, shape: other } = self.at(piece);
                let options = ShapeCastOptions::with_max_time_of_impact(if best < 1.0 { best } else { 1.0 });
                // a pair that parry does not know: contact rather than free
                let hit = query::cast_shapes(pose, way, shape, there, Vector::ZERO, &**other, options);
                hit.map_or(Some(0.0), |hit| hit.map(|hit| hit.time_of_impact))
            },
        );
        found.map(|(_, time)| time)
    }

    /// How far a ray goes from a point in a direction of length 1 before it meets a piece, metres; 0 inside one, `None`
    /// where it meets none within `range`.
    pub fn cast_ray(&self, from: Vector, direction: Vector, range: f64) -> Option<f64> {
        let ray = Ray::new(from, direction);
        let found = self.tree.cast_ray(&ray, range, |piece, best| {
            let ParryShape { pose, shape } = self.at(piece);
            shape.cast_ray(pose, &ray, best, true)
        });
        found.map(|(_, range)| range)
    }
}
