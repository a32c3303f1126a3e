//! The same queries by parry2d-f64 in its usual way: its shapes under its bounding-volume tree.

use motion_lab::geometry::{Footprint, Part, Placed, Point2, Pose2};
use parry2d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use parry2d_f64::query::{self, Ray, RayCast, ShapeCastOptions};
use parry2d_f64::shape::{Ball, Capsule, ConvexPolygon, Cuboid, Segment, Shape};

/// Obstacles in world coordinates under one tree.
pub struct Peer {
    shapes: Vec<Box<dyn Shape>>,
    /// The obstacles as segments, where all are segments.
    segments: Vec<Segment>,
    tree: Bvh,
}

fn vector(p: &Point2) -> Vector {
    Vector::new(p.x, p.y)
}

/// A placed shape as parry's, in world coordinates.
pub fn shape(placed: &Placed) -> Box<dyn Shape> {
    let (core, radius) = (placed.core(), placed.radius());
    match core {
        [_] => Box::new(Ball::new(radius)),
        [a, b] if radius > 0.0 => Box::new(Capsule::new(vector(a), vector(b), radius)),
        [a, b] => Box::new(Segment::new(vector(a), vector(b))),
        _ => Box::new(ConvexPolygon::from_convex_polyline(core.iter().map(vector).collect()).expect("convex")),
    }
}

