//! Robots towed on an empty plane, tick by tick, by their own commands.

use std::f64::consts::PI;

use super::{Tow, TowCommand, TowState, grip_at};
use motion_lab_core::configuration::{AnyConfiguration, HitchCfg};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::{greater, hypot, ln, wrap};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{
    AnyRobot, CHANNEL_UNITS, CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, RustyCmd, TICK, WheelSlip,
};

/// The trace of a tow: the configuration before each tick and the command for it.
type Trace<Q> = Vec<(Q, TowCommand)>;

fn car_towed(car: &Hitch, mut q: HitchCfg, tow: &Tow, ticks: usize) -> Trace<HitchCfg> {
    let part = |channel: i16| f64::from(channel) / CHANNEL_UNITS;
    let mut trace = Vec::new();
    for _ in 0..ticks {
        let command = tow.command(&AnyRobot::Hitch(*car), &AnyConfiguration::Hitch(q)).unwrap();
        trace.push((q, command));
        let [ahead, left] = command.channels;
        q = car.step(&q, &CarCmd { v: part(ahead) * car.max_speed, phi: part(left) * car.max_steer }, TICK).unwrap();
    }
    trace
}

/// A rover whose wheels slip as in a run.
fn rover_towed(mut q: Pose2, tow: &Tow, ticks: usize, draws: &mut Stream) -> Trace<Pose2> {
    let part = |channel: i16| f64::from(channel) / CHANNEL_UNITS;
    let mut trace = Vec::new();
    for _ in 0..ticks {
        let command = tow.command(&AnyRobot::Rusty(RUSTY), &AnyConfiguration::Pose(q)).unwrap();
        trace.push((q, command));
        let [ahead, left] = command.channels.map(part);
        let u = RustyCmd { v: ahead * RUSTY.max_speed, omega: left * RUSTY.max_turn_rate };
        let mut factor = || 1.0 + RUSTY.max_slip * draws.uniform(-1.0, 1.0);
        let slip = WheelSlip { left: factor(), right: factor() };
        let u = RUSTY.command_of(&RUSTY.wheel_turns(&u, TICK), &slip, TICK);
        q = RUSTY.drive(&q, &u, TICK).unwrap().at(1.0);
    }
    trace
}

fn car_at(x: f64, y: f64, theta: f64) -> HitchCfg {
    HitchCfg { body: Pose2::new(x, y, theta), trailer: None }
}

fn folded(theta: f64, fold: f64) -> HitchCfg {
    HitchCfg { body: Pose2::new(0.0, 0.0, theta), trailer: Some(theta + fold) }
}

/// The seconds until a tow's robot rests for good; panics where it does not.
fn seconds_to_rest<Q: std::fmt::Debug>(trace: &Trace<Q>) -> f64 {
    let moving = trace.iter().rposition(|(_, command)| command.state != TowState::Rests).map_or(0, |last| last + 1);
    assert!(moving < trace.len(), "it does not rest: {:?}", trace.last());
    assert!(trace[moving..].iter().all(|(_, command)| command.channels == [0, 0]));
    moving as f64 * TICK
}

