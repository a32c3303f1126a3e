//! Angles far outside (-pi, pi]: a heading has one footprint, edge, sweep and drive, however many turns its number
//! contains.
//!
//! The meaning of an angle is its definition: the remainder of division by the `f64` nearest to 2 pi, which the
//! language's `%` gives exactly.

use std::f64::consts::{PI, TAU};

use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::geometry::{Aabb, Placed};
use motion_lab_core::prelude::*;
use oracle::fixtures::count_from_env;
use oracle::plain;

/// An angle reduced to (-pi, pi] by the remainder.
fn short(angle: f64) -> f64 {
    let r = angle % TAU;
    if r > PI {
        r - TAU
    } else if r <= -PI {
        r + TAU
    } else {
        r
    }
}

/// An angle of any size: in range, exactly at a border, or up to 1e15 rad.
fn angle(s: &mut Stream) -> f64 {
    let magnitude = [1e2, 1e3, 1e6, 1e9, 1e12, 1e15][s.below(6) as usize];
    match s.below(8) {
        0 => s.uniform(-PI, PI),
        1 => -PI,
        2 => PI + f64::EPSILON * 2.0,
        3 => (s.below(200) as f64 - 100.0) * TAU,
        _ => s.uniform(-magnitude, magnitude),
    }
}

/// Boxes and discs about a point, so near that one in three configurations touches something.
fn crowd(s: &mut Stream, count: u32) -> Scene {
    let bounds = Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) };
    (0..count).fold(Scene::empty(bounds), |scene, i| {
        let (x, y, size) = (s.uniform(-5.0, 5.0), s.uniform(-5.0, 5.0), s.uniform(0.02, 0.4));
        let corner = Point2::new(x, y);
        let shape = Shape::try_rectangle(corner, Point2::new(x + size, y + size)).unwrap();
        scene.with_obstacle(&format!("box {i}"), shape)
    })
}

fn touches(footprint: &Footprint, obstacles: &[Placed]) -> bool {
    footprint.parts().iter().any(|p| obstacles.iter().any(|o| plain::intersects(p.placed(), o)))
}

fn obstacles(scene: &Scene) -> Vec<Placed> {
    scene.pieces().map(|(_, piece)| piece.clone()).collect()
}

/// Asks everything about two configurations of a robot: `far` with any angles, `near` the same with its angles in
/// range.
fn one_answer<R: Robot>(scene: &Scene, robot: &R, far: [R::Configuration; 2], near: [R::Configuration; 2]) -> bool {
    let checker = Checker::new(scene.clone(), robot.clone());
    let placed = obstacles(scene);
    for (f, n) in far.iter().zip(&near) {
        assert_eq!(robot.footprint(f), robot.footprint(n), "{f:?}");
        assert_eq!(checker.is_free(f), checker.is_free(n), "{f:?}");
        assert_eq!(checker.distance(f).to_bits(), checker.distance(n).to_bits(), "{f:?}");
        assert_eq!(checker.witness(f).unwrap(), checker.witness(n).unwrap(), "{f:?}");
    }
    // every mixture of ends is the same edge and the same sweep
    let verdict = checker.edge(&near[0], &near[1]).unwrap();
    let swept = scene.swept(&robot.footprint(&near[0]), &robot.footprint(&near[1]));
    for (a, b) in [(far[0], far[1]), (far[0], near[1]), (near[0], far[1])] {
        assert_eq!(checker.edge(&a, &b).unwrap(), verdict, "{a:?} to {b:?}");
        assert_eq!(checker.edge_free(&a, &b), verdict.is_free(), "{a:?} to {b:?}");
        assert_eq!(scene.swept(&robot.footprint(&a), &robot.footprint(&b)), swept);
        let last = checker.last_free(&a, &b).unwrap();
        assert_eq!(last, checker.last_free(&near[0], &near[1]).unwrap(), "{a:?} to {b:?}");
    }
    // the edge between two writings of one configuration is free exactly when the footprint is, by the oracle
    let still = checker.edge(&far[0], &near[0]).unwrap();
    let there = touches(&robot.footprint(&near[0]), &placed);
    assert_eq!(still.is_free(), !there && checker.is_free(&near[0]), "{:?}", far[0]);
    if let EdgeVerdict::Free { .. } = verdict {
        let edge = robot.edge(&far[0], &far[1]).unwrap();
        for i in 0..=16 {
            assert!(
                !touches(&edge.footprint_at(f64::from(i) / 16.0), &placed),
                "{:?} to {:?} at {i}/16",
                far[0],
                far[1]
            );
        }
    }
    verdict.is_free()
}

