//! The effect of each control channel and each joint, by the equations of motion written out.

use std::f64::consts::FRAC_PI_2;

use bevy::app::App;
use motion_lab_core::num::{cos, sin, tan, wrap};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{EncoderCounts, WheelTurns};
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::RobotPlugin;
use motion_lab_sim::tour::TourConfig;

use crate::simulator::{event, quantized, script};
use oracle::fixtures::PLANE;

/// A world of a hundred metres without an obstacle, with these robots: name, kind, start.
pub fn open(name: &str, robots: &[(&str, &str, &[f64])]) -> World {
    World {
        name: name.into(),
        bounds: PLANE,
        obstacles: vec![],
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots: robots.iter().map(|(name, kind, start)| Resident::new(*name, *kind, *start)).collect(),
    }
}

/// The common start: off the origin, with a heading that confuses neither signs nor axes.
const START: [f64; 3] = [0.5, -0.25, 2.0];

/// Every sign of both channels, full scale and less.
const CHANNELS: [(i16, i16); 12] = [
    (128, 0),
    (-128, 0),
    (0, 128),
    (0, -128),
    (128, 128),
    (128, -128),
    (-128, 128),
    (-128, -128),
    (64, 32),
    (96, -1),
    (-1, 127),
    (-127, -64),
];

/// The pose of a body that goes ahead at `v` and turns at `omega` for `t` seconds: on a circle of radius v / omega, or
/// straight on.
pub fn driven([x, y, theta]: [f64; 3], v: f64, omega: f64, t: f64) -> [f64; 3] {
    let end = theta + omega * t;
    if omega == 0.0 {
        return [x + v * t * cos(theta), y + v * t * sin(theta), end];
    }
    let radius = v / omega;
    [x + radius * (sin(end) - sin(theta)), y - radius * (cos(end) - cos(theta)), end]
}

#[track_caller]
fn assert_near(found: &[f64], expected: [f64; 3], what: &str) {
    let off = [found[0] - expected[0], found[1] - expected[1], wrap(found[2] - expected[2])];
    assert!(off.iter().all(|d| d.abs() < 1e-11), "{what}: {found:?}, not {expected:?}");
}

/// How far a pose lies ahead of the start and to its left, in the start's frame.
fn ahead_and_left(pose: &[f64]) -> (f64, f64) {
    let (dx, dy) = (pose[0] - START[0], pose[1] - START[1]);
    let (s, c) = (sin(START[2]), cos(START[2]));
    (c * dx + s * dy, c * dy - s * dx)
}

/// The poses that `kind` has at ticks 1 to `ticks` while it holds these channels from the start on.
fn poses(kind: &str, (a, b): (i16, i16), ticks: u64, add: impl FnOnce(&mut App)) -> Vec<Vec<f64>> {
    let config = TourConfig { worlds: vec![open("open", &[("it", kind, &START)])], ticks, sensor: None };
    let input = script(vec![event(1, "it", RobotInput::Drive(a, b))]);
    let log = Run::record_with_robots(config, (Seed(1), input), add).unwrap();
    log.frames().iter().map(|f| f.robots[0].configuration.to_vec()).collect()
}

#[test]
fn rusty_s_channels_are_speed_ahead_and_turn_to_the_left_in_parts_of_the_maximum() {
    // wheels without slip draw no random numbers
    let add = |app: &mut App| {
        app.add_plugins(RobotPlugin::new("x-exact", Rusty { max_slip: 0.0, ..RUSTY }));
    };
    for (a, b) in CHANNELS {
        let (v, omega) = (f64::from(a) / 128.0 * RUSTY.max_speed, f64::from(b) / 128.0 * RUSTY.max_turn_rate);
        let run = poses("x-exact", (a, b), 30, add);
        for (i, pose) in run.iter().enumerate() {
            assert_near(pose, driven(START, v, omega, 0.05 * (i + 1) as f64), &format!("Drive({a}, {b})"));
        }
        // slip leaves the signs as they are: it is at most a twentieth of what a wheel rolls
        let slipping = &poses("rusty", (a, b), 1, |_| {})[0];
        let (way, turn) = (ahead_and_left(slipping).0, wrap(slipping[2] - START[2]));
        let most = 0.05 * RUSTY.max_slip * (v.abs() + 0.5 * RUSTY.track * omega.abs());
        assert!((way - 0.05 * v).abs() <= most + 1e-3 * v.abs(), "Drive({a}, {b}): {way} ahead");
        assert!((turn - 0.05 * omega).abs() <= 2.0 * most / RUSTY.track + 1e-12, "Drive({a}, {b}): turned {turn}");
    }
}