impl Peer {
    pub fn new<'a>(obstacles: impl Iterator<Item = &'a Placed>) -> Self {
        let shapes: Vec<Box<dyn Shape>> = obstacles.map(shape).collect();
        let boxes: Vec<Aabb> = shapes.iter().map(|s| s.compute_local_aabb()).collect();
        let segments = shapes.iter().filter_map(|s| s.as_segment().copied()).collect();
        Peer { shapes, segments, tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    pub fn scan(&self, (x, y): (f64, f64), directions: &[(f64, f64)], range: f64, ranges: &mut [f64]) {
        for ((dx, dy), r) in directions.iter().zip(ranges) {
            let ray = Ray::new(Vector::new(x, y), Vector::new(*dx, *dy));
            let hit =
                self.tree.cast_ray(&ray, range, |i, best| self.segments[i as usize].cast_local_ray(&ray, best, true));
            *r = hit.map_or(f64::INFINITY, |(_, t)| t);
        }
    }

    fn nearest(&self, part: &dyn Shape) -> Option<(u32, f64)> {
        let around = part.compute_local_aabb();
        self.tree.find_best(
            f64::INFINITY,
            |node: &BvhNode, _| {
                let (min, max) = (node.mins(), node.maxs());
                let gap = |a0: f64, a1: f64, b0: f64, b1: f64| (b0 - a1).max(a0 - b1).max(0.0);
                let dx = gap(around.mins.x, around.maxs.x, min.x, max.x);
                let dy = gap(around.mins.y, around.maxs.y, min.y, max.y);
                (dx * dx + dy * dy).sqrt()
            },
            |i, _| {
                let obstacle = &*self.shapes[i as usize];
                query::distance(&Pose::IDENTITY, part, &Pose::IDENTITY, obstacle).ok().map(|d| d.distance)
            },
        )
    }

    /// The distance and its witnesses, over all parts.
    pub fn distance(&self, footprint: &Footprint) -> f64 {
        let mut best = f64::INFINITY;
        let mut nearest = None;
        for part in footprint.parts() {
            let part = shape_on_stack(part.placed());
            if let Some((i, d)) = self.nearest(part.as_dyn())
                && d < best
            {
                best = d;
                nearest = Some((part, i));
            }
        }
        if let Some((part, i)) = nearest {
            let obstacle = &*self.shapes[i as usize];
            let points = query::closest_points(&Pose::IDENTITY, part.as_dyn(), &Pose::IDENTITY, obstacle, f64::MAX);
            std::hint::black_box(points.ok());
        }
        best
    }

    pub fn intersects(&self, footprint: &Footprint) -> bool {
        footprint.parts().iter().any(|part| {
            let (pose, part) = posed(part);
            let around = part.as_dyn().compute_aabb(&pose);
            self.tree.intersect_aabb(&around).any(|i| {
                let obstacle = &*self.shapes[i as usize];
                let test = query::intersection_test(&pose, part.as_dyn(), &Pose::IDENTITY, obstacle);
                test.is_ok_and(|t| t.intersecting)
            })
        })
    }

    /// The parameter of a disc's first contact along `way`; `None` without one.
    pub fn disc_line(&self, radius: f64, from: (f64, f64), way: (f64, f64)) -> Option<f64> {
        let (ball, at, way) = (Ball::new(radius), Vector::new(from.0, from.1), Vector::new(way.0, way.1));
        let pose = Pose::from_translation(at);
        let start = ball.compute_aabb(&pose);
        let swept = start.merged(&ball.compute_aabb(&Pose::from_translation(at + way)));
        let options = ShapeCastOptions::with_max_time_of_impact(1.0);
        let mut first = None;
        for i in self.tree.intersect_aabb(&swept) {
            let obstacle = &*self.shapes[i as usize];
            let hit = query::cast_shapes(&pose, way, &ball, &Pose::IDENTITY, Vector::ZERO, obstacle, options);
            if let Ok(Some(hit)) = hit
                && first.is_none_or(|f| hit.time_of_impact < f)
            {
                first = Some(hit.time_of_impact);
            }
        }
        first
    }
}

/// Rectangles as parry's cuboids, each with its pose.
pub struct Cuboids(Vec<(Pose, Cuboid)>);

impl Cuboids {
    /// Cuboids from rectangles whose frames are at their middles.
    pub fn new(rects: &[(Pose2, Point2, Point2)]) -> Self {
        let cuboid = |(pose, _, max): &(Pose2, Point2, Point2)| {
            (Pose::new(vector(&pose.position()), pose.theta), Cuboid::new(vector(max)))
        };
        Cuboids(rects.iter().map(cuboid).collect())
    }

    pub fn touch(&self, a: usize, b: usize) -> bool {
        let ((at, cuboid), (there, other)) = (&self.0[a], &self.0[b]);
        query::intersection_test(at, cuboid, there, other).is_ok_and(|t| t.intersecting)
    }
}

/// A part's shape without a heap allocation, as for speed.
pub enum PartShape {
    Ball(Ball),
    Capsule(Capsule),
    Segment(Segment),
    Polygon(ConvexPolygon),
    Cuboid(Cuboid),
}

impl PartShape {
    fn as_dyn(&self) -> &dyn Shape {
        match self {
            PartShape::Ball(s) => s,
            PartShape::Capsule(s) => s,
            PartShape::Segment(s) => s,
            PartShape::Polygon(s) => s,
            PartShape::Cuboid(s) => s,
        }
    }
}

/// A part with its pose: a rectangle as parry's cuboid, any other shape in world coordinates.
fn posed(part: &Part) -> (Pose, PartShape) {
    match part.shape() {
        motion_lab::geometry::Shape::Rectangle { min, max } => {
            let (half, middle) = ((max - min) * 0.5, part.pose().transform(min + (max - min) * 0.5));
            let cuboid = Cuboid::new(Vector::new(half.x, half.y));
            (Pose::new(vector(&middle), part.pose().theta), PartShape::Cuboid(cuboid))
        }
        motion_lab::geometry::Shape::Disc { .. } => {
            (Pose::from_translation(vector(&part.pose().position())), shape_on_stack(part.placed()))
        }
        _ => (Pose::IDENTITY, shape_on_stack(part.placed())),
    }
}

pub fn shape_on_stack(placed: &Placed) -> PartShape {
    let (core, radius) = (placed.core(), placed.radius());
    match core {
        [_] => PartShape::Ball(Ball::new(radius)),
        [a, b] if radius > 0.0 => PartShape::Capsule(Capsule::new(vector(a), vector(b), radius)),
        [a, b] => PartShape::Segment(Segment::new(vector(a), vector(b))),
        _ => {
            PartShape::Polygon(ConvexPolygon::from_convex_polyline(core.iter().map(vector).collect()).expect("convex"))
        }
    }
}
