//! The trailer over minutes of driving, against the solution of its differential equation.
//!
//! The equation is f' = v k - (v / d) sin f, with the fold f = theta - psi, the speed v, the path's curvature k and the
//! bar's length d. In u = tan(f / 2) it is u' = (v k / 2)(u - a)(u - b), where a < b are the roots of the polynomial
//! u^2 - 2 u / (k d) + 1 for k > 0. So (u - a) / (u - b) falls as exp(-v t sqrt(1 - k^2 d^2) / d), and on a straight
//! line u itself falls as exp(-v t / d). Ahead the trailer settles at sin f = k d; in reverse it moves away from there.

use std::f64::consts::{FRAC_PI_2, PI};

use motion_lab_core::num::{acos, atan2, cos, exp, sin, sqrt, tan, wrap};
use motion_lab_core::prelude::*;

/// The length of a tick, seconds.
const TICK: f64 = 0.05;

/// The fold after `t` seconds from `start`, at the speed `v`, the curvature `k` and the bar's length `d`.
fn fold(start: f64, v: f64, k: f64, d: f64, t: f64) -> f64 {
    let u = tan(0.5 * start);
    if k == 0.0 {
        return 2.0 * atan2(u * exp(-v * t / d), 1.0);
    }
    let root = sqrt(1.0 - k * k * d * d);
    let (a, b) = ((1.0 - root) / (k * d), (1.0 + root) / (k * d));
    let w = (u - a) / (u - b) * exp(-v * t * root / d);
    2.0 * atan2(a - w * b, 1.0 - w)
}

/// Drives the lab's car and trailer for `ticks` ticks from this fold, and checks every one against the solution.
/// Returns the last fold.
#[track_caller]
fn follow(start: f64, u: CarCmd, ticks: u32) -> f64 {
    let car = HITCH.with_trailer();
    let (d, k) = (car.hitch_len.unwrap(), tan(u.phi) / car.wheelbase);
    // a heading of 2 rad: the trailer and the car pass pi at different times
    let mut q = HitchCfg { body: Pose2::new(0.5, -0.25, 2.0), trailer: Some(wrap(2.0 - start)) };
    let mut last = start;
    for tick in 1..=ticks {
        q = car.step(&q, &u, TICK).unwrap();
        let (theta, psi) = (q.body.theta, q.trailer.unwrap());
        let t = TICK * f64::from(tick);
        assert!(psi > -PI && psi <= PI && theta > -PI && theta <= PI, "{q} at {t} s of {u:?}");
        assert!(wrap(theta - 2.0 - u.v * k * t).abs() < 1e-11, "{q} at {t} s of {u:?}");
        let solution = fold(start, u.v, k, d, t);
        last = wrap(theta - psi);
        // the Runge-Kutta error, with four steps per tick of at most 9 mm for each metre of the bar
        assert!(wrap(last - solution).abs() < 2e-9, "fold {last}, not {solution}, {t} s after {start} with {u:?}");
    }
    last
}

/// Two minutes.
const LONG: u32 = 2400;

#[test]
fn on_a_straight_line_the_fold_dies_away_exponentially() {
    for start in [3.0, -2.5, 1.0, -FRAC_PI_2, 1e-3] {
        for v in [1.5, 0.4] {
            let last = follow(start, CarCmd { v, phi: 0.0 }, LONG);
            assert!(v < 1.0 || last.abs() < 1e-12, "{last} is left of {start}");
        }
    }
    assert_eq!(follow(0.0, CarCmd { v: 1.5, phi: 0.0 }, LONG), 0.0, "straight behind it stays so");
}

#[test]
fn in_a_steady_turn_the_trailer_comes_to_rest_at_its_angle_whatever_it_was_before() {
    let car = HITCH.with_trailer();
    for phi in [0.6, -0.6, 0.3, -0.05] {
        // the sine of the fold at which the trailer's axle runs on a circle about the same centre
        let sine = car.hitch_len.unwrap() * tan(phi) / car.wheelbase;
        for start in [-1.0, 0.0, 2.5, 3.1] {
            follow(start, CarCmd { v: 0.4, phi }, LONG);
            let last = follow(start, CarCmd { v: 1.5, phi }, LONG);
            assert!((last - (FRAC_PI_2 - acos(sine))).abs() < 1e-12, "{last} with {phi}");
        }
    }
}

#[test]
fn in_reverse_the_fold_grows_to_its_own_side_until_the_trailer_is_ahead() {
    for start in [1e-4, -1e-4, 1e-3, -0.3] {
        let last = follow(start, CarCmd { v: -1.5, phi: 0.0 }, 200);
        assert!(last * start > 0.0 && last.abs() > 10.0 * start.abs(), "{last} after {start}");
    }
    // steered to the left in reverse the car turns to the right and the trailer to the left
    for phi in [0.6, -0.6, 0.2] {
        let last = follow(0.0, CarCmd { v: -1.5, phi }, 40);
        let car = -1.5 * 2.0 * tan(phi) / HITCH.wheelbase;
        assert!(car * phi < 0.0 && last * phi < 0.0 && (car - last) * phi > 0.0, "{last} with {phi}");
        follow(0.0, CarCmd { v: -1.5, phi }, 100);
    }
}

#[test]
fn where_the_trailer_rests_its_axle_runs_on_a_circle_about_the_car_s_centre() {
    let car = HITCH.with_trailer();
    let (d, k) = (car.hitch_len.unwrap(), tan(0.5) / car.wheelbase);
    let at_rest = FRAC_PI_2 - acos(k * d);
    let body = Pose2::new(0.5, -0.25, 2.0);
    let mut q = HitchCfg { body, trailer: Some(wrap(2.0 - at_rest)) };
    // the centre lies to the left of the rear axle, at right angles to the axle's motion: Pythagoras
    let centre = Point2::new(body.x - sin(2.0) / k, body.y + cos(2.0) / k);
    let radius = sqrt(1.0 / (k * k) - d * d);
    for tick in 0..LONG {
        let axle = car.trailer_axle(&q).unwrap();
        let out = axle.position() - centre;
        assert!((out.norm() - radius).abs() < 1e-9, "{} m at tick {tick}", out.norm());
        let along = Vector2::new(cos(axle.theta), sin(axle.theta));
        assert!(out.dot(&along).abs() < 1e-9, "it slides sideways at tick {tick}");
        q = car.step(&q, &CarCmd { v: 1.5, phi: 0.5 }, TICK).unwrap();
    }
}
