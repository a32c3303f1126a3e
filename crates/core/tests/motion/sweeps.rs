//! The swept query against dense sampling.

use std::f64::consts::{FRAC_PI_2, PI};

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Footprint, Part, Placed, Point2, Pose2, Segment, Shape};
use motion_lab_core::num::{cos, sin};
use motion_lab_core::random::{Seed, Stream};

use oracle::fixtures::{Body, KINDS, Kind, count_from_env, footprint_of, placed, random_body, random_kind, scene_of};
use oracle::sweep::{Clearance, MICROMETRE, rigid};

/// The library's answer must be a hit where sampling finds contact, and free where it proves more than a micrometre.
fn check(scene: &Scene, obstacles: &[Placed], a: &Footprint, b: &Footprint) -> (bool, Clearance) {
    let hit = scene.swept(a, b);
    let sampled = rigid(a, b, obstacles, MICROMETRE);
    let at = || format!("{sampled:?}: {a:?} to {b:?} among {obstacles:?}");
    assert!(hit || sampled.at_most > 0.0, "free, but sampling finds contact, {}", at());
    assert!(!hit || sampled.at_least <= 1e-6, "a hit, but sampling proves it free, {}", at());
    (hit, sampled)
}

#[test]
fn random_sweeps_agree_with_dense_sampling() {
    let mut s = Stream::new(Seed(71), "tests/sweeps");
    let (mut hits, mut free) = (0, 0);
    for i in 0..count_from_env("MOTION_LAB_PAIRS", 100_000) / 50 {
        let obstacles: Vec<Body> =
            (0..1 + s.below(8)).map(|k| random_body(&mut s, KINDS[k as usize % 5], 5.0)).collect();
        let bodies: Vec<Body> =
            (0..1 + i % 3).map(|k| random_body(&mut s, KINDS[(i / 3 + k) as usize % 5], 5.0)).collect();
        // from turning on the spot to travelling, from small steps to long ones
        let (travel, turn) = [(0.0, PI), (3.0, 0.0), (0.3, 0.3), (3.0, PI)][i as usize % 4];
        let moved: Vec<Body> = bodies
            .iter()
            .map(|(p, shape)| {
                let (dx, dy) = (s.uniform(-travel, travel), s.uniform(-travel, travel));
                (Pose2::new(p.x + dx, p.y + dy, p.theta + s.uniform(-turn, turn)), shape.clone())
            })
            .collect();
        let pieces: Vec<Placed> = obstacles.iter().map(placed).collect();
        let (a, b) = (footprint_of(&bodies), footprint_of(&moved));
        if check(&scene_of(&obstacles), &pieces, &a, &b).0 {
            hits += 1;
        } else {
            free += 1;
        }
    }
    assert!(hits > free / 9 && free > hits / 9, "one-sided: {hits} hits, {free} free");
}

#[test]
fn sweeps_of_free_ends_are_hits_only_when_something_is_between() {
    // both ends are free, so a test of the ends alone would miss the hits
    let mut s = Stream::new(Seed(72), "tests/between");
    let (mut caught, mut free) = (0, 0);
    while caught < 150 || free < 150 {
        let (p, q) = (random_kind(&mut s), random_kind(&mut s));
        let (obstacle, part) = (random_body(&mut s, p, 1.0), random_body(&mut s, q, 2.0));
        let to = random_body(&mut s, Kind::Disc, 2.0).0;
        let (a, b) = (footprint_of(std::slice::from_ref(&part)), footprint_of(&[(to, part.1.clone())]));
        let scene = scene_of(std::slice::from_ref(&obstacle));
        if scene.intersects(&a) || scene.intersects(&b) {
            continue;
        }
        if check(&scene, &[placed(&obstacle)], &a, &b).0 {
            caught += 1;
        } else {
            free += 1;
        }
    }
}

fn bar(x: f64, y: f64, theta: f64, radius: f64) -> Footprint {
    let shape = Shape::try_capsule(Point2::origin(), Point2::new(1.0, 0.0), radius).unwrap();
    Footprint::new([Part::new(Pose2 { x, y, theta }, shape)])
}

fn post(x: f64, y: f64, radius: f64) -> Scene {
    scene_of(&[(Pose2::new(x, y, 0.0), Shape::try_disc(radius).unwrap())])
}

#[test]
fn a_turning_bar_meets_what_lies_between_its_two_headings() {
    // The bar turns about its proximal end. The arc reaches the post, but the chord between the bar's two ends does
    // not, and neither does casting the start pose along the displacement of the frame, which is zero.
    let scene = post(0.9, 0.0, 0.02);
    let (a, b) = (bar(0.0, 0.0, -0.6, 0.0), bar(0.0, 0.0, 0.6, 0.0));
    assert!(!scene.intersects(&a) && !scene.intersects(&b));
    assert!(scene.swept(&a, &b) && scene.swept(&b, &a));
    assert!(!post(1.03, 0.0, 0.02).swept(&a, &b), "just out of reach");
    assert!(post(1.019, 0.0, 0.02).swept(&a, &b), "just within");
}

#[test]
fn a_sweep_turns_the_short_way_and_half_a_turn_the_positive_way() {
    let (right, left) = (bar(0.0, 0.0, 0.0, 0.03), bar(0.0, 0.0, PI, 0.03));
    assert!(post(0.0, 0.9, 0.02).swept(&right, &left), "half a turn goes over the top");
    assert!(!post(0.0, -0.9, 0.02).swept(&right, &left));
    let (a, b) = (bar(0.0, 0.0, 3.0, 0.03), bar(0.0, 0.0, -3.0, 0.03));
    assert!(post(-0.9, 0.0, 0.02).swept(&a, &b), "across the cut at pi");
    assert!(!post(0.9, 0.0, 0.02).swept(&a, &b));
}

