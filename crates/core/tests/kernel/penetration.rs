//! `Scene::depth`: a lower bound on how far a footprint must move to become free.

use std::f64::consts::TAU;

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Footprint, Part, Point2, Pose2, Shape};
use motion_lab_core::num::sin_cos;
use motion_lab_core::random::{Seed, Stream};

use oracle::fixtures::{Body, KINDS, count_from_env, footprint_of, placed, random_body, scene_of};
use oracle::plain;

fn shifted(bodies: &[Body], dx: f64, dy: f64) -> Vec<Body> {
    bodies.iter().map(|(p, s)| (Pose2 { x: p.x + dx, y: p.y + dy, ..*p }, s.clone())).collect()
}

fn turned(bodies: &[Body], about: Point2, angle: f64) -> Vec<Body> {
    let turn = Pose2::new(about.x, about.y, angle).compose(&Pose2::new(-about.x, -about.y, 0.0));
    bodies.iter().map(|(p, s)| (turn.compose(p), s.clone())).collect()
}

/// Whether the bodies are free of the obstacles by the plain oracle, with a gap above rounding errors.
fn clearly_free(bodies: &[Body], obstacles: &[Body]) -> bool {
    bodies.iter().all(|b| obstacles.iter().all(|o| plain::distance(&placed(b), &placed(o)) > 1e-12))
}

#[test]
fn no_move_shorter_than_the_depth_frees_a_footprint() {
    let mut s = Stream::new(Seed(51), "tests/depth");
    let mut deep = 0;
    let n = count_from_env("MOTION_LAB_PAIRS", 100_000) / 10;
    for i in 0..n {
        let obstacles: Vec<Body> =
            (0..1 + s.below(3)).map(|k| random_body(&mut s, KINDS[(i + k) as usize % 5], 1.0)).collect();
        let bodies: Vec<Body> =
            (0..1 + i % 2).map(|k| random_body(&mut s, KINDS[(i / 5 + k) as usize % 5], 1.0)).collect();
        let (scene, footprint) = (scene_of(&obstacles), footprint_of(&bodies));
        let depth = scene.depth(&footprint);
        if !scene.intersects(&footprint) {
            assert_eq!(depth, 0.0, "a free footprint has no depth");
            continue;
        }
        assert!(depth >= 0.0 && depth.is_finite(), "{depth}");
        deep += u64::from(depth > 1e-3);
        let length = 0.999 * depth;
        for k in 0..32 {
            let (sin, cos) = sin_cos(TAU * f64::from(k) / 32.0);
            let moved = shifted(&bodies, length * cos, length * sin);
            assert!(
                !clearly_free(&moved, &obstacles),
                "moved by {length} < {depth} and free: {bodies:?} {obstacles:?}"
            );
        }
        for _ in 0..4 {
            let about = Point2::new(s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0));
            // a turn moves the farthest point by at most the angle times its distance
            let reach = bodies.iter().map(placed).fold(0.0, |reach, part| {
                part.core()
                    .iter()
                    .map(|v| (v - about).norm() + part.radius())
                    .fold(reach, |m, d| if d > m { d } else { m })
            });
            for angle in [length / reach, -length / reach] {
                let moved = turned(&bodies, about, angle);
                assert!(
                    !clearly_free(&moved, &obstacles),
                    "turned by {angle} about {about} and free: {bodies:?} {obstacles:?}"
                );
            }
        }
    }
    assert!(deep > n / 10, "only {deep} deep enough to say something");
}

#[test]
fn the_depth_of_a_disc_is_its_shortest_way_out_of_a_wall() {
    // a check without any formula: pushed out sideways by r - d, it touches
    let wall = random_wall();
    let scene = scene_of(std::slice::from_ref(&wall));
    for d in [0.0, 0.125, 0.375] {
        let disc = [(Pose2::new(d, 0.0, 0.0), motion_lab_core::geometry::Shape::Disc { radius: 0.5 })];
        let depth = scene.depth(&footprint_of(&disc));
        assert!(depth <= 0.5 - d && depth >= 0.5 - d - 1e-12, "{depth}");
    }
}

fn random_wall() -> Body {
    use motion_lab_core::geometry::Shape;
    (Pose2::IDENTITY, Shape::try_segment(Point2::new(0.0, -4.0), Point2::new(0.0, 4.0)).unwrap())
}

#[test]
fn the_deepest_part_is_named_with_what_it_is_deepest_in() {
    // squares of 2 m about (0, 0) and (10, 0), and one of 1 m within the second
    let square = |half: f64| Shape::Rectangle { min: Point2::new(-half, -half), max: Point2::new(half, half) };
    let bounds = Aabb::new(Point2::new(-20.0, -20.0), Point2::new(20.0, 20.0));
    let scene = [("near", 0.0, 1.0), ("within", 10.0, 0.5), ("far", 10.0, 1.0)]
        .into_iter()
        .fold(Scene::empty(bounds), |scene, (name, x, half)| {
            scene.with_obstacle_at(name, Pose2::new(x, 0.0, 0.0), square(half))
        });
    let disc = |x: f64, radius: f64| Part::new(Pose2::new(x, 0.0, 0.0), Shape::Disc { radius });
    // radius and way out of the square: 0.1 + 0.6 for the first part, 0.2 + 0.9 for the second, in the larger square
    let overlap = scene.deepest(&Footprint::new([disc(0.4, 0.1), disc(10.1, 0.2)])).unwrap();
    assert_eq!((overlap.part, scene.obstacle_name(overlap.obstacle)), (1, Some("far")));
    assert!((overlap.depth - 1.1).abs() < 1e-9, "{overlap:?}");
    let overlap = scene.deepest(&Footprint::new([disc(0.0, 0.3), disc(10.1, 0.2)])).unwrap();
    assert_eq!((overlap.part, scene.obstacle_name(overlap.obstacle)), (0, Some("near")));
    // of equal ones the first
    let twins = scene.clone().with_obstacle_at("twin", Pose2::new(0.0, 0.0, 0.0), square(1.0));
    let overlap = twins.deepest(&Footprint::new([disc(0.0, 0.2), disc(0.0, 0.2)])).unwrap();
    assert_eq!((overlap.part, twins.obstacle_name(overlap.obstacle)), (0, Some("near")));
    assert_eq!(scene.deepest(&Footprint::new([disc(5.0, 0.2)])), None);
    assert_eq!(scene.deepest(&Footprint::new([disc(f64::NAN, 0.2)])), None);
    assert_eq!(scene.depth(&Footprint::new([disc(f64::NAN, 0.2)])), f64::INFINITY);
}
