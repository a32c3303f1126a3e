//! The distance of an arm, with its witnesses: one query, whose limit is the best so far over both links.
//!
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/query/fn.closest_points.html>: a small limit lets far pairs end
//! early.

use std::rc::Rc;

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::shape::{Capsule, Segment, Shape};

use super::obstacles::Obstacles;
use super::{By, Contender, Task};

/// The least distance of some shapes in world coordinates, and the witnesses.
pub fn nearest<'a>(
    obstacles: &Obstacles,
    shapes: impl Iterator<Item = &'a dyn Shape>,
    limit: f64,
) -> (f64, Option<[Vector; 2]>) {
    let mut nearest = (limit, None);
    for shape in shapes {
        if let Some(near) = obstacles.pieces.nearest(&Pose::IDENTITY, shape, nearest.0) {
            nearest = (near.distance, near.points);
        }
        if nearest.0 <= 0.0 {
            break;
        }
    }
    nearest
}

/// Settings: the links' radius. A case: the ends of each link. The second way leaves the radius out and subtracts it,
/// which spares parry's iteration the round ends.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    let radius = task.settings[0];
    let points = |link: &[f64]| [Vector::new(link[0], link[1]), Vector::new(link[2], link[3])];
    let links: Vec<Vec<[Vector; 2]>> = task.cases.iter().map(|case| case.chunks(4).map(points).collect()).collect();
    let capsules: Vec<Vec<Capsule>> =
        links.iter().map(|arm| arm.iter().map(|[a, b]| Capsule::new(*a, *b, radius)).collect()).collect();
    let segments: Vec<Vec<Segment>> =
        links.iter().map(|arm| arm.iter().map(|[a, b]| Segment::new(*a, *b)).collect()).collect();
    let obstacles = Rc::new(Obstacles::new(task));
    let same = obstacles.clone();
    vec![
        Box::new(By {
            name: "parry",
            ask: move |case: usize| {
                let (distance, points) =
                    nearest(&obstacles, capsules[case].iter().map(|c| c as &dyn Shape), f64::INFINITY);
                std::hint::black_box(points);
                distance
            },
        }),
        Box::new(By {
            name: "parry, radius subtracted",
            ask: move |case: usize| {
                let (distance, points) = nearest(&same, segments[case].iter().map(|s| s as &dyn Shape), f64::INFINITY);
                std::hint::black_box(points);
                if distance > radius { distance - radius } else { 0.0 }
            },
        }),
    ]
}