/// How often a trace changes between ahead and back.
fn reversals<Q>(trace: &Trace<Q>) -> usize {
    let ways: Vec<i16> =
        trace.iter().map(|(_, command)| command.channels[0].signum()).filter(|way| *way != 0).collect();
    ways.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Where a point of a robot's axis is.
fn on_axis(pose: &Pose2, ahead: f64) -> Point2 {
    pose.transform(Point2::new(ahead, 0.0))
}

#[test]
fn no_command_is_beyond_the_limits_whatever_the_state_and_the_aim() {
    let mut draws = Stream::new(Seed(21), "tow");
    let (mut going, mut standing) = (0, 0);
    for i in 0..20_000_u32 {
        let far = [1.0, 10.0, 1e6, 1e300][(i % 4) as usize];
        let mut place = || Point2::new(draws.uniform(-far, far), draws.uniform(-far, far));
        let (at, aim) = (place(), place());
        let (theta, psi) = (draws.uniform(-PI, PI), draws.uniform(-PI, PI));
        let pose = Pose2::new(at.x, at.y, theta);
        let car = AnyRobot::Hitch(HITCH.with_trailer());
        let (robot, q) = match i % 3 {
            0 => (AnyRobot::Rusty(RUSTY), AnyConfiguration::Pose(pose)),
            1 => (car, AnyConfiguration::Hitch(HitchCfg { body: pose, trailer: None })),
            _ => (car, AnyConfiguration::Hitch(HitchCfg { body: pose, trailer: Some(psi) })),
        };
        let grip = draws.uniform(-0.7, 3.2);
        let held = [0.0, TICK, 1.0, 1e9][(i / 3 % 4) as usize];
        let TowCommand { channels, state } = Tow { grip, aim, held }.command(&robot, &q).unwrap();
        assert!(channels.iter().all(|c| c.abs() <= 128), "{channels:?} of {q:?} to {aim}");
        match state {
            TowState::Goes => going += 1,
            _ => {
                assert_eq!(channels[0], 0, "{state:?}");
                standing += 1;
            }
        }
    }
    assert!(going > 5_000 && standing > 500, "{going} {standing}");
}

#[test]
fn an_arm_is_not_towed_and_what_is_no_number_pulls_nothing() {
    let (arm, q) = AnyRobot::of_kind("reach", &[0.0, 0.0]).unwrap();
    assert_eq!(grip_at(&arm, &q, Point2::origin()), None);
    assert_eq!(Tow::new(0.0, Point2::new(1.0, 0.0)).command(&arm, &q), None);
    let (rover, q) = AnyRobot::of_kind("rusty", &[0.0; 3]).unwrap();
    for aim in [Point2::new(f64::NAN, 0.0), Point2::new(f64::INFINITY, 0.0)] {
        assert_eq!(Tow::new(0.0, aim).command(&rover, &q).unwrap().channels, [0, 0]);
    }
    assert_eq!(grip_at(&rover, &q, Point2::new(f64::NAN, 0.0)), None);
}

#[test]
fn a_body_is_gripped_on_its_axis_as_far_as_it_reaches() {
    let (car, q) = AnyRobot::of_kind("hitch", &[1.0, 2.0, 0.5 * PI]).unwrap();
    // it faces up: the chassis reaches from 0.7 m below the axle to 3.2 m above it
    for (y, grip) in [(2.0, 0.0), (4.5, 2.5), (9.0, 3.2), (-9.0, -0.7)] {
        let found = grip_at(&car, &q, Point2::new(1.6, y)).unwrap();
        assert!((found - grip).abs() < 1e-12, "{found} at {y}");
    }
    let (rover, q) = AnyRobot::of_kind("rusty", &[0.0; 3]).unwrap();
    let grips = [-1.0, -0.02, 0.05, 1.0].map(|x| grip_at(&rover, &q, Point2::new(x, 0.04)).unwrap());
    assert_eq!(grips, [-0.11, 0.0, 0.05, 0.11], "a little behind the centre is the centre");
}

/// Metres off from which on a tow goes at full speed, and the seconds of a way: at full speed until there, then ever
/// slower, `off' = -gain * off`.
fn seconds_of(way: f64, full: f64, gain: f64, arrival: f64) -> f64 {
    let slow = full / gain;
    (way - slow) / full + ln(slow / arrival) / gain
}

#[test]
fn a_car_goes_straight_ahead_and_straight_back_and_rests_there() {
    for (aim, grip) in [(6.0, 0.0), (6.0, 2.5), (-6.0, 0.0), (-4.0, 3.0), (1.0, 3.0)] {
        let trace = car_towed(&HITCH, car_at(0.0, 0.0, 0.0), &Tow::new(grip, Point2::new(aim, 0.0)), 300);
        let (end, _) = trace.last().unwrap();
        assert!((on_axis(&end.body, grip).x - aim).abs() <= 0.05 && end.body.y == 0.0, "{end:?} to {aim}");
        let by_hand = seconds_of((aim - grip).abs(), HITCH.max_speed, 1.2, 0.05);
        assert!((seconds_to_rest(&trace) - by_hand).abs() < 0.2, "{} {by_hand}", seconds_to_rest(&trace));
        assert_eq!(reversals(&trace), 0);
    }
}

#[test]
fn a_car_comes_by_one_arc_to_what_it_can_turn_to() {
    // of a circle of radius 5 m about (0, 5): a quarter round, ahead and back, to either side
    for (x, y) in [(5.0, 5.0), (5.0, -5.0), (-5.0, 5.0), (-5.0, -5.0)] {
        let trace = car_towed(&HITCH, car_at(0.0, 0.0, 0.0), &Tow::new(0.0, Point2::new(x, y)), 400);
        let (end, _) = trace.last().unwrap();
        assert!(hypot(end.body.x - x, end.body.y - y) <= 0.05, "{end:?}");
        let off_circle = trace.iter().map(|(q, _)| hypot(q.body.x, q.body.y - y) - 5.0);
        assert!(off_circle.into_iter().all(|off| off.abs() < 0.05), "it follows the circle");
        let by_hand = seconds_of(0.5 * PI * 5.0, HITCH.max_speed, 1.2, 0.05);
        assert!((seconds_to_rest(&trace) - by_hand).abs() < 0.3, "{} {by_hand}", seconds_to_rest(&trace));
        assert_eq!(reversals(&trace), 0);
    }
}

#[test]
fn no_towed_car_slips_sideways() {
    let mut draws = Stream::new(Seed(5), "tow");
    for _ in 0..200 {
        let tow = Tow::new(draws.uniform(-0.7, 3.2), Point2::new(draws.uniform(-9.0, 9.0), draws.uniform(-9.0, 9.0)));
        let trace = car_towed(&HITCH, car_at(0.0, 0.0, draws.uniform(-3.0, 3.0)), &tow, 200);
        for pair in trace.windows(2) {
            let (from, to) = (pair[0].0.body, pair[1].0.body);
            // the chord of an arc points along the mean of the headings at its ends
            let middle = Pose2 { theta: from.theta + 0.5 * wrap(to.theta - from.theta), ..from };
            let sideways = middle.inverse().transform(to.position()).y;
            assert!(sideways.abs() < 1e-12, "{sideways}");
        }
    }
}

#[test]
fn within_its_turning_circle_a_car_only_steers_to_what_is_abeam() {
    // sharply to the left the grip runs on a circle about (0, radius), which is abeam of the grip at two radii
    let far = 2.0 * HITCH.tightest();
    for (y, state) in [
        (0.2, TowState::OnlySteers),
        (1.0, TowState::OnlySteers),
        (0.9 * far, TowState::OnlySteers),
        (1.01 * far, TowState::Goes),
        (3.0 * far, TowState::Goes),
    ] {
        for (grip, side) in [(0.0, 1.0), (1.25, 1.0), (3.2, 1.0), (-0.7, -1.0), (1.25, -1.0)] {
            let tow = Tow::new(grip, Point2::new(grip, side * y));
            let (_, command) = car_towed(&HITCH, car_at(0.0, 0.0, 0.0), &tow, 1)[0];
            assert_eq!(command.state, state, "{grip} {y}");
            if state == TowState::OnlySteers {
                assert_eq!(command.channels, [0, 128 * side as i16], "it steers to that side");
            }
        }
    }
}

#[test]
fn a_car_gripped_at_its_front_brings_its_front_there() {
    let aim = Point2::new(6.0, 2.0);
    let trace = car_towed(&HITCH, car_at(0.0, 0.0, 0.0), &Tow::new(3.2, aim), 400);
    let (end, _) = trace.last().unwrap();
    assert!((on_axis(&end.body, 3.2) - aim).norm() <= 0.05, "{end:?}");
    assert!((end.body.position() - aim).norm() > 3.0, "its axle is not there");
}

#[test]
fn a_trailer_is_backed_straight_and_does_not_jackknife() {
    let car = HITCH.with_trailer();
    for fold in [0.0, 0.2, -0.4, 0.5] {
        let trace = car_towed(&car, folded(0.0, fold), &Tow::new(1.25, Point2::new(-12.0, 0.0)), 600);
        let most = trace.iter().fold(0.0, |most, (q, _)| greater(most, q.hitch_angle().unwrap().abs()));
        assert!(most <= fold.abs() + 0.05 || most < 0.45, "from {fold} it folds to {most}");
        let (end, command) = trace.last().unwrap();
        assert!(end.body.x < -11.0, "{fold}: {end:?} {command:?}");
        // off the line by a little at last, it draws ahead to it
        assert!(reversals(&trace) <= 1, "{fold}");
    }
    // folded farther than sharp steering can open, it stands, and ahead it unfolds
    let stands = car_towed(&car, folded(0.0, 0.8), &Tow::new(0.0, Point2::new(-5.0, 0.0)), 1)[0].1;
    assert_eq!((stands.channels, stands.state), ([0, 0], TowState::Folded));
    let ahead = car_towed(&car, folded(0.0, 0.8), &Tow::new(0.0, Point2::new(8.0, 0.0)), 300);
    assert!(ahead.last().unwrap().0.hitch_angle().unwrap() < 0.05);
}

#[test]
fn whatever_the_aim_a_towed_car_comes_to_rest_and_its_trailer_stays_within_its_limit() {
    let mut draws = Stream::new(Seed(8), "tow");
    let (mut arrived, mut steering) = (0, 0);
    for i in 0..600_u32 {
        let limit = [0.4, 0.9, 3.0][(i % 3) as usize];
        let car = if i % 2 == 0 { HITCH } else { HITCH.with_trailer().with_jackknife(limit) };
        let fold = draws.uniform(-0.3, 0.3);
        let start = if i % 2 == 0 { car_at(0.0, 0.0, 0.3) } else { folded(0.3, fold) };
        let aim = Point2::new(draws.uniform(-10.0, 10.0), draws.uniform(-10.0, 10.0));
        let tow = Tow::new(draws.uniform(-0.7, 3.2), aim);
        let trace = car_towed(&car, start, &tow, 1200);
        let (end, command) = trace.last().unwrap();
        arrived += u32::from(command.state == TowState::Rests);
        steering += u32::from(command.state == TowState::OnlySteers);
        assert_eq!(command.channels[0], 0, "{i}: {end:?} to {tow:?}");
        assert!(reversals(&trace) <= 1, "{i}: {} times from {start:?} by {tow:?}", reversals(&trace));
        let folds = trace.iter().filter_map(|(q, _)| q.hitch_angle());
        assert!(folds.into_iter().all(|fold| fold.abs() <= limit), "{i}");
    }
    assert!(arrived > 300 && steering > 200, "{arrived} {steering}");
}

#[test]
fn a_rover_turns_to_the_aim_and_rests_there() {
    let mut draws = Stream::new(Seed(3), "slip");
    for (x, y) in [(2.0, 0.0), (-2.0, 0.0), (0.0, 2.0), (1.2, -1.6)] {
        let trace = rover_towed(Pose2::IDENTITY, &Tow::new(0.0, Point2::new(x, y)), 300, &mut draws);
        let (end, _) = trace.last().unwrap();
        assert!(hypot(end.x - x, end.y - y) <= 0.02, "{end:?}");
        // half a turn at 2.5 rad/s, slower at its end, and then the way
        let most = PI / 2.5 + 1.0 + seconds_of(2.0, RUSTY.max_speed, 2.0, 0.02);
        assert!(seconds_to_rest(&trace) < most, "{} {most}", seconds_to_rest(&trace));
        assert_eq!(reversals(&trace), 0);
    }
}

#[test]
fn wherever_it_is_gripped_and_pulled_a_rover_comes_to_rest_there() {
    let mut draws = Stream::new(Seed(4), "slip");
    for i in 0..600_u32 {
        let far = [0.15, 1.0, 4.0][(i % 3) as usize];
        let aim = Point2::new(draws.uniform(-far, far), draws.uniform(-far, far));
        let grip = draws.uniform(-0.11, 0.11);
        let theta = draws.uniform(-PI, PI);
        let trace = rover_towed(Pose2::new(0.0, 0.0, theta), &Tow::new(grip, aim), 600, &mut draws);
        let (end, _) = trace.last().unwrap();
        assert!(seconds_to_rest(&trace) < 20.0 && (on_axis(end, grip) - aim).norm() <= 0.02, "{i}: {end:?}");
        assert!(reversals(&trace) <= 1, "{i}");
    }
}

#[test]
fn a_command_that_is_held_for_long_does_not_pass_the_aim() {
    for ticks in [4, 20, 60] {
        let held = f64::from(ticks) * TICK;
        let tow = Tow { grip: 0.0, aim: Point2::new(6.0, 1.0), held };
        let (mut q, car) = (car_at(0.0, 0.0, 0.0), HITCH);
        for _ in 0..40 {
            let [ahead, left] = tow.command(&AnyRobot::Hitch(car), &AnyConfiguration::Hitch(q)).unwrap().channels;
            let part = |channel: i16| f64::from(channel) / CHANNEL_UNITS;
            let u = CarCmd { v: part(ahead) * car.max_speed, phi: part(left) * car.max_steer };
            q = car.step(&q, &u, held).unwrap();
            assert!(q.body.x < 6.05, "{ticks}: {q:?}");
        }
        assert!(hypot(q.body.x - 6.0, q.body.y - 1.0) < 0.1, "{ticks}: {q:?}");
    }
}
