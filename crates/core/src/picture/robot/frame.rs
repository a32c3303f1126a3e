//! Areas and lines in a part's frame, for the marks on a robot.

use crate::geometry::{Point2, Pose2, Shape};
use crate::picture::{Drawing, polygon_of};

/// A rectangle about the origin of `pose`, with these half sizes along and across it.
pub fn rectangle(pose: &Pose2, [along, across]: [f64; 2]) -> Drawing {
    let corners = [(along, across), (-along, across), (-along, -across), (along, -across)];
    Drawing::Polygon(placed(pose, &corners))
}

/// A rectangle in the frame of `pose`, its corners rounded by `radius`, which half of its sides exceed.
pub fn rounded(pose: &Pose2, min: Point2, max: Point2, radius: f64) -> Drawing {
    let corners = [(min.x, min.y), (max.x, min.y), (max.x, max.y), (min.x, max.y)];
    let inward = |(x, y): (f64, f64)| {
        let toward = |v: f64, low: f64, high: f64| if v == low { low + radius } else { high - radius };
        Point2::new(toward(x, min.x, max.x), toward(y, min.y, max.y))
    };
    match Shape::try_rounded(&corners.map(inward), radius) {
        Ok(shape) => Drawing::Polygon(polygon_of(&shape.place(pose))),
        Err(_) => Drawing::Polygon(placed(pose, &corners)),
    }
}

/// Points of the frame of `pose` in the world.
pub fn placed(pose: &Pose2, points: &[(f64, f64)]) -> Vec<Point2> {
    points.iter().map(|(x, y)| pose.transform(Point2::new(*x, *y))).collect()
}
