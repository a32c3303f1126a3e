//! The contract of `Collision`, which parry keeps as well as rounded arithmetic can.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

use motion_lab_core::collision::{
    Collision, EdgeVerdict, MarchOptions, ParryScene, Scene, is_free_among, march, touch,
};
use motion_lab_core::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape, Vector2};
use motion_lab_core::prelude::{R2, Reach, T2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{Robot, RustyDisc};

use oracle::fixtures::{KINDS, PLANE, footprint_of, lattice_shape, placed, random_body, random_kind, scene_of};
use oracle::plain;

fn point(x: f64, y: f64) -> Point2 {
    Point2::new(x, y)
}

fn segment(ax: f64, ay: f64, bx: f64, by: f64) -> Segment {
    Segment::new(point(ax, ay), point(bx, by))
}

fn wall() -> ParryScene {
    ParryScene::of_scene(&Scene::of_walls(&[segment(3.0, 0.0, 3.0, 3.0)]))
}

#[test]
fn the_chapters_worked_numbers_are_parrys_too() {
    let block = Shape::try_rectangle(point(0.5, 1.0), point(1.0, 1.5)).unwrap();
    let scene = ParryScene::of_scene(&Scene::empty(PLANE).with_obstacle("the block", block));
    let footprint = Reach::<2>::choset().footprint(&T2::new(FRAC_PI_4, FRAC_PI_2));
    let w = scene.witness(&footprint).unwrap();
    assert!(!scene.intersects(&footprint) && (w.dist - (1.5 / SQRT_2 - 1.0)).abs() < 1e-9, "{w:?}");
    assert!((w.on_obstacle - point(0.5, 1.0)).norm() < 1e-6 && w.part == 1);
    assert!((wall().distance(&Footprint::disc(point(2.0, 1.0), 0.11)) - 0.89).abs() < 1e-12);
}

/// Numbers that doubles hold exactly: nothing is rounded, and each pair has one point in common.
#[test]
fn touching_counts_as_contact() {
    let at = |shape: Shape| Footprint::new([Part::new(Pose2::IDENTITY, shape)]);
    let rectangle = |a, b| at(Shape::try_rectangle(a, b).unwrap());
    let touching = [
        Footprint::disc(point(2.5, 1.0), 0.5),
        at(Shape::Segment { a: point(1.0, 1.0), b: point(3.0, 1.0) }),
        at(Shape::Segment { a: point(1.0, -1.0), b: point(3.0, 0.0) }),
        rectangle(point(1.0, 0.5), point(3.0, 1.0)),
        rectangle(point(1.0, -1.0), point(3.0, 0.0)),
        at(Shape::Capsule { a: point(2.75, 1.0), b: point(2.75, 2.0), radius: 0.25 }),
    ];
    for footprint in touching {
        assert!(wall().intersects(&footprint), "{footprint:?}");
        assert_eq!(wall().distance(&footprint), 0.0, "{footprint:?}");
        let w = wall().witness(&footprint).unwrap();
        assert!(w.dist == 0.0 && w.on_robot == w.on_obstacle, "{w:?}");
        let off = plain::point_distance(w.on_robot, footprint.parts()[0].placed());
        assert!(off < 1e-6 && (w.on_robot.x - 3.0).abs() < 1e-6, "{w:?} is no common point of {footprint:?}");
        assert!(wall().swept(&footprint, &footprint));
    }
}

/// Bodies at random and on lattices, where many touch. The other implementation is the oracle's.
#[test]
fn the_answers_agree_with_one_another_and_with_the_oracle() {
    let mut s = Stream::new(Seed(45), "tests/black_box");
    let (mut contacts, mut apart) = (0, 0);
    for i in 0..6000_usize {
        let [part, piece] = if i % 3 == 0 {
            [KINDS[i / 3 % 5], KINDS[i / 15 % 5]].map(|kind| lattice_shape(&mut s, kind, 6).body(0.25))
        } else {
            [0, 1].map(|_| {
                let kind = random_kind(&mut s);
                random_body(&mut s, kind, 2.0)
            })
        };
        let (scene, footprint) = (scene_of(std::slice::from_ref(&piece)), footprint_of(std::slice::from_ref(&part)));
        let black_box = ParryScene::of_scene(&scene);
        let dist = black_box.distance(&footprint);
        let what = || format!("{part:?} and {piece:?}");
        assert_eq!(black_box.intersects(&footprint), dist == 0.0, "{}", what());
        assert_eq!(black_box.swept(&footprint, &footprint), dist == 0.0, "{}", what());
        let w = black_box.witness(&footprint).unwrap();
        assert_eq!((w.dist, w.part, w.obstacle.0), (dist, 0, 0), "{}", what());
        assert!(((w.on_robot - w.on_obstacle).norm() - dist).abs() < 1e-12, "{w:?}: {}", what());
        let [one, other] = [placed(&part), placed(&piece)];
        let expected = plain::distance(&one, &other);
        assert!((dist - expected).abs() < 1e-6, "{dist}, not {expected}: {}", what());
        for (at, shape) in [(w.on_robot, &one), (w.on_obstacle, &other)] {
            assert!(plain::point_distance(at, shape) < 1e-4, "{w:?}: {}", what());
        }
        contacts += u32::from(dist == 0.0);
        apart += u32::from(dist > 0.0);
    }
    assert!(contacts > 1000 && apart > 1000, "{contacts} contacts, {apart} apart");
}

#[test]
fn an_empty_scene_is_infinitely_far_and_hit_by_nothing() {
    let empty = ParryScene::of_scene(&Scene::empty(PLANE));
    let [a, b] = [0.0, 5.0].map(|x| Footprint::disc(point(x, 0.0), 0.1));
    assert!(!empty.intersects(&a) && !empty.swept(&a, &b));
    assert_eq!((empty.distance(&a), empty.witness(&a)), (f64::INFINITY, None));
    let nothing = Footprint::new([]);
    assert!(!wall().intersects(&nothing) && wall().distance(&nothing) == f64::INFINITY);
    assert_eq!(empty.range(point(0.0, 0.0), Vector2::x(), 9.0), f64::INFINITY);
}

#[test]
fn what_is_not_finite_is_in_contact_in_every_answer() {
    let fine = Footprint::disc(point(0.0, 0.0), 0.1);
    assert!(!wall().intersects(&fine), "the finite one is free, so the answers below say something");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e61] {
        let footprints = [
            Footprint::disc(point(bad, 0.0), 0.1),
            Footprint::disc(point(0.0, 0.0), bad),
            Footprint::capsules([segment(0.0, 0.0, 1.0, bad)], 0.1),
            Footprint::rects([(Pose2::IDENTITY, point(0.0, 0.0), point(1.0, bad))]),
        ];
        for footprint in footprints {
            for scene in [wall(), ParryScene::of_scene(&Scene::empty(PLANE))] {
                assert!(scene.intersects(&footprint) && scene.distance(&footprint) == 0.0, "{footprint:?}");
                assert_eq!(scene.witness(&footprint), None, "{footprint:?}");
                assert!(scene.swept(&footprint, &fine) && scene.swept(&fine, &footprint), "{footprint:?}");
            }
        }
        if !bad.is_finite() {
            assert_eq!(wall().range(point(bad, 0.0), Vector2::x(), 9.0), 0.0);
        }
    }
    // an obstacle that is no shape touches everything, as in the exact scene
    let broken = Scene::empty(PLANE).with_obstacle("broken", Shape::Disc { radius: f64::NAN });
    let black_box = ParryScene::of_scene(&broken);
    assert!(broken.intersects(&fine) && black_box.intersects(&fine) && black_box.swept(&fine, &fine));
    assert_eq!(
        black_box.witness(&fine).map(|w| (w.dist, w.obstacle)),
        Some((0.0, broken.witness(&fine).unwrap().obstacle))
    );
}

