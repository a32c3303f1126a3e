//! A car's drive over many ticks: the chain of its ticks' motions, which is what the simulator then does.

use std::f64::consts::PI;

use motion_lab_core::collision::{Certificate, MarchOptions, ProvenStep, march, verify_certificate};
use motion_lab_core::num::{cos, sin, tan, wrap};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ConfigurationError, TICK};

/// The bits of a configuration's coordinates.
fn bits(q: &HitchCfg) -> Vec<u64> {
    q.coordinates().iter().map(|x| x.to_bits()).collect()
}

/// A random car, with or without a trailer, its configuration and its control.
fn draw(s: &mut Stream, towing: bool) -> (Hitch, HitchCfg, CarCmd) {
    let car = if towing { HITCH.with_trailer() } else { HITCH };
    let body = Pose2::new(s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0), s.uniform(-PI, PI));
    let trailer = towing.then(|| s.uniform(-PI, PI));
    (car, HitchCfg { body, trailer }, CarCmd { v: s.uniform(-1.5, 1.5), phi: s.uniform(-0.7, 0.7) })
}

#[test]
fn at_every_tick_an_arc_is_where_ticking_leads_to_the_last_bit() {
    let mut s = Stream::new(Seed(18), "tests/arcs");
    for i in 0..300 {
        let (car, start, u) = draw(&mut s, i % 3 > 0);
        for ticks in [1_u32, 2, 7, 25, 40, 1000] {
            if ticks == 1000 && i > 3 {
                continue;
            }
            // as a product, as a decimal, and as a sum, which all differ by rounding
            let decimal: f64 = format!("{:.2}", f64::from(5 * ticks) / 100.0).parse().unwrap();
            let sum = (0..ticks).fold(0.0, |t, _| t + TICK);
            for dt in [TICK * f64::from(ticks), decimal, sum] {
                let arc = car.drive(&start, &u, dt).unwrap();
                let mut q = start;
                assert_eq!(bits(&arc.at(0.0)), bits(&q));
                for tick in 1..=ticks {
                    let one = car.drive(&q, &u, TICK).unwrap();
                    let half = arc.at((f64::from(tick) - 0.5) / f64::from(ticks));
                    let apart = one.at(0.5).difference(&half).unwrap();
                    assert!(apart.iter().all(|d| d.abs() < 1e-12), "within tick {tick} of {ticks}: {half}");
                    q = one.at(1.0);
                    let found = arc.at(f64::from(tick) / f64::from(ticks));
                    assert_eq!(bits(&found), bits(&q), "tick {tick} of {ticks}, {dt} s from {start} with {u:?}");
                }
                assert_eq!(bits(&car.step(&start, &u, dt).unwrap()), bits(&q));
            }
        }
    }
}

#[test]
fn a_last_part_of_a_tick_is_the_beginning_of_that_ticks_motion() {
    let mut s = Stream::new(Seed(19), "tests/arcs");
    for i in 0..300 {
        let (car, start, u) = draw(&mut s, i % 3 > 0);
        let arc = car.drive(&start, &u, 7.25 * TICK).unwrap();
        assert!((arc.ticks() - 7.25).abs() < 1e-14);
        let mut q = start;
        for tick in 1..=7 {
            q = car.step(&q, &u, TICK).unwrap();
            assert_eq!(bits(&arc.at(f64::from(tick) / arc.ticks())), bits(&q), "tick {tick}");
        }
        let end = car.drive(&q, &u, TICK).unwrap().at(0.25);
        let apart = arc.at(1.0).difference(&end).unwrap();
        assert!(apart.iter().all(|d| d.abs() < 1e-14), "{} is not {end}", arc.at(1.0));
        // a tick or less is one piece, whose bits are those of every release before
        let part = car.drive(&start, &u, 0.25 * TICK).unwrap().at(1.0);
        let whole = car.drive(&start, &u, TICK).unwrap().at(0.25);
        assert!(part.difference(&whole).unwrap().iter().all(|d| d.abs() < 1e-14), "{part} {whole}");
    }
}

