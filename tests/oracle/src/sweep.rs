//! The clearance along a motion by sampling in time, refined where it is small.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use motion_lab_core::geometry::{Footprint, Placed, Point2, Shape, Vertices};
use motion_lab_core::num::{cos, sin};

use crate::plain;

/// Bounds on the least clearance along a motion by sampling, metres.
#[derive(Clone, Copy, Debug)]
pub struct Clearance {
    /// No moment of the motion is nearer than this.
    pub at_least: f64,
    /// Some sampled moment is this near; 0 when one is in contact.
    pub at_most: f64,
}

/// The fineness of sampling a motion.
#[derive(Clone, Copy, Debug)]
pub struct Fineness {
    /// Stretches proven to keep this clearance are not refined, metres.
    pub enough: f64,
    /// Stretches whose two bounds differ by at most this are not refined, metres.
    pub width: f64,
    /// Largest number of samples; beyond it the lower bound is what they have proven.
    pub samples: usize,
}

/// Fine enough to tell a clearance above a micrometre from contact.
pub const MICROMETRE: Fineness = Fineness { enough: 1e-3, width: 1e-7, samples: 100_000 };

/// The least clearance of a set of shapes in motion, sampled and refined breadth first. `at(s)` gives the shapes at
/// time `s` in `[0, 1]`; no point of any moves faster than `speed` per unit of `s`.
pub fn clearance(at: impl Fn(f64) -> Vec<Placed>, speed: f64, obstacles: &[Placed], fine: Fineness) -> Clearance {
    let sample = |s: f64| at(s).iter().fold(f64::INFINITY, |m, part| nearest_of(part, obstacles, m));
    let mut at_most = lesser(sample(0.0), sample(1.0));
    let mut at_least = at_most;
    // stretches by (middle, half width, the bound proven for the stretch around it)
    let mut open = VecDeque::from([(0.5, 0.5, 0.0)]);
    let mut samples = 0;
    while let Some((middle, half, proven)) = open.pop_front() {
        if at_most == 0.0 {
            return Clearance { at_least: 0.0, at_most };
        }
        if samples == fine.samples {
            at_least = lesser(at_least, proven);
            continue;
        }
        samples += 1;
        let here = sample(middle);
        at_most = lesser(at_most, here);
        let bound = here - speed * half;
        if bound >= fine.enough || bound >= at_most - fine.width {
            at_least = lesser(at_least, bound);
        } else {
            open.push_back((middle - 0.5 * half, 0.5 * half, bound));
            open.push_back((middle + 0.5 * half, 0.5 * half, bound));
        }
    }
    Clearance { at_least: if at_least > 0.0 { at_least } else { 0.0 }, at_most }
}

/// The clearance along the rigid sweep from `a` to `b`: every part's origin in a straight line while it turns the short
/// way.
pub fn rigid(a: &Footprint, b: &Footprint, obstacles: &[Placed], fine: Fineness) -> Clearance {
    let mut speed: f64 = 0.0;
    for (p, q) in a.parts().iter().zip(b.parts()) {
        let travel = (q.pose().position() - p.pose().position()).norm();
        let arm = vertices(p.shape()).iter().fold(0.0, |m, v| if v.coords.norm() > m { v.coords.norm() } else { m });
        let part = travel + arm * short_turn(p.pose().theta, q.pose().theta).abs();
        speed = if part > speed { part } else { speed };
    }
    let at = |s: f64| a.parts().iter().zip(b.parts()).map(|(p, q)| between(p, q, s)).collect();
    clearance(at, speed, obstacles, fine)
}

fn between(p: &motion_lab_core::geometry::Part, q: &motion_lab_core::geometry::Part, s: f64) -> Placed {
    if s == 0.0 || s == 1.0 {
        return if s == 0.0 { p.placed().clone() } else { q.placed().clone() };
    }
    let origin = p.pose().position() + (q.pose().position() - p.pose().position()) * s;
    let angle = p.pose().theta + s * short_turn(p.pose().theta, q.pose().theta);
    let core = vertices(p.shape());
    let turned = core.iter().map(|v| {
        Point2::new(origin.x + cos(angle) * v.x - sin(angle) * v.y, origin.y + sin(angle) * v.x + cos(angle) * v.y)
    });
    Placed::new(turned.collect::<Vertices>(), p.placed().radius())
}

