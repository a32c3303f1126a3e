//! Polygons with a radius, which world files may have: the four questions, depths and motions, against exact arithmetic
//! and brute force.

use std::f64::consts::PI;

use motion_lab_core::collision::{Certificate, verify_certificate};
use motion_lab_core::geometry::{Placed, convex_hull, largest_coordinate};
use motion_lab_core::num::{sin_cos, sqrt, ulp};
use motion_lab_core::prelude::*;

use oracle::exact::{ExactPair, lies_on};
use oracle::fixtures::{Body, KINDS, convex_corners, footprint_of, lattice_shape, placed, random_body, scene_of};
use oracle::seen::{Seen, world_of};
use oracle::{plain, sweep};

/// A random rounded polygon, turned and placed anywhere in `[-range, range]^2`.
fn rounded(s: &mut Stream, range: f64) -> Body {
    let pose = Pose2::new(s.uniform(-range, range), s.uniform(-range, range), s.uniform(-PI, PI));
    let (size, radius) = (s.uniform(0.2, 1.2), s.uniform(0.01, 0.6));
    (pose, Shape::Hull { vertices: convex_corners(s, size).into(), radius })
}

/// The least distance between sampled points of two boundaries, `count` to each side and about each corner, and the
/// most by which it can exceed the true distance.
fn by_points(a: &Placed, b: &Placed, count: u32) -> (f64, f64) {
    let points = |shape: &Placed| -> (Vec<Point2>, f64) {
        let (core, r) = (shape.core(), shape.radius());
        let (mut points, mut apart) = (Vec::new(), 0.0);
        for (i, &p) in core.iter().enumerate() {
            let q = core[(i + 1) % core.len()];
            let length = (q - p).norm();
            let normal =
                if length > 0.0 { Vector2::new(q.y - p.y, p.x - q.x) * (r / length) } else { Vector2::zeros() };
            for k in 0..=count {
                let along = p + (q - p) * (f64::from(k) / f64::from(count));
                let (sin, cos) = sin_cos(2.0 * PI * f64::from(k) / f64::from(count));
                points.extend([along + normal, along - normal, p + Vector2::new(cos, sin) * r]);
            }
            for step in [length / f64::from(count), 2.0 * PI * r / f64::from(count)] {
                apart = if step > apart { step } else { apart };
            }
        }
        (points, apart)
    };
    let ((mine, apart), (theirs, between)) = (points(a), points(b));
    let least = mine.iter().flat_map(|p| theirs.iter().map(move |q| (q - p).norm_squared()));
    (sqrt(least.fold(f64::INFINITY, |m, d| if d < m { d } else { m })), apart + between)
}

/// Checks the four answers and the depth of a pair against exact arithmetic and the plain oracle. Returns whether it is
/// in contact.
fn check(body: &Body, obstacle: &Body) -> bool {
    let (part, piece) = (placed(body), placed(obstacle));
    let (scene, footprint) = (scene_of(std::slice::from_ref(obstacle)), footprint_of(std::slice::from_ref(body)));
    let m = largest_coordinate([&part, &piece]);
    let (dist, exact) = (scene.distance(&footprint), ExactPair::new(&part, &piece));
    let at = || format!("{body:?} against {obstacle:?}: {dist}");
    if exact.contact() {
        assert_eq!(dist, 0.0, "in contact: {}", at());
    } else if exact.apart_by_more_than(8.0 * ulp(m)) {
        assert!(dist > 0.0, "apart: {}", at());
    }
    assert!(exact.distance_is(dist, 16.0 * ulp(m)), "{}", at());
    assert!((plain::distance(&part, &piece) - dist).abs() <= 32.0 * ulp(m), "{}", at());
    assert_eq!(scene.intersects(&footprint), dist == 0.0, "{}", at());
    assert_eq!(scene.swept(&footprint, &footprint), dist == 0.0, "{}", at());
    assert_eq!(scene.touched(&footprint).is_empty(), dist > 0.0, "{}", at());
    let w = scene.witness(&footprint).unwrap();
    assert!(w.dist == dist && ((w.on_robot - w.on_obstacle).norm() - dist).abs() <= 16.0 * ulp(m), "{w:?}: {}", at());
    let tolerance = 32.0 * ulp(m);
    assert!(lies_on(w.on_robot, &part, tolerance) && lies_on(w.on_obstacle, &piece, tolerance), "{w:?}: {}", at());
    // no move shorter than the depth frees it
    let depth = scene.depth(&footprint);
    assert!(if dist > 0.0 { depth == 0.0 } else { depth >= 0.0 && depth.is_finite() }, "{depth}: {}", at());
    for k in 0..8 {
        let (sin, cos) = sin_cos(0.25 * PI * f64::from(k));
        let moved = Pose2 { x: body.0.x + 0.999 * depth * cos, y: body.0.y + 0.999 * depth * sin, ..body.0 };
        let free = plain::distance(&placed(&(moved, body.1.clone())), &piece) > 1e-12;
        assert!(depth == 0.0 || !free, "moved by less than its depth of {depth} and free: {}", at());
    }
    exact.contact()
}

