//! The jackknife limit: what is free, edges, driven arcs, certificates and ticks know it, the four questions do not.

use std::f64::consts::PI;

use motion_lab_core::collision::{
    Certificate, CertificateError, HitBy, MarchOptions, ProblemError, ProvenStep, march, verify_certificate,
};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellState, Slice};
use motion_lab_core::num::wrap;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{AnyRobot, TICK};

use oracle::car::time_to_fold;
use oracle::fixtures::PLANE;

/// A car and trailer that fold by at most 1.25 rad.
fn limited() -> Hitch {
    HITCH.with_trailer().with_jackknife(1.25)
}

fn at(theta: f64, psi: f64) -> HitchCfg {
    HitchCfg { body: Pose2::new(0.0, 0.0, theta), trailer: Some(psi) }
}

/// Fails unless the verdict is a hit of the limit by the trailer within 1e-12 of `s`.
#[track_caller]
fn held_at(verdict: EdgeVerdict, s: f64) {
    let EdgeVerdict::Hit { free_until, contact_at, part: 1, by: HitBy::Limit } = verdict else { panic!("{verdict:?}") };
    assert!(free_until <= s && s <= contact_at && contact_at - free_until < 1e-12, "{verdict:?}, not {s}");
}

#[test]
fn a_configuration_is_free_up_to_the_limit_itself() {
    let open = Checker::new(Scene::empty(PLANE), limited());
    let never = Checker::new(Scene::empty(PLANE), HITCH.with_trailer());
    let above = 1.25_f64.next_up();
    for (q, free) in [
        (at(0.0, 1.25), true),
        (at(0.0, -1.25), true),
        (at(0.0, above), false),
        (at(0.0, -above), false),
        (at(0.5, 0.5 + PI), false), // on each other
        (at(3.0, -3.0), true),      // 2 pi - 6 = 0.28 rad apart, across pi
        (at(3.0, -1.5), false),
        (at(3.0, 3.0 + 40.0 * PI), true), // turns on: the angle is the wrapped one
    ] {
        assert_eq!(open.is_free(&q), free, "{q}");
        assert!(never.is_free(&q), "without a limit {q} is free");
        // the four questions are about footprints
        let footprint = limited().footprint(&q);
        assert!(!open.scene().intersects(&footprint) && open.distance(&q) == f64::INFINITY);
        // an edge of one configuration is its freedom
        assert_eq!((open.edge_free(&q, &q), open.edge(&q, &q).unwrap().is_free()), (free, free), "{q}");
        assert_eq!(open.are_free(&[q]), [free]);
    }
    let alone = HITCH.with_jackknife(0.1);
    assert!(alone.is_within_limits(&HitchCfg { body: Pose2::IDENTITY, trailer: None }), "nothing to fold");
    assert!(!HITCH.with_trailer().with_jackknife(f64::NAN).is_within_limits(&at(0.0, 0.0)), "fails safe");
    assert_eq!(at(3.0, -3.0).hitch_angle(), Some(wrap(-6.0)));
}

