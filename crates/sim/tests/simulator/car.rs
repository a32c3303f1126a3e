//! The simulator's car and the certified arc of the same control are one motion.

use motion_lab_core::configuration::Configuration;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::TICK;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::RobotPlugin;
use motion_lab_sim::tour::TourConfig;

use oracle::car::time_to_fold;

use super::{event, quantized, script};
use crate::runs::controls::open;

/// The simulator's car and the arc of the same control, at every tick.
#[test]
fn what_the_simulator_does_is_the_arc() {
    const TICKS: u32 = 90;
    for (a, b) in [(128, 64), (-128, 30), (-90, -128), (64, 0)] {
        for start in [&[0.5, -0.25, 2.0][..], &[0.5, -0.25, 2.0, 1.2]] {
            let config = TourConfig {
                worlds: vec![open("open", &[("it", "hitch", start)])],
                ticks: u64::from(TICKS),
                sensor: None,
            };
            let log = Run::record(config, (Seed(1), script(vec![event(1, "it", RobotInput::Drive(a, b))]))).unwrap();
            let car = if start.len() > 3 { HITCH.with_trailer() } else { HITCH };
            let part = |channel: i16, most: f64| f64::from(channel) / 128.0 * most;
            let u = CarCmd { v: part(a, car.max_speed), phi: part(b, car.max_steer) };
            let arc = car.drive(&HitchCfg::from_coordinates(start).unwrap(), &u, f64::from(TICKS) * TICK).unwrap();
            for (tick, frame) in (1..).zip(log.frames()) {
                let at = arc.at(f64::from(tick) / f64::from(TICKS));
                assert_eq!(frame.robots[0].configuration, at.coordinates(), "tick {tick} of {u:?}");
            }
            assert_eq!(log.frames().len(), TICKS as usize);
        }
    }
}

/// A car backs up until its hitch holds it, then drives ahead.
#[test]
fn the_simulator_holds_a_car_at_its_hitch_and_lets_it_go_ahead() {
    let record = |jackknife: Option<f64>, events| {
        let world = open("open", &[("it", "x-limited", &[0.5, -0.25, 2.0, 2.25])]);
        let config = TourConfig { worlds: vec![world], ticks: 120, sensor: None };
        let model = Hitch { jackknife, ..HITCH };
        Run::record_with_robots(config, (Seed(1), script(events)), |app| {
            app.add_plugins(RobotPlugin::new("x-limited", model));
        })
        .unwrap()
    };
    let back_and_ahead =
        || vec![event(1, "it", RobotInput::Drive(-128, 0)), event(81, "it", RobotInput::Drive(128, 0))];
    let log = record(Some(1.25), back_and_ahead());
    let angle = |tick: usize| {
        let c = &log.frames()[tick - 1].robots[0].configuration;
        HitchCfg::from_coordinates(c).unwrap().hitch_angle().unwrap()
    };
    // from 0.25 rad at 1.5 m/s, two metres of bar
    let met = (time_to_fold(0.25, 1.25, 1.5, 2.0) / TICK).ceil() as usize;
    assert!(met > 20 && met < 70, "the limit is met in tick {met}");
    for tick in 1..=120 {
        let robot = &log.frames()[tick - 1].robots[0];
        assert!(angle(tick) <= 1.25, "tick {tick}: {} to the last bit", angle(tick));
        assert_eq!(robot.in_contact, (met..=80).contains(&tick), "tick {tick} at {}", angle(tick));
        assert_eq!(robot.contacts, u32::from(tick >= met), "tick {tick}");
        if (met..=80).contains(&tick) {
            assert!(1.25 - angle(tick) < 1e-12, "tick {tick}: held at {}", angle(tick));
        }
    }
    assert!(angle(120) < 0.4 && angle(81) < angle(80), "ahead it unfolds: {}", angle(120));
    // without a limit the run is another, and nothing holds it
    let free = record(None, back_and_ahead());
    assert_eq!(free.frames()[met - 2], log.frames()[met - 2], "the same up to the limit");
    assert!(free.frames().iter().all(|f| !f.robots[0].in_contact));
    // a place beyond the limit is refused, one within is taken
    let put = |psi: f64| {
        let place = quantized(&[0.0, 0.0, 0.0, psi]);
        record(Some(1.25), vec![event(1, "it", RobotInput::Teleport(place))]).frames()[0].robots[0].clone()
    };
    assert_eq!((put(1.5).refusals, put(1.0).refusals), (1, 0));
}
