//! A disc along a line: free or not as one capsule, and its first contact by a cast.
//!
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/query/fn.cast_shapes.html>, with a small `max_time_of_impact`, as
//! its page on performance advises; the tree is searched as parry's own composite shapes search it.

use std::rc::Rc;

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::ClosestPoints;
use parry2d_f64::query::details::closest_points_segment_segment;
use parry2d_f64::shape::{Ball, Capsule, Segment, Shape};

use super::distances::nearest;
use super::obstacles::Obstacles;
use super::{By, Contender, Task};

fn ends(case: &[f64]) -> [Vector; 2] {
    [Vector::new(case[0], case[1]), Vector::new(case[2], case[3])]
}

/// The parameter of a disc's first contact from `a` to `b`; infinite without one.
fn cast(obstacles: &Obstacles, radius: f64, [a, b]: [Vector; 2]) -> f64 {
    obstacles.pieces.cast(&Pose::from_translation(a), b - a, &Ball::new(radius)).unwrap_or(f64::INFINITY)
}

/// Settings: the radius. A case: where the disc's centre begins and ends. The answer is 1 for free, 0 for not.
pub fn free(task: &Task) -> Vec<Box<dyn Contender>> {
    let radius = task.settings[0];
    let ways: Vec<[Vector; 2]> = task.cases.iter().map(|case| ends(case)).collect();
    let obstacles = Rc::new(Obstacles::new(task));
    let mut all: Vec<Box<dyn Contender>> = Vec::new();
    let (o, w) = (obstacles.clone(), ways.clone());
    all.push(Box::new(By {
        name: "parry, one capsule",
        ask: move |case: usize| {
            let [a, b] = w[case];
            f64::from(u8::from(!o.pieces.meets(&Pose::IDENTITY, &Capsule::new(a, b, radius))))
        },
    }));
    if obstacles.segments.len() == obstacles.pieces.shapes.len() {
        all.push(Box::new(By {
            name: "parry, segments' closest points",
            ask: move |case: usize| {
                let [a, b] = ways[case];
                let (way, around) = (Segment::new(a, b), Capsule::new(a, b, radius).local_aabb());
                let hit = obstacles.pieces.tree.intersect_aabb(&around).any(|i| {
                    let wall = &obstacles.segments[i as usize];
                    closest_points_segment_segment(&Pose::IDENTITY, &way, wall, radius) != ClosestPoints::Disjoint
                });
                f64::from(u8::from(!hit))
            },
        }));
    }
    all
}

/// As [`free`]. The answer is the parameter of the first contact. Without one, the first way answers infinity; the
/// second the clearance, negative.
pub fn hit(task: &Task) -> Vec<Box<dyn Contender>> {
    let radius = task.settings[0];
    let ways: Vec<[Vector; 2]> = task.cases.iter().map(|case| ends(case)).collect();
    let obstacles = Rc::new(Obstacles::new(task));
    let (o, w) = (obstacles.clone(), ways.clone());
    vec![
        Box::new(By { name: "parry, cast alone", ask: move |case: usize| cast(&o, radius, w[case]) }),
        Box::new(By {
            name: "parry, cast and clearance",
            ask: move |case: usize| {
                let [a, b] = ways[case];
                let way = Segment::new(a, b);
                let (distance, points) = nearest(&obstacles, std::iter::once(&way as &dyn Shape), f64::INFINITY);
                std::hint::black_box(points);
                if distance > radius { radius - distance } else { cast(&obstacles, radius, [a, b]) }
            },
        }),
    ]
}