#[test]
fn a_chart_line_leaves_the_limit_where_its_angle_reaches_it() {
    let open = Checker::new(Scene::empty(PLANE), limited());
    let edge = |a: HitchCfg, b: HitchCfg| {
        let verdict = open.edge(&a, &b).unwrap();
        assert_eq!(open.edge_free(&a, &b), verdict.is_free());
        let any = AnyRobot::Hitch(limited());
        let through = Checker::new(Scene::empty(PLANE), any);
        let as_any = AnyConfiguration::Hitch;
        assert_eq!(through.edge(&as_any(a), &as_any(b)).unwrap(), verdict);
        assert_eq!((through.is_free(&as_any(a)), through.is_free(&as_any(b))), (open.is_free(&a), open.is_free(&b)));
        verdict
    };
    // psi alone, to either side; the car alone; both at once
    held_at(edge(at(0.0, 0.0), at(0.0, 2.5)), 0.5);
    held_at(edge(at(0.0, 0.0), at(0.0, -2.5)), 0.5);
    held_at(edge(at(0.0, 0.0), at(2.5, 0.0)), 0.5);
    held_at(edge(at(0.0, 0.25), at(-1.5, 0.75)), 0.5);
    // across pi: from -0.25 rad the angle falls by 2, at twice the limit from its start
    held_at(edge(at(3.0, 2.75), at(-3.0, wrap(2.75 - (2.0 - (2.0 * PI - 6.0))))), 0.5);
    // both ends within, but the two turn away from each other all the way round: 1 + (2 pi - 3.5) + 2.5 rad
    held_at(edge(at(0.0, 1.0), at(-2.5, -2.5)), 0.25 / (2.0 * PI - 1.0));
    // to the limit and no farther, along it, and back
    assert!(edge(at(0.0, 0.0), at(0.0, 1.25)).is_free());
    assert!(edge(at(0.0, 1.25), at(0.0, -1.25)).is_free());
    assert!(edge(at(0.0, 1.0), at(0.5, 1.5)).is_free());
    // a start outside proves nothing, wherever it leads
    let outside = edge(at(0.0, 1.5), at(0.0, 0.0));
    assert!(matches!(outside, EdgeVerdict::Hit { free_until: 0.0, contact_at: 0.0, by: HitBy::Limit, .. }));
    assert_eq!(open.last_free(&at(0.0, 1.5), &at(0.0, 0.0)), Ok(None));
    let last = open.last_free(&at(0.0, 0.0), &at(0.0, 2.5)).unwrap().unwrap();
    assert!(open.is_free(&last) && (last.trailer.unwrap() - 1.25).abs() < 1e-12, "{last}");
    let last = open.last_free(&at(0.0, 1.25), &at(0.0, 2.5)).unwrap();
    assert_eq!(last, Some(at(0.0, 1.25)), "the start is free");
}

#[test]
fn random_lines_leave_the_limit_where_samples_do() {
    let mut s = Stream::new(Seed(18), "tests/jackknife");
    let (scene, car) = (Scene::empty(PLANE), limited());
    let checker = Checker::new(scene, car);
    let (mut free, mut held) = (0, 0);
    for _ in 0..2000 {
        let mut draw = || at(s.uniform(-PI, PI), s.uniform(-PI, PI));
        let (a, b) = (draw(), draw());
        if !checker.is_free(&a) {
            continue;
        }
        let line = car.edge(&a, &b).unwrap();
        let outside = (0..=1000).find(|i| !checker.is_free(&line.at(f64::from(*i) / 1000.0)));
        match (checker.edge(&a, &b).unwrap(), outside) {
            (EdgeVerdict::Free { .. }, None) => free += 1,
            (EdgeVerdict::Hit { free_until, contact_at, by: HitBy::Limit, .. }, Some(i)) => {
                held += 1;
                let first = f64::from(i) / 1000.0;
                assert!(contact_at <= first && free_until > first - 0.001 - 1e-12, "{free_until} {first}");
                assert!(checker.is_free(&line.at(free_until)) && !checker.is_free(&line.at(contact_at)));
            }
            other => panic!("{other:?} from {a} to {b}"),
        }
    }
    assert!(free > 100 && held > 100, "{free} free, {held} held");
}