/// The configuration after `t` seconds by the equations of motion alone: Runge and Kutta's method with 4000 steps on
/// all four of them.
fn integrated(car: &Hitch, q: &HitchCfg, u: &CarCmd, t: f64) -> [f64; 4] {
    const STEPS: u32 = 4000;
    let d = car.hitch_len.unwrap();
    let turn = tan(u.phi.clamp(-car.max_steer, car.max_steer)) / car.wheelbase;
    let slope =
        |[_, _, theta, psi]: [f64; 4]| [u.v * cos(theta), u.v * sin(theta), u.v * turn, u.v / d * sin(theta - psi)];
    let h = t / f64::from(STEPS);
    let plus = |y: [f64; 4], k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i: usize| y[i] + h * k[i]);
    let mut y = [q.body.x, q.body.y, q.body.theta, q.trailer.unwrap()];
    for _ in 0..STEPS {
        let a = slope(y);
        let b = slope(plus(y, a, 0.5 * h));
        let c = slope(plus(y, b, 0.5 * h));
        let d = slope(plus(y, c, h));
        y = [0, 1, 2, 3].map(|i: usize| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    y
}

#[test]
fn a_long_arc_follows_the_equations_of_motion_everywhere() {
    let mut s = Stream::new(Seed(20), "tests/arcs");
    for _ in 0..60 {
        let (car, start, u) = draw(&mut s, true);
        let dt = s.uniform(0.2, 6.0);
        for dt in [dt, -dt] {
            let arc = car.drive(&start, &u, dt).unwrap();
            for part in [0.13, 0.5, 0.77, 1.0] {
                let (q, y) = (arc.at(part), integrated(&car, &start, &u, part * dt));
                let apart = [q.body.x - y[0], q.body.y - y[1]];
                assert!(apart.iter().all(|d| d.abs() < 1e-11), "{q} is not {y:?}");
                assert!(wrap(q.body.theta - y[2]).abs() < 1e-11, "{q} is not {y:?}");
                // backing up, the error grows by e for every two metres, the length of the bar
                assert!(wrap(q.trailer.unwrap() - y[3]).abs() < 1e-7, "{q} is not {y:?}");
            }
        }
    }
}

#[test]
fn the_bounds_hold_across_the_ends_of_ticks() {
    let mut s = Stream::new(Seed(21), "tests/arcs");
    let mut tight = 0;
    for i in 0..400 {
        let (car, start, u) = draw(&mut s, i % 4 > 0);
        let arc = car.drive(&start, &u, s.uniform(0.06, 3.0)).unwrap();
        for _ in 0..40 {
            let (a, b) = (s.unit(), s.unit());
            // short spans too, down to what rounding allows
            let b = if i % 2 == 0 { b } else { (a + 1e-6 * b).clamp(0.0, 1.0) };
            let [f, m, g] = [a, 0.5 * (a + b), b].map(|at| arc.footprint_at(at));
            for part in 0..f.parts().len() {
                for v in 0..4 {
                    let [p, m, q] = [&f, &m, &g].map(|f| f.parts()[part].placed().core()[v]);
                    let (moved, bow) = ((q - p).norm(), (m - (p + (q - p) * 0.5)).norm());
                    assert!(moved <= arc.bound(part, a, b) + 1e-13, "part {part} from {a} to {b} of {u:?}: {moved}");
                    assert!(bow <= arc.sagitta(part, a, b) + 1e-13, "part {part} from {a} to {b} of {u:?}: {bow}");
                    tight += u32::from(moved > 0.9 * arc.bound(part, a, b) || bow > 0.9 * arc.sagitta(part, a, b));
                }
            }
        }
    }
    assert!(tight > 1000, "only {tight} come near their bounds");
}

#[test]
fn a_certificate_of_a_chain_is_accepted_and_covers_every_tick_of_the_way() {
    let mut s = Stream::new(Seed(22), "tests/arcs");
    let (scene, mut certificate) = (Scene::lot(), Certificate::new());
    let bounds = scene.bounds();
    let (mut free, mut hits, mut steps) = (0, 0, 0);
    for i in 0..600 {
        let towing = i % 3 > 0;
        let car = if towing { HITCH.with_trailer() } else { HITCH };
        let start = car.sample(bounds.min, bounds.max, &mut s);
        if scene.intersects(&car.footprint(&start)) {
            continue;
        }
        let u = CarCmd { v: s.uniform(-1.5, 1.5), phi: s.uniform(-0.6, 0.6) };
        let ticks = [7_u32, 40, 60][i % 3];
        let arc = car.drive(&start, &u, f64::from(ticks) * TICK).unwrap();
        let verdict = march(&scene, &arc, MarchOptions::default(), Some(&mut certificate));
        assert_eq!(verdict.is_free(), Checker::new(scene.clone(), car).motion_verdict(&arc).is_free());
        let until = match verdict {
            EdgeVerdict::Free { .. } => 1.0,
            EdgeVerdict::Hit { free_until, .. } | EdgeVerdict::Unresolved { free_until, .. } => free_until,
        };
        assert_eq!(verify_certificate(&scene, &arc, &certificate), Ok(until));
        let mut q = start;
        for tick in 1..=ticks {
            q = car.step(&q, &u, TICK).unwrap();
            let clear = scene.distance(&car.footprint(&q));
            assert!(f64::from(tick) / f64::from(ticks) > until || clear >= certificate.clearance(), "{clear}");
        }
        free += u32::from(verdict.is_free());
        hits += u32::from(matches!(verdict, EdgeVerdict::Hit { free_until, .. } if free_until > 0.0));
        steps += certificate.steps().len();
        // one step over all of it claims the clearance of its ends
        let ends = [0.0, 1.0].map(|at| scene.distance(&arc.footprint_at(at)));
        let lie = ProvenStep { from: 0.0, to: 1.0, clearance: if ends[0] < ends[1] { ends[0] } else { ends[1] } };
        assert!(verify_certificate(&scene, &arc, &Certificate::from_steps(0.0, vec![lie])).is_err());
    }
    assert!(free > 20 && hits > 20 && steps > 200, "{free} free, {hits} hits, {steps} steps");
}

#[test]
fn a_drive_has_at_most_an_hour() {
    let (car, q) = (HITCH, HitchCfg { body: Pose2::IDENTITY, trailer: None });
    let u = CarCmd { v: 0.001, phi: 0.1 };
    assert!(car.drive(&q, &u, 3600.0).is_ok() && car.drive(&q, &u, -3600.0).is_ok());
    for dt in [3600.1, -3600.1, 1e12] {
        assert_eq!(car.drive(&q, &u, dt).unwrap_err(), ConfigurationError::TooLong);
    }
    assert_eq!(car.drive(&q, &u, f64::INFINITY).unwrap_err(), ConfigurationError::ControlNotFinite);
    assert_eq!(car.drive(&q, &u, f64::NAN).unwrap_err(), ConfigurationError::ControlNotFinite);
}
