//! A judge of certificates: whether steps prove a motion along the chart's straight line free, by kinematics, distances
//! and a motion bound of its own. Of the library it takes the obstacles' placed shapes and the claims.
//!
//! The bound is an arc's sagitta instead of a second derivative: a vertex is a point that moves straight and a sum of
//! vectors, each of which turns evenly. Halfway such a vector is farthest from the chord of its end, by
//! `length * (1 - cos(turn / 2))`, so the vertex is never farther from its own chord than the sum of these.

use std::f64::consts::PI;

use motion_lab_core::configuration::{Configuration, Coordinates};
use motion_lab_core::geometry::{Placed, Point2, Vector2, Vertices};
use motion_lab_core::num::{cos, sin};

use crate::{plain, short};

/// Distances here are right to a few of these per metre of the largest coordinate, metres.
const ROUNDING: f64 = 1e-13;

/// A vector of a vertex: it turns by the sum of some coordinates, which are counted from 0.
struct Turning {
    angles: &'static [usize],
    ahead: f64,
    left: f64,
}

/// A vertex of a part: its vectors from the origin of the robot on.
type Vertex = Vec<Turning>;

/// A robot as its chapter describes it: the vertices of each part's core, the part's radius, and whether the first two
/// coordinates move the origin.
pub struct Robot {
    parts: Vec<(Vec<Vertex>, f64)>,
    is_mobile: bool,
}

fn ahead(angles: &'static [usize], ahead: f64) -> Turning {
    Turning { angles, ahead, left: 0.0 }
}

impl Robot {
    /// A disc.
    pub fn disc(radius: f64) -> Self {
        Robot { parts: vec![(vec![vec![]], radius)], is_mobile: true }
    }

    /// An arm at the origin with these links.
    pub fn arm(lengths: &[f64], radius: f64) -> Self {
        const SUMS: [&[usize]; 3] = [&[0], &[0, 1], &[0, 1, 2]];
        let joint = |k: usize| lengths.iter().zip(SUMS).take(k).map(|(&l, sum)| ahead(sum, l)).collect();
        let link = |k: usize| (vec![joint(k), joint(k + 1)], radius);
        Robot { parts: (0..lengths.len()).map(link).collect(), is_mobile: false }
    }

    /// Hitch with its trailer: both boxes hang on the middle of the rear axle.
    pub fn car_with_trailer() -> Self {
        let corner = |angles, x, y| vec![Turning { angles, ahead: x, left: y }];
        let a_box = |angles: &'static [usize], back: f64, front: f64, width: f64| {
            let sides = [-0.5 * width, 0.5 * width];
            let corners = [back, front].into_iter().flat_map(|x| sides.map(|y| corner(angles, x, y)));
            (corners.collect::<Vec<Vertex>>(), 0.0)
        };
        Robot { parts: vec![a_box(&[2], -0.7, 3.2, 1.7), a_box(&[3], -2.8, -1.0, 1.5)], is_mobile: true }
    }

    /// The place of a vertex at a configuration.
    fn place(&self, vertex: &Vertex, q: &Coordinates) -> Point2 {
        let origin = if self.is_mobile { Point2::new(q[0], q[1]) } else { Point2::origin() };
        vertex.iter().fold(origin, |p, v| {
            let angle: f64 = v.angles.iter().map(|&i| q[i]).sum();
            let (c, s) = (cos(angle), sin(angle));
            p + Vector2::new(c * v.ahead - s * v.left, s * v.ahead + c * v.left)
        })
    }

    /// A bound on how far a vertex strays from its chord while the coordinates change by `by`, metres.
    fn stray(vertex: &Vertex, by: &Coordinates) -> f64 {
        let of = |v: &Turning| {
            let turn: f64 = v.angles.iter().map(|&i| by[i]).sum();
            let length = Vector2::new(v.ahead, v.left).norm();
            // beyond half a turn it may be farthest elsewhere: the error of linear interpolation
            if turn.abs() <= PI { length * (1.0 - cos(0.5 * turn)) } else { 0.125 * length * turn * turn }
        };
        vertex.iter().map(of).sum()
    }
}