#[test]
fn an_obstacle_before_the_limit_is_hit_first_and_one_behind_it_is_not() {
    let car = limited();
    let side = 0.5 * car.trailer_body.width;
    // the trailer's outer rear corner, 2.8 m behind the hitch, sweeps a circle; a pin in its way
    let pin = |angle: f64| {
        let place = Pose2::new(0.0, 0.0, angle).transform(Point2::new(-2.5, -side - 0.2));
        Scene::empty(PLANE).with_obstacle_at("pin", Pose2::new(place.x, place.y, 0.0), Shape::Disc { radius: 0.1 })
    };
    let (a, b) = (at(0.0, 0.0), at(0.0, 2.5));
    let mut certificate = Certificate::new();
    let mut ask = |scene: Scene| {
        let checker = Checker::new(scene, car);
        let verdict = checker.edge_certified(&a, &b, &mut certificate).unwrap();
        let edge = car.edge(&a, &b).unwrap();
        let EdgeVerdict::Hit { free_until, contact_at, part: 1, by } = verdict else { panic!("{verdict:?}") };
        assert_eq!(verify_certificate(checker.scene(), &edge, &certificate), Ok(free_until));
        assert!(free_until > 0.0 && free_until < contact_at && contact_at - free_until < 1e-6, "{verdict:?}");
        // the public march agrees
        let marched = march(checker.scene(), &edge, MarchOptions::default(), Some(&mut certificate));
        let EdgeVerdict::Hit { free_until: until, contact_at: met, by: same, .. } = marched else {
            panic!("{marched:?}")
        };
        assert!(until < met && met - until < 1e-6, "{marched:?}");
        assert_eq!((by, verify_certificate(checker.scene(), &edge, &certificate)), (same, Ok(until)));
        assert!((until - free_until).abs() < 1e-6, "{marched:?} {verdict:?}");
        // a proof that goes on beyond the limit is refused, however free of obstacles the way is
        if by == HitBy::Limit {
            let steps = certificate.steps().to_vec();
            let from = steps[steps.len() - 1].to;
            for beyond in [contact_at + 1e-3, contact_at, until.next_up()] {
                let longer = steps.iter().copied().chain([ProvenStep { from, to: beyond, clearance: 1e-6 }]).collect();
                let forged = verify_certificate(checker.scene(), &edge, &Certificate::from_steps(0.0, longer));
                assert!(matches!(forged, Err(CertificateError::BeyondLimit { .. })), "{forged:?}");
            }
        }
        // one that gives up on its way to the limit has proven what its certificate proves
        let mut gave_up = 0;
        for budget in 1..12 {
            let options = MarchOptions { budget, ..MarchOptions::default() };
            let marched = march(checker.scene(), &edge, options, Some(&mut certificate));
            if let EdgeVerdict::Unresolved { free_until, .. } = marched {
                gave_up += u32::from(free_until > 0.0);
                assert_eq!(verify_certificate(checker.scene(), &edge, &certificate), Ok(free_until));
            }
        }
        assert!(gave_up > 0 || by == HitBy::Limit, "near the pin it needs more");
        (by, free_until)
    };
    let (by, until) = ask(pin(1.0));
    assert!(matches!(by, HitBy::Obstacle(_)) && until > 0.4 && until < 0.45, "{by:?} {until}");
    for scene in [pin(2.0), pin(-1.0), Scene::empty(PLANE)] {
        let (by, until) = ask(scene);
        assert!(by == HitBy::Limit && (until - 0.5).abs() < 1e-12, "{by:?} {until}");
    }
    // a start beyond the limit hits the limit, in contact or not
    let on_the_car = Scene::empty(PLANE).with_obstacle_at("pin", Pose2::IDENTITY, Shape::Disc { radius: 0.1 });
    let outside = Checker::new(on_the_car, car).edge(&at(0.0, 1.5), &at(0.0, 2.5)).unwrap();
    let at_once = EdgeVerdict::Hit { free_until: 0.0, contact_at: 0.0, part: 1, by: HitBy::Limit };
    assert!(outside == at_once, "{outside:?}");
    // a start in contact, at the limit, is not free for that
    let folded = Checker::new(pin(1.25), car.with_jackknife(1.3));
    let (touching, on) = (at(0.0, 1.3), at(0.0, 1.6));
    let q = folded.edge(&touching, &on).unwrap();
    assert_eq!(folded.is_free(&touching), folded.last_free(&touching, &on).unwrap().is_some(), "{q:?}");
}

#[test]
fn a_start_or_a_goal_outside_is_refused() {
    let checker = || Checker::new(Scene::empty(PLANE), limited());
    let (inside, outside) = (at(0.0, 0.0), at(0.0, 2.0));
    assert!(Problem::try_new(checker(), inside, at(0.0, 1.25), Seed(1)).is_ok());
    for (a, b, which) in [(outside, inside, "start"), (inside, outside, "goal")] {
        let error = Problem::try_new(checker(), a, b, Seed(1)).unwrap_err();
        assert_eq!(error, ProblemError::Limit { end: which });
    }
    let mut problem = Problem::try_new(checker(), inside, inside, Seed(1)).unwrap();
    for _ in 0..200 {
        let q = problem.sample_free(100).unwrap();
        assert!(q.hitch_angle().unwrap().abs() <= 1.25, "{q}");
    }
}