#[test]
fn the_encoders_count_each_wheel_forward_positive_and_round_down() {
    // a counter-clockwise turn is the right wheel's: v -+ omega track / 2 is 0.1 and 0.5 m/s, 60.77 and 303.84 counts
    // in 7 ticks
    let counts = [
        ((64, 128), (60, 303)),
        ((64, -128), (303, 60)),
        ((-64, -128), (-61, -304)),
        ((-64, 128), (-304, -61)),
        ((0, 0), (0, 0)),
    ];
    for ((a, b), (left, right)) in counts {
        let config = TourConfig { worlds: vec![open("open", &[("it", "rusty", &START)])], ticks: 7, sensor: None };
        let input = script(vec![event(1, "it", RobotInput::Drive(a, b))]);
        let mut run = Recorder::new(config, input).unwrap();
        run.seek(7).unwrap();
        let view = &run.view()[0];
        assert_eq!(view.encoders, Some(EncoderCounts { left, right }), "Drive({a}, {b})");
        // what is drawn of the wheels: each has rolled its own way to a count, and the middle of both the odometer's
        let rolled = |side: f64| 0.35 * (0.3 * f64::from(a) / 64.0 + side * 0.08 * 2.5 * f64::from(b) / 128.0) / 0.033;
        let (gait, count) = (view.gait(), std::f64::consts::TAU / 360.0);
        for (drawn, expected) in gait.rolled.into_iter().zip([rolled(-1.0), rolled(1.0)]) {
            assert!((drawn - expected).abs() <= count + 1e-9, "Drive({a}, {b}): {drawn} rad for {expected}");
        }
        let middle = 0.5 * (gait.rolled[0] + gait.rolled[1]) * 0.033;
        assert!((middle - view.odometer.unwrap()).abs() < 1e-12, "Drive({a}, {b}): {middle} m");
    }
    assert_eq!(RUSTY.counts(&WheelTurns { left: -1e-9, right: 1e-9 }), EncoderCounts { left: -1, right: 0 });
}

#[test]
fn a_command_beyond_the_limits_is_the_limit_on_its_own_side() {
    let (v, omega) = (RUSTY.max_speed, RUSTY.max_turn_rate);
    for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let limited = RUSTY.limited(&RustyCmd { v: 9.0 * a, omega: 9.0 * b });
        assert_eq!(limited, RustyCmd { v: a * v, omega: b * omega });
        let turns = RUSTY.wheel_turns(&RustyCmd { v: 9.0 * a, omega: 9.0 * b }, 0.05);
        let rolled = |side: f64| 0.05 * (a * v + side * 0.5 * RUSTY.track * b * omega) / RUSTY.wheel_radius;
        assert!((turns.left - rolled(-1.0)).abs() < 1e-12 && (turns.right - rolled(1.0)).abs() < 1e-12, "{turns:?}");

        let q = HitchCfg { body: Pose2::new(START[0], START[1], START[2]), trailer: None };
        let end = HITCH.step(&q, &CarCmd { v: a, phi: 2.0 * b }, 2.0).unwrap().body;
        let curvature = b * tan(HITCH.max_steer) / HITCH.wheelbase;
        assert_near(&[end.x, end.y, end.theta], driven(START, a, a * curvature, 2.0), "over-steered");
    }
}

#[test]
fn hitch_s_channels_are_speed_ahead_and_steering_to_the_left_forward_and_in_reverse() {
    for (a, b) in CHANNELS {
        let (v, phi) = (f64::from(a) / 128.0 * HITCH.max_speed, f64::from(b) / 128.0 * HITCH.max_steer);
        let omega = v * tan(phi) / HITCH.wheelbase;
        let run = poses("hitch", (a, b), 40, |_| {});
        for (i, pose) in run.iter().enumerate() {
            assert_near(pose, driven(START, v, omega, 0.05 * (i + 1) as f64), &format!("Drive({a}, {b})"));
        }
        // in words: its speed decides ahead or back, its steering the side, and it turns to that side only when it goes
        // ahead
        let last = &run[39];
        let (ahead, left) = ahead_and_left(last);
        let (turn, at_rest) = (wrap(last[2] - START[2]), a == 0);
        let same = |x: f64, sign: i16| if sign == 0 || at_rest { x.abs() < 1e-12 } else { x * f64::from(sign) > 0.0 };
        assert!(same(ahead, a) && same(left, b) && same(turn, a.signum() * b.signum()), "Drive({a}, {b}): {last:?}");
    }
}

#[test]
fn an_arm_s_joints_turn_counter_clockwise_each_from_the_link_before() {
    // the links lie along the axes, so the tip can be read off
    let (q, o) = (FRAC_PI_2, 0.0);
    let cases: [(&str, &[f64], [f64; 2]); 8] = [
        ("reach", &[q, o], [0.0, 2.0]),
        ("reach", &[q, q], [-1.0, 1.0]),
        ("reach", &[q, -q], [1.0, 1.0]),
        ("reach", &[-q, q], [1.0, -1.0]),
        ("reach3", &[q, o, o], [0.0, 1.5]),
        ("reach3", &[q, -q, -q], [0.5, 0.2]),
        ("reach3", &[-q, -q, q], [-0.5, -1.0]),
        ("reach3", &[o, q, q], [0.2, 0.5]),
    ];
    for (kind, target, tip) in cases {
        let start = vec![0.3; target.len()];
        let config = TourConfig { worlds: vec![open("open", &[("it", kind, &start[..])])], ticks: 3, sensor: None };
        for input in [RobotInput::MoveTo(quantized(target)), RobotInput::Teleport(quantized(target))] {
            let input = script(vec![event(2, "it", input)]);
            let mut run = Recorder::new(config.clone(), input).unwrap();
            run.seek(3).unwrap();
            let found = run.view()[0].tip.unwrap();
            // each angle was rounded to 2^-20
            assert!((found - Point2::from(tip)).norm() < 3e-6, "{kind} {target:?}: {found}");
        }
    }
}