/// The turn from `a` to `b` the short way round, radians; exactly half a turn goes the positive way.
fn short_turn(a: f64, b: f64) -> f64 {
    let mut d = b - a;
    while d > PI {
        d -= TAU;
    }
    while d <= -PI {
        d += TAU;
    }
    d
}

fn vertices(shape: &Shape) -> Vec<Point2> {
    match shape {
        Shape::Disc { .. } => vec![Point2::origin()],
        Shape::Segment { a, b } | Shape::Capsule { a, b, .. } => vec![*a, *b],
        Shape::Rectangle { min, max } => {
            vec![*min, Point2::new(max.x, min.y), *max, Point2::new(min.x, max.y)]
        }
        Shape::Polygon(p) => p.vertices().to_vec(),
        Shape::Hull { vertices, .. } => vertices.to_vec(),
    }
}

/// The distance to the nearest obstacle, at most `known`. Obstacles whose boxes are farther than that are skipped.
pub fn nearest_of(part: &Placed, obstacles: &[Placed], known: f64) -> f64 {
    let mut least = known;
    let mine = bounding_box(part);
    for obstacle in obstacles {
        if box_gap(&mine, &bounding_box(obstacle)) < least {
            least = lesser(least, plain::distance(part, obstacle));
        }
    }
    least
}

type Box2 = [f64; 4];

fn bounding_box(shape: &Placed) -> Box2 {
    let r = shape.radius();
    shape.core().iter().fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |b, p| {
        let greater = |a: f64, b: f64| if a > b { a } else { b };
        [lesser(b[0], p.x - r), lesser(b[1], p.y - r), greater(b[2], p.x + r), greater(b[3], p.y + r)]
    })
}

/// The gap between two boxes along the axis where it is largest: never more than the distance of their contents.
fn box_gap(a: &Box2, b: &Box2) -> f64 {
    [b[0] - a[2], a[0] - b[2], b[1] - a[3], a[1] - b[3]].into_iter().fold(-1.0, |m, x| if x > m { x } else { m })
}

fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_passing_a_point_has_its_closest_moment_in_the_middle() {
        let post = [Placed::new([Point2::new(0.37, 0.5)], 0.1)];
        let (a, b) = (Footprint::disc(Point2::new(-2.0, 0.0), 0.2), Footprint::disc(Point2::new(2.0, 0.0), 0.2));
        let c = rigid(&a, &b, &post, Fineness { enough: 1.0, ..MICROMETRE });
        assert!((c.at_most - 0.2).abs() < 1e-7 && c.at_least <= 0.2 && c.at_least > 0.2 - 3e-7, "{c:?}");
        assert!(rigid(&a, &b, &post, MICROMETRE).at_least >= 1e-3);
    }

    #[test]
    fn a_turning_bar_is_caught_between_two_free_poses() {
        let bar = |theta: f64| {
            let pose = motion_lab_core::geometry::Pose2 { x: 0.0, y: 0.0, theta };
            let shape = Shape::Segment { a: Point2::origin(), b: Point2::new(1.0, 0.0) };
            Footprint::new([motion_lab_core::geometry::Part::new(pose, shape)])
        };
        let post = [Placed::new([Point2::new(0.9, 0.0)], 0.05)];
        assert_eq!(rigid(&bar(-0.5), &bar(0.5), &post, MICROMETRE).at_most, 0.0);
        // and back; the long way round would miss the post
        assert_eq!(rigid(&bar(0.5), &bar(-0.5), &post, MICROMETRE).at_most, 0.0);
        assert!(rigid(&bar(2.5), &bar(-2.5), &post, MICROMETRE).at_least >= 1e-3);
    }
}