#[test]
fn a_slice_of_the_configuration_space_with_a_folded_hitch_is_blocked() {
    let checker = Checker::new(Scene::empty(PLANE), AnyRobot::Hitch(limited()));
    for (psi, state) in [(1.25, CellState::Free), (1.26, CellState::Blocked)] {
        let slice = Slice::through(&checker, &AnyConfiguration::Hitch(at(0.0, psi))).unwrap();
        assert_eq!(slice.judge([3.0, 4.0], [0.5, 0.5]), state, "at {psi}");
    }
}

#[test]
fn a_reversing_arc_hits_the_limit_when_its_equation_says() {
    let car = limited();
    let open = Checker::new(Scene::empty(PLANE), car);
    for (start, side) in [(0.1, 1.0), (0.4, -1.0), (1.0, 1.0), (1.2499, 1.0)] {
        let q = at(0.75, 0.75 + side * start);
        let time = time_to_fold(start, 1.25, 1.5, 2.0);
        for dt in [TICK, 1.0, 5.0, 7.02] {
            let arc = car.drive(&q, &CarCmd { v: -1.5, phi: 0.0 }, dt).unwrap();
            let verdict = open.motion_verdict(&arc);
            if time > dt {
                assert!(verdict.is_free(), "{verdict:?} in {dt} s, {time} s from the limit");
                continue;
            }
            let EdgeVerdict::Hit { free_until, contact_at, part: 1, by: HitBy::Limit } = verdict else {
                panic!("{verdict:?} after {dt} s")
            };
            assert!((free_until * dt - time).abs() < 1e-7, "{} s, not {time} s", free_until * dt);
            assert!(open.is_free(&arc.at(free_until)) && !open.is_free(&arc.at(contact_at)));
            assert!(contact_at - free_until < 1e-14, "{verdict:?}");
        }
        // ahead it unfolds, from the limit itself too
        for start in [start, 1.25] {
            let ahead = car.drive(&at(0.0, side * start), &CarCmd { v: 1.5, phi: 0.0 }, 5.0).unwrap();
            assert!(open.motion_verdict(&ahead).is_free());
        }
    }
    // without a limit it goes on
    let free = HITCH.with_trailer().drive(&at(0.0, 1.2), &CarCmd { v: -1.5, phi: 0.0 }, 5.0).unwrap();
    assert!(Checker::new(Scene::empty(PLANE), HITCH.with_trailer()).motion_verdict(&free).is_free());
}

#[test]
fn every_place_of_a_free_arc_lies_within() {
    let mut s = Stream::new(Seed(19), "tests/jackknife");
    let (mut free, mut held) = (0, 0);
    for i in 0..3000 {
        let car = limited().with_jackknife([0.5, 1.25, 3.0][i % 3]);
        let q = at(s.uniform(-PI, PI), s.uniform(-PI, PI));
        if !car.is_within_limits(&q) {
            continue;
        }
        // the last are so fast that within a tick the hitch could go round
        let u = CarCmd { v: s.uniform(-1.0, 1.0) * [1.5, 1.5, 40.0][i / 3 % 3], phi: s.uniform(-0.6, 0.6) };
        let arc = car.drive(&q, &u, [TICK, 0.02, 2.0, 3.01][i % 4]).unwrap();
        let verdict = Checker::new(Scene::empty(PLANE), car).motion_verdict(&arc);
        let until = match verdict {
            EdgeVerdict::Hit { free_until, .. } => free_until,
            _ => 1.0,
        };
        free += u32::from(verdict.is_free());
        held += u32::from(!verdict.is_free());
        for k in 0..=200 {
            let place = arc.at(until * f64::from(k) / 200.0);
            // beyond by the integration's error at most
            let beyond = place.hitch_angle().unwrap().abs() - car.jackknife.unwrap();
            assert!(beyond <= if u.v.abs() < 1.5 { 1e-9 } else { 1e-2 }, "{beyond} beyond at {place} of {u:?}");
        }
    }
    assert!(free > 500 && held > 150, "{free} free, {held} held");
}
