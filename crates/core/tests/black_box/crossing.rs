//! Segments that cross: parry's nearest points are a hair apart, and the chapter's march goes through a wall.

use motion_lab_core::collision::{ChainChecker, Collision, EdgeVerdict, ParryScene};
use motion_lab_core::geometry::{Footprint, Part, Pose2, Shape};
use motion_lab_core::num::{atan2, greater, lesser};
use motion_lab_core::picture::{Figure, Panel, Picture, Role, footprint};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{Motion, Robot};

use super::figures::{check_figure, frame, walls};

/// The least step of the chapter's march.
const LEAST_STEP: f64 = 0.02;

/// An arm without thickness, and a wall in its way.
fn arm(a: Point2, b: Point2) -> ChainChecker<2> {
    ChainChecker::new(Scene::of_walls(&[Segment::new(a, b)]), Reach::<2>::choset())
}

/// Where a march that trusts the distance alone steps on an edge through a wall, if it calls the edge free, and at
/// which of its steps the arm crosses the wall.
fn passed(arm: &ChainChecker<2>) -> Option<Vec<f64>> {
    let (black_box, [a, b]) = (ParryScene::of_scene(arm.scene()), ends());
    let edge = arm.robot().edge(&a, &b).ok()?;
    let (is_free, steps) = chapters_march(|at| by_closest_points(&black_box, at), &edge);
    let crossed = steps.into_iter().filter(|s| arm.scene().intersects(&edge.footprint_at(*s))).collect();
    is_free.then_some(crossed)
}

fn ends() -> [T2; 2] {
    [T2::new(0.0, 0.0), T2::new(1.0, 0.0)]
}

/// The chapter's `edge_free`: steps of the distance over the bound, and at least the least step. Returns whether it
/// calls the edge free, and where it stepped.
fn chapters_march(distance: impl Fn(&Footprint) -> f64, motion: &impl Motion) -> (bool, Vec<f64>) {
    // no point of the two links of 1 m moves farther than 2 m in the whole radian
    let (bound, mut s, mut steps) = (2.0, 0.0, Vec::new());
    while s < 1.0 {
        steps.push(s);
        let d = distance(&motion.footprint_at(s));
        if d <= 0.0 {
            return (false, steps);
        }
        s += greater(d / bound, LEAST_STEP);
    }
    (true, steps)
}

/// How far apart the chapter's `distance` calls a footprint and the obstacles.
fn by_closest_points(scene: &ParryScene, footprint: &Footprint) -> f64 {
    scene.closest_points(footprint).map_or(f64::INFINITY, |witness| witness.dist)
}

#[test]
fn closest_points_call_segments_that_cross_a_hair_apart() {
    let mut s = Stream::new(Seed(45), "tests/crossing");
    let (mut crossing, mut called_apart, mut most) = (0, 0, 0.0);
    for _ in 0..5000 {
        let mut point = || Point2::new(s.uniform(-2.0, 2.0), s.uniform(-2.0, 2.0));
        let (wall, a, b) = (Segment::new(point(), point()), point(), point());
        let scene = Scene::of_walls(&[wall]);
        let link = Footprint::new([Part::new(Pose2::IDENTITY, Shape::Segment { a, b })]);
        if scene.intersects(&link) {
            let black_box = ParryScene::of_scene(&scene);
            let apart = by_closest_points(&black_box, &link);
            assert!(
                black_box.intersects(&link) && black_box.distance(&link) == 0.0,
                "it asks `intersection_test` first"
            );
            crossing += 1;
            called_apart += u32::from(apart > 0.0);
            most = greater(most, apart);
        }
    }
    assert!(crossing > 1000, "{crossing}");
    assert!(called_apart > crossing * 9 / 10, "{called_apart} of {crossing}");
    assert!((1e-16..1e-12).contains(&most), "{most}");
}

#[test]
fn a_march_that_trusts_them_goes_through_walls() {
    let (mut through, mut first) = (0, None);
    for i in 0..10 {
        for j in 1..8 {
            let a = Point2::new(0.5 + 0.05 * f64::from(i), 0.1 * f64::from(j));
            let b = Point2::new(a.x + 0.3, a.y + 0.3);
            let arm = arm(a, b);
            let [from, to] = ends();
            let Some(crossed) = passed(&arm).filter(|crossed| crossed.len() >= 3) else { continue };
            // the first link to meet the wall lies along a line through the base: at the bearing of one of its ends
            let bearing = lesser(atan2(a.y, a.x), atan2(b.y, b.x));
            let verdict = arm.edge(&from, &to).unwrap();
            let EdgeVerdict::Hit { free_until, contact_at, .. } = verdict else { panic!("{verdict:?}") };
            assert!(
                (free_until - bearing).abs() < 1e-5 && (contact_at - bearing).abs() < 1e-5,
                "{verdict:?} {bearing}"
            );
            let edge = arm.robot().edge(&from, &to).unwrap();
            let black_box = ParryScene::of_scene(arm.scene());
            for s in &crossed {
                let apart = by_closest_points(&black_box, &edge.footprint_at(*s));
                assert!(apart > 0.0 && apart < 1e-14, "{apart}");
            }
            // the black box of the lab asks `intersection_test` too, and ends the same march
            assert!(!chapters_march(|at| black_box.distance(at), &edge).0);
            through += 1;
            first = first.or(Some((arm, crossed)));
        }
    }
    assert!(through >= 5, "{through} walls");
    let (arm, crossed) = first.unwrap();
    let [from, to] = ends();
    figure(&arm, &arm.robot().edge(&from, &to).unwrap(), &crossed);
}

fn figure(arm: &ChainChecker<2>, edge: &impl Motion, crossed: &[f64]) {
    let mut picture = Picture::new("an arm goes through a wall", frame([-0.1, -0.1], [2.1, 1.8]));
    for k in 0..=10 {
        let s = f64::from(k) / 10.0;
        picture = picture.with(footprint(&format!("way/{k}"), "on the way", &edge.footprint_at(s), Role::Path, 0.3));
    }
    let at = crossed[crossed.len() / 2];
    let picture = picture
        .with(walls(arm.scene()))
        .with(footprint("from", "the start", &edge.footprint_at(0.0), Role::Robot, 1.0))
        .with(footprint("to", "the end", &edge.footprint_at(1.0), Role::Free, 1.0))
        .with(footprint("across", "a link across the wall", &edge.footprint_at(at), Role::Goal, 1.0));
    check_figure(
        "crossing",
        &Figure {
            title: "Crossing segments".to_owned(),
            description: "An arm turns through a wall. Red: across it, where parry's nearest points are not one."
                .to_owned(),
            panels: vec![Panel { picture, heading: "called free by the chapter's march".to_owned(), readout: vec![] }],
            caption: vec![],
        },
    );
}