#[test]
fn rounded_polygons_against_every_kind_of_shape_agree_with_exact_arithmetic() {
    let mut s = Stream::new(Seed(121), "tests/rounded");
    let (mut contacts, n) = (0, 1_000);
    for i in 0..n {
        let range = [0.8, 1.6, 4.0][i % 3];
        let hull = rounded(&mut s, range);
        let other = if i % 6 == 5 { rounded(&mut s, range) } else { random_body(&mut s, KINDS[i % 6], range) };
        contacts += usize::from(if i % 2 == 0 { check(&hull, &other) } else { check(&other, &hull) });
    }
    assert!((n / 6..5 * n / 6).contains(&contacts), "one-sided: {contacts} contacts of {n}");
}

#[test]
fn the_distance_of_two_rounded_polygons_is_that_of_the_nearest_points_of_their_boundaries() {
    let mut s = Stream::new(Seed(122), "tests/rounded");
    let mut apart = 0;
    for _ in 0..40 {
        let (a, b) = (rounded(&mut s, 2.5), rounded(&mut s, 2.5));
        let dist = scene_of(std::slice::from_ref(&b)).distance(&footprint_of(std::slice::from_ref(&a)));
        if dist == 0.0 {
            continue;
        }
        let (found, step) = by_points(&placed(&a), &placed(&b), 32);
        assert!(
            dist <= found + 1e-12 && found <= dist + step,
            "{dist}, but {found} by points {step} apart: {a:?} {b:?}"
        );
        apart += 1;
    }
    assert!(apart > 12, "{apart}");
}

/// On a lattice, in units of a power of two, where exact arithmetic knows which pairs touch and do not overlap.
#[test]
fn rounded_polygons_that_touch_are_in_contact() {
    let mut s = Stream::new(Seed(123), "tests/rounded");
    let (mut touching, mut tried) = (0, 0);
    while touching < 80 {
        tried += 1;
        let unit = [0.125, 1.0, 16.0][tried % 3];
        let corners: Vec<Point2> =
            (0..6).map(|_| Point2::new(unit * s.below(13) as f64, unit * s.below(13) as f64)).collect();
        let hull = convex_hull(&corners);
        if hull.len() < 3 {
            continue;
        }
        let radius = unit * (1 + s.below(5)) as f64;
        let body: Body = (Pose2::IDENTITY, Shape::Hull { vertices: hull[..].into(), radius });
        let obstacle = lattice_shape(&mut s, KINDS[tried % 5], 16).body(unit);
        if ExactPair::new(&placed(&body), &placed(&obstacle)).tangent() {
            assert!(check(&body, &obstacle) && check(&obstacle, &body));
            touching += 1;
        } else if tried % 64 == 0 {
            check(&body, &obstacle);
        }
        assert!(tried < 40_000, "{touching} touches");
    }
}