#[test]
fn an_angle_many_turns_on_is_the_same_angle() {
    let mut s = Stream::new(Seed(16), "angles");
    let mut scene = crowd(&mut s, 40);
    let (mut free, mut all) = (0, 0);
    for i in 0..count_from_env("MOTION_LAB_EDGES", 3_000) {
        if i % 100 == 0 {
            scene = crowd(&mut s, 40);
        }
        let mut pose = || Pose2 { x: s.uniform(-4.0, 4.0), y: s.uniform(-4.0, 4.0), theta: angle(&mut s) };
        let bodies = [pose(), pose()];
        let angles: [[f64; 3]; 2] = [(); 2].map(|()| [(); 3].map(|()| angle(&mut s)));
        let wrapped = |p: Pose2| Pose2 { theta: short(p.theta), ..p };
        let car = |body: Pose2, psi: Option<f64>| HitchCfg { body, trailer: psi };
        let results = [
            one_answer(
                &scene,
                &HITCH,
                [0, 1].map(|k| car(bodies[k], None)),
                [0, 1].map(|k| car(wrapped(bodies[k]), None)),
            ),
            one_answer(
                &scene,
                &HITCH.with_trailer(),
                [0, 1].map(|k| car(bodies[k], Some(angles[k][0]))),
                [0, 1].map(|k| car(wrapped(bodies[k]), Some(short(angles[k][0])))),
            ),
            one_answer(&scene, &Reach::<3>::redundant(), angles.map(Tn), angles.map(|q| Tn(q.map(short)))),
            one_answer(
                &scene,
                &Reach::<2>::workbench(),
                angles.map(|[a, b, _]| Tn([a, b])),
                angles.map(|[a, b, _]| Tn([short(a), short(b)])),
            ),
            one_answer(&scene, &RUSTY, bodies, bodies.map(wrapped)),
        ];
        free += results.iter().filter(|free| **free).count();
        all += results.len();
    }
    assert!(free * 20 > all && (all - free) * 4 > all, "{free} of {all} edges are free: too few of one kind");
}

#[test]
fn a_drive_from_an_angle_many_turns_on_is_the_drive_from_that_heading() {
    let mut s = Stream::new(Seed(17), "drives");
    for _ in 0..2_000 {
        let body = Pose2 { x: s.uniform(-4.0, 4.0), y: s.uniform(-4.0, 4.0), theta: angle(&mut s) };
        let (psi, dt) = (angle(&mut s), s.uniform(0.05, 2.0));
        let near = Pose2 { theta: short(body.theta), ..body };
        let u = CarCmd { v: s.uniform(-2.0, 2.0), phi: s.uniform(-0.5, 0.5) };
        let towing = HITCH.with_trailer();
        let far = towing.drive(&HitchCfg { body, trailer: Some(psi) }, &u, dt).unwrap();
        let same = towing.drive(&HitchCfg { body: near, trailer: Some(short(psi)) }, &u, dt).unwrap();
        let rover = RustyCmd { v: s.uniform(-0.5, 0.5), omega: s.uniform(-2.0, 2.0) };
        let (arc, same_arc) = (RUSTY.drive(&body, &rover, dt).unwrap(), RUSTY.drive(&near, &rover, dt).unwrap());
        for i in 0..=4 {
            let t = f64::from(i) / 4.0;
            assert_eq!(far.at(t), same.at(t), "{body:?} {psi} at {t}");
            assert_eq!(far.footprint_at(t), same.footprint_at(t));
            assert_eq!(arc.at(t), same_arc.at(t), "{body:?} at {t}");
        }
    }
}

#[test]
fn angles_in_range_keep_their_bits() {
    let mut s = Stream::new(Seed(18), "bits");
    for q in (0..1_000).map(|_| Tn([s.uniform(-PI, PI), -0.0])).chain([Tn([PI, -0.0])]) {
        let edge = Reach::<2>::workbench().edge(&q, &T2::new(0.5, 0.5)).unwrap();
        let same = edge.at(0.0).0.iter().zip(q.0).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{q:?} {:?}", edge.at(0.0));
    }
    // a pose and a trailer too: in edges, drives and parts
    let body = Pose2 { x: 1.0, y: 2.0, theta: -0.0 };
    let (towing, car) = (HITCH.with_trailer(), HitchCfg { body, trailer: Some(-0.0) });
    let (u, rover) = (CarCmd { v: 1.0, phi: 0.1 }, RustyCmd { v: 0.1, omega: 0.1 });
    let minus_zero = |x: f64| x.to_bits() == (-0.0_f64).to_bits();
    for q in [towing.edge(&car, &car).unwrap().at(0.0), towing.drive(&car, &u, 0.1).unwrap().at(0.0)] {
        assert!(minus_zero(q.body.theta) && q.trailer.is_some_and(minus_zero), "{q:?}");
    }
    for q in [RUSTY.edge(&body, &body).unwrap().at(0.0), RUSTY.drive(&body, &rover, 0.1).unwrap().at(0.0)] {
        assert!(minus_zero(q.theta), "{q:?}");
    }
    assert!(towing.footprint(&car).parts().iter().all(|part| minus_zero(part.pose().theta)));

    let edge = Reach::<2>::workbench().edge(&Tn([-PI, 0.0]), &Tn([-PI, 0.0])).unwrap();
    assert_eq!(edge.at(0.0), Tn([PI, 0.0]), "-pi is pi");
}

#[test]
fn a_configuration_that_is_not_finite_stays_one() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let checker = Checker::new(Scene::lot(), HITCH);
        let q = HitchCfg { body: Pose2 { x: 6.5, y: 2.5, theta: bad }, trailer: None };
        assert!(!checker.is_free(&q) && checker.distance(&q) == 0.0 && checker.edge(&q, &q).is_err());
        assert!(!HITCH.footprint(&q).is_valid());
    }
}