/// A motion along the chart's straight line.
pub struct Line<'a> {
    robot: &'a Robot,
    from: Coordinates,
    by: Coordinates,
}

impl<'a> Line<'a> {
    /// The line from one configuration to another, angles the short way.
    pub fn new<C: Configuration>(robot: &'a Robot, from: &C, to: &C) -> Self {
        let (a, b) = (from.coordinates(), to.coordinates());
        let is_linear = |i: usize| robot.is_mobile && i < 2;
        let by = (0..a.len()).map(|i| if is_linear(i) { b[i] - a[i] } else { short(a[i], b[i]) }).collect();
        Line { robot, from: a, by }
    }

    fn at(&self, s: f64) -> Coordinates {
        self.from.iter().zip(self.by.iter()).map(|(a, by)| a + s * by).collect()
    }

    /// The clearance from these obstacles that is proven from `from` to `to`, metres, to within the second number.
    pub fn proven(&self, from: f64, to: f64, obstacles: &[Placed]) -> (f64, f64) {
        let (a, b) = (self.at(from), self.at(to));
        let by: Coordinates = self.by.iter().map(|by| by * (to - from)).collect();
        let (mut least, mut size) = (f64::INFINITY, 1.0);
        for (vertices, radius) in &self.robot.parts {
            let places = |q: &Coordinates| vertices.iter().map(|v| self.robot.place(v, q)).collect::<Vec<_>>();
            let points = [places(&a), places(&b)].concat();
            let strays = vertices.iter().map(|v| Robot::stray(v, &by)).fold(0.0, |m, x| if x > m { x } else { m });
            for obstacle in obstacles {
                let proven = hull_distance(&points, *radius, obstacle) - strays;
                least = if proven < least { proven } else { least };
            }
            size = points.iter().fold(size, |m, p| if p.coords.norm() > m { p.coords.norm() } else { m });
        }
        (least, ROUNDING * size)
    }
}

/// The distance of a convex hull, widened by a radius, from an obstacle, without making the hull: its boundary is among
/// the segments that join its points, and what it holds lies in a triangle of them.
fn hull_distance(points: &[Point2], radius: f64, obstacle: &Placed) -> f64 {
    let n = points.len();
    let inside = obstacle.core()[0];
    for i in 0..n {
        for j in 0..i {
            for k in 0..j {
                if plain::inside_by_crossings(&[points[i], points[j], points[k]], inside) {
                    return 0.0;
                }
            }
        }
    }
    let pairs = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    pairs
        .map(|(i, j)| plain::distance(&Placed::new(Vertices::from([points[i], points[j]]), radius), obstacle))
        .fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound of the head, by brute force: a vector of length 1 that turns by up to half a turn against its chord.
    #[test]
    fn an_evenly_turning_vector_is_farthest_from_its_chord_halfway() {
        for i in 1..=314 {
            let turn = f64::from(i) / 100.0;
            let vertex = vec![ahead(&[0], 1.0)];
            let bound = Robot::stray(&vertex, &[turn].into_iter().collect());
            let (from, to) = (Vector2::new(1.0, 0.0), Vector2::new(cos(turn), sin(turn)));
            let strays = (0..=100)
                .map(|k| 0.01 * f64::from(k))
                .map(|s| (Vector2::new(cos(s * turn), sin(s * turn)) - (from + (to - from) * s)).norm());
            let farthest = strays.fold(0.0, |m: f64, x| if x > m { x } else { m });
            assert!(farthest <= bound * (1.0 + 1e-9) && farthest > 0.999 * bound, "{turn}: {farthest} of {bound}");
        }
    }

    #[test]
    fn a_hull_holds_what_its_points_enclose() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Point2::new(x, y));
        let pin = |x, y| Placed::new(Vertices::from([Point2::new(x, y)]), 0.5);
        assert_eq!(hull_distance(&square, 0.25, &pin(1.0, 2.0)), 0.0, "inside");
        assert_eq!(hull_distance(&square, 0.25, &pin(7.0, 8.0)), 5.0 - 0.75, "3-4-5 from the corner");
    }
}