#[test]
fn a_file_makes_of_its_points_the_hull_with_that_radius() {
    let corners =
        [(0.0, 0.0), (3.0, 0.0), (1.0, 0.5), (3.0, 4.0), (0.0, 4.0), (1.5, 2.0)].map(|(x, y)| Point2::new(x, y));
    let scene = Scene::of_world(&world_of(&[Seen::Round(corners.to_vec(), 0.5)], false));
    let disc = |x: f64, y: f64| scene.distance(&Footprint::disc(Point2::new(x, y), 0.25));
    // beside a side, off a corner by 3-4-5, and within
    assert_eq!((disc(1.0, -2.0), disc(6.0, 2.0), disc(-2.0, 1.0)), (1.25, 2.25, 1.25));
    assert!((disc(6.0, 8.0) - 4.25).abs() < 1e-14 && disc(2.0, 2.0) == 0.0 && disc(1.0, 0.25) == 0.0);
}

/// Edges of discs, arms and cars among rounded polygons: free edges keep the clearance that they claim, and hits are in
/// contact where they claim.
#[test]
fn edges_among_rounded_polygons_agree_with_sampling() {
    fn survey<R: Robot>(robot: &R, mut draw: impl FnMut(&mut Stream) -> R::Configuration, s: &mut Stream) -> [u32; 2] {
        let mut certificate = Certificate::new();
        let mut verdicts = [0, 0];
        for _ in 0..25 {
            let bodies: Vec<Body> = (0..4).map(|_| rounded(s, 3.0)).collect();
            let pieces: Vec<Placed> = bodies.iter().map(placed).collect();
            let checker = Checker::new(scene_of(&bodies), robot.clone());
            for _ in 0..6 {
                let a = draw(s);
                let b = a.interpolate(&draw(s), 0.4).unwrap();
                let motion = robot.edge(&a, &b).unwrap();
                let clearance = |s: f64| {
                    let footprint = motion.footprint_at(s);
                    footprint.parts().iter().fold(f64::INFINITY, |m, p| sweep::nearest_of(p.placed(), &pieces, m))
                };
                let verdict = checker.edge(&a, &b).unwrap();
                assert_eq!(checker.edge_free(&a, &b), verdict.is_free(), "{a} to {b}");
                assert_eq!(checker.edge_certified(&a, &b, &mut certificate).unwrap().is_free(), verdict.is_free());
                let proven = verify_certificate(checker.scene(), &motion, &certificate).unwrap();
                let until = match verdict {
                    EdgeVerdict::Free { clearance: claimed } => {
                        let least = (0..=80).map(|i| clearance(f64::from(i) / 80.0));
                        assert!(least.fold(f64::INFINITY, |m, d| if d < m { d } else { m }) >= claimed, "{a} to {b}");
                        1.0
                    }
                    EdgeVerdict::Hit { free_until, contact_at, .. } => {
                        assert!(clearance(contact_at) < 1e-12, "no contact at {contact_at}: {a} to {b}");
                        free_until
                    }
                    EdgeVerdict::Unresolved { free_until, .. } => free_until,
                };
                let free = (0..50).map(|i| 0.02 * f64::from(i) * until).all(|s| until == 0.0 || clearance(s) > 0.0);
                assert!(free && proven == until, "not free until {until}, proven until {proven}: {a} to {b}");
                verdicts[usize::from(verdict.is_free())] += 1;
            }
        }
        verdicts
    }
    let mut s = Stream::new(Seed(124), "tests/rounded");
    let pose = |s: &mut Stream| Pose2::new(s.uniform(-4.0, 4.0), s.uniform(-4.0, 4.0), s.uniform(-PI, PI));
    let small =
        Hitch { body: motion_lab_core::robots::CarBody { length: 0.6, width: 0.3, rear_overhang: 0.1 }, ..HITCH };
    let tallies = [
        survey(&RustyDisc { radius: 0.2 }, |s| R2(pose(s).position()), &mut s),
        survey(&Reach::<2>::workbench(), |s| T2::new(s.uniform(-PI, PI), s.uniform(-PI, PI)), &mut s),
        survey(&small, |s| HitchCfg { body: pose(s), trailer: None }, &mut s),
    ];
    assert!(tallies.iter().flatten().all(|n| *n > 8), "hits and free ones by robot: {tallies:?}");
}