/// Two neighbours of this polygon are one point, of which parry makes no side.
#[test]
fn what_parry_has_no_shape_for_is_in_contact() {
    let vertices = [point(0.0, 0.0), point(0.0, 0.0), point(0.1, 0.0), point(0.0, 0.1)];
    let folded = Footprint::new([Part::new(Pose2::IDENTITY, Shape::Hull { vertices: vertices.into(), radius: 0.0 })]);
    assert!(folded.is_valid() && wall().intersects(&folded) && wall().distance(&folded) == 0.0);
    let beside = Footprint::new([Part::new(Pose2::new(9.0, 9.0, 0.0), folded.parts()[0].shape().clone())]);
    assert!(wall().swept(&folded, &beside));
}

#[test]
fn ties_go_to_the_lowest_part_and_then_to_the_first_obstacle() {
    let walls: Vec<Segment> = (0..200).map(|i| segment(f64::from(i), -1.0, f64::from(i), 1.0)).collect();
    let scene = Scene::of_walls(&walls);
    let black_box = ParryScene::of_scene(&scene);
    for i in [0, 3, 64, 150, 198] {
        // half way between two walls, and then across several
        let between =
            [0.5, 0.5].map(|dx| Part::new(Pose2::new(f64::from(i) + dx, 0.0, 0.0), Shape::Disc { radius: 0.25 }));
        let w = black_box.witness(&Footprint::new(between)).unwrap();
        assert_eq!((w.part, w.obstacle.0, w.dist), (0, i, 0.25));
        let across = Footprint::disc(point(f64::from(i) + 0.5, 0.0), 3.0);
        let w = black_box.witness(&across).unwrap();
        assert_eq!((w.dist, w.obstacle), (0.0, scene.witness(&across).unwrap().obstacle));
    }
}