#[test]
fn a_part_that_travels_and_turns_meets_what_only_the_two_together_reach() {
    // The frame goes from (-1, 0) to (1, 0) while the bar turns from pointing down to pointing up: half way it points
    // along x from the origin.
    let (a, b) = (bar(-1.0, 0.0, -FRAC_PI_2, 0.0), bar(1.0, 0.0, FRAC_PI_2, 0.0));
    assert!(post(0.98, 0.0, 0.01).swept(&a, &b));
    // neither a pure translation of either pose, nor a pure turn at either end, nor the motion comes near the post
    let off = post(0.1, 0.8, 0.05);
    assert!(!off.swept(&a, &b));
    let backwards = bar(1.0, 0.0, -FRAC_PI_2, 0.0);
    assert!(!off.swept(&a, &backwards), "translation alone stays below");
}

#[test]
fn clearances_around_a_micrometre_differ_from_contact() {
    // a disc past a disc, a bar's tip past a disc, a rectangle's turning corner past a wall
    let mut s = Stream::new(Seed(73), "tests/micrometre");
    for i in 0..200 {
        let gap = [1.5e-6, 3e-6, 1e-5, -1e-9, -1e-6, -1e-4][i % 6];
        let theta = s.uniform(-PI, PI);
        let frame = Pose2::new(s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0), theta);
        let (from, to, obstacle) = match i / 6 % 3 {
            0 => {
                let reach = 0.4 + 0.25 + gap;
                let at = |x: f64| (frame.compose(&Pose2::new(x, 0.0, 0.0)), Shape::try_disc(0.4).unwrap());
                (at(-2.0), at(1.7), (frame.compose(&Pose2::new(0.3, reach, 0.0)), Shape::try_disc(0.25).unwrap()))
            }
            1 => {
                let link = Shape::try_capsule(Point2::origin(), Point2::new(1.0, 0.0), 0.03).unwrap();
                let at = |angle: f64| (frame.compose(&Pose2::new(0.0, 0.0, angle)), link.clone());
                let away = Pose2::new(1.0 + 0.03 + 0.2 + gap, 0.0, 0.0);
                (at(-1.1), at(0.9), (frame.compose(&away), Shape::try_disc(0.2).unwrap()))
            }
            _ => {
                let plate = Shape::try_rectangle(Point2::new(-1.0, -1.0), Point2::new(1.0, 1.0)).unwrap();
                let at = |angle: f64| (frame.compose(&Pose2::new(0.0, 0.0, angle)), plate.clone());
                let x = 2.0_f64.sqrt() + gap;
                let wall = Shape::try_segment(Point2::new(x, -2.0), Point2::new(x, 2.0)).unwrap();
                (at(0.1), at(1.3), (frame, wall))
            }
        };
        let scene = scene_of(&[obstacle]);
        let (a, b) = (footprint_of(&[from]), footprint_of(&[to]));
        assert_eq!(scene.swept(&a, &b), gap < 0.0, "case {i}: gap {gap}");
        assert_eq!(scene.swept(&b, &a), gap < 0.0, "case {i} backwards: gap {gap}");
    }
}

#[test]
fn sliding_along_a_wall_is_free_above_a_micrometre_however_long() {
    let wall = Scene::of_walls(&[Segment::new(Point2::new(-60.0, 0.0), Point2::new(60.0, 0.0))]);
    for gap in [1.1e-6, 1e-5, 1e-3] {
        let disc = |x: f64| Footprint::disc(Point2::new(x, 0.5 + gap), 0.5);
        assert!(!wall.swept(&disc(-50.0), &disc(50.0)), "disc at {gap}");
        let bar = |x: f64, theta: f64| bar(x, 0.03 + gap, theta, 0.03);
        assert!(!wall.swept(&bar(-50.0, 0.0), &bar(50.0, 0.0)), "bar at {gap}");
        assert!(!wall.swept(&bar(-50.0, 0.0), &bar(50.0, 0.2)), "bar lifting off at {gap}");
        assert!(wall.swept(&bar(-50.0, 0.0), &bar(50.0, -0.2)), "bar dipping in at {gap}");
    }
    let touching = |x: f64| Footprint::disc(Point2::new(x, 0.5), 0.5);
    assert!(wall.swept(&touching(-50.0), &touching(50.0)));
}

/// A bar of 1 m turns about one end from one bearing to another the short way. It sweeps over the bearings between them
/// and over no others, whatever they are.
#[test]
fn a_turn_sweeps_over_the_bearings_between_its_ends() {
    let bar = |bearing: f64| {
        let shape = Shape::Capsule { a: Point2::origin(), b: Point2::new(1.0, 0.0), radius: 0.01 };
        Footprint::new([Part::new(Pose2::new(2.0, -1.0, bearing), shape)])
    };
    // some turns have their ends symmetric about bearing 0, or about half a turn
    for from in [-3.0, -2.0, -1.25, -0.4, 0.0, 1.0, 0.75 - PI, 2.0, 3.0] {
        for turn in [-1.5, -0.4, 0.2, 0.8, 2.5] {
            // a pin halfway out at these shares of the turn, and at as many bearings outside it
            for share in [0.3, 0.5, 0.9, -0.15, 1.15, 1.6] {
                let at = from + share * turn;
                let pin = Pose2::new(2.0 + 0.5 * cos(at), -1.0 + 0.5 * sin(at), 0.0);
                let scene = Scene::of_walls(&[]).with_obstacle_at("the pin", pin, Shape::Disc { radius: 0.001 });
                let swept = scene.swept(&bar(from), &bar(from + turn));
                assert_eq!(swept, (0.0..=1.0).contains(&share), "from {from} by {turn}, the pin at {share} of it");
            }
        }
    }
}