#[test]
fn a_sweep_between_other_parts_is_a_hit_and_one_on_the_spot_is_the_first_question() {
    let [a, b] = [0.0, 1.0].map(|x| Footprint::disc(point(x, 1.0), 0.25));
    assert!(!wall().swept(&a, &b) && !wall().swept(&a, &a));
    assert!(wall().swept(&a, &Footprint::disc(point(1.0, 1.0), 0.5)), "another shape");
    assert!(wall().swept(&a, &Footprint::new([])), "another number of parts");
    let behind = Footprint::disc(point(6.0, 1.0), 0.25);
    assert!(!wall().intersects(&behind) && wall().swept(&a, &behind), "the wall stands between");
    let beside = Footprint::disc(point(6.0, -1.0), 0.25);
    assert!(!wall().swept(&Footprint::disc(point(0.0, -1.0), 0.25), &beside), "below the wall");
    let touching = Footprint::disc(point(2.75, 1.0), 0.25);
    assert!(wall().swept(&a, &touching) && wall().swept(&touching, &a) && wall().swept(&touching, &touching));
}

/// Parts that do not turn: parry casts them as the exact scene sweeps them, but for the rounding at a touch.
#[test]
fn sweeps_without_turns_are_those_of_the_exact_scene() {
    let mut s = Stream::new(Seed(46), "tests/black_box");
    let (mut hits, mut free) = (0, 0);
    for _ in 0..4000 {
        let [part, piece] = [0, 1].map(|_| {
            let kind = random_kind(&mut s);
            random_body(&mut s, kind, 2.0)
        });
        let scene = scene_of(std::slice::from_ref(&piece));
        let a = footprint_of(std::slice::from_ref(&part));
        let pose = a.parts()[0].pose();
        let moved = Pose2 { x: pose.x + s.uniform(-4.0, 4.0), y: pose.y + s.uniform(-4.0, 4.0), ..*pose };
        let b = Footprint::new([Part::new(moved, a.parts()[0].shape().clone())]);
        // the hull of both places is all that is swept; what comes nearer than 10 um is left to rounding
        let way = a.parts()[0].placed().hull_with(b.parts()[0].placed());
        let expected = touch(&way, &placed(&piece));
        if expected || plain::distance(&way, &placed(&piece)) > 1e-5 {
            assert_eq!(ParryScene::of_scene(&scene).swept(&a, &b), expected, "{part:?} to {moved:?}, {piece:?}");
            hits += u32::from(expected);
            free += u32::from(!expected);
        }
    }
    assert!(hits > 500 && free > 500, "{hits} hits, {free} free");
}

#[test]
fn nothing_is_proven_by_it() {
    let scene = wall();
    let far = Footprint::disc(point(-50.0, 0.0), 0.1);
    assert!(scene.distance(&far) > 50.0);
    let hull = far.parts()[0].placed();
    assert_eq!(scene.distance_of_hull(hull.clone()), 0.0);
    assert!(!scene.clears(hull, hull, 0.0));
    let disc = RustyDisc::default();
    let edge = disc.edge(&R2::new(-50.0, 0.0), &R2::new(-49.0, 0.0));
    let edge = edge.unwrap();
    let verdict = march(&scene, &edge, MarchOptions::default(), None);
    assert!(!verdict.is_free() && !is_free_among(&scene, &edge), "{verdict:?}");
    assert!(
        matches!(verdict, EdgeVerdict::Unresolved { free_until: 0.0, .. } | EdgeVerdict::Hit { .. }),
        "{verdict:?}"
    );
}

/// Sizes at the edge of what a placed shape may be: no panic, and no contact where things are far apart.
#[test]
fn huge_and_tiny_numbers_have_an_answer() {
    let mut s = Stream::new(Seed(47), "tests/black_box");
    let mut asked = 0;
    for _ in 0..3000 {
        let mut size = || {
            let size: f64 = format!("1e{}", i64::from(s.below(120) as u32) - 60).parse().unwrap();
            if s.unit() < 0.5 { -size } else { size }
        };
        let shapes = [
            Shape::Disc { radius: size().abs() },
            Shape::Segment { a: point(size(), size()), b: point(size(), size()) },
            Shape::Capsule { a: point(size(), size()), b: point(size(), size()), radius: size().abs() },
            Shape::Rectangle { min: point(-size().abs(), -size().abs()), max: point(size().abs(), size().abs()) },
        ];
        let poses = [Pose2::new(size(), size(), 0.3), Pose2::new(size(), size(), -2.0)];
        for (i, part) in shapes.iter().enumerate() {
            let obstacle = shapes[(i + 1) % 4].clone();
            let scene = Scene::empty(PLANE).with_obstacle_at("it", poses[0], obstacle);
            let black_box = ParryScene::of_scene(&scene);
            let [a, b] = poses.map(|pose| Footprint::new([Part::new(pose, part.clone())]));
            let dist = black_box.distance(&b);
            assert!(dist >= 0.0 && black_box.intersects(&b) == (dist == 0.0), "{b:?} {scene:?}");
            black_box.swept(&a, &b);
            asked += 1;
        }
    }
    assert_eq!(asked, 12_000);
}
