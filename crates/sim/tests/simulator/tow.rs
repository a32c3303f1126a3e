//! Robots towed in whole runs: each tick's command is an input like a driver's, and the log is one like any other.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{Frame, Log, RobotInput};
use motion_lab_sim::simulation::MIN_CLEARANCE;
use motion_lab_sim::tour::TourConfig;
use motion_lab_sim::tow::Tow;

use super::crowd::arena;

/// A run in an arena of 5 m to each side, in which the robot `it` is towed to each point for its number of ticks.
fn towed(kind: &str, start: &[f64], aims: &[(Point2, u64)]) -> Log {
    let ticks = aims.iter().map(|(_, ticks)| ticks).sum();
    let config = TourConfig { worlds: vec![arena(5.0, &[("it", kind, start)])], ticks, sensor: None };
    let mut recorder = Recorder::new(config, Seed(2005)).unwrap();
    for &(aim, ticks) in aims {
        for _ in 0..ticks {
            let now = &recorder.view()[0];
            let (robot, q) = (now.model.unwrap(), AnyRobot::of_kind(kind, &now.coordinates).unwrap().1);
            let [ahead, left] = Tow::new(0.0, aim).command(&robot, &q).unwrap().channels;
            recorder.input("it", RobotInput::Drive(ahead, left)).unwrap();
            recorder.step();
        }
    }
    recorder.log().unwrap()
}

fn frames(log: &Log) -> Vec<&Frame> {
    log.initial().into_iter().chain(log.frames()).collect()
}

/// The distance of a robot of a frame from the arena's wall.
fn clearance(kind: &str, frame: &Frame) -> f64 {
    let (robot, q) = AnyRobot::of_kind(kind, &frame.robots[0].configuration).unwrap();
    Scene::of_world(&arena(5.0, &[])).distance(&robot.footprint(&q))
}

#[test]
fn a_tow_into_a_wall_is_held_and_stays_held_and_a_tow_away_is_free() {
    for (kind, start) in
        [("rusty", &[2.0, 0.0, 0.0][..]), ("hitch", &[-1.0, 0.0, 0.0]), ("hitch", &[-1.0, 0.0, 0.0, 0.0])]
    {
        let log = towed(kind, start, &[(Point2::new(9.0, 0.0), 200), (Point2::new(-9.0, 0.0), 10)]);
        let frames = frames(&log);
        let first = frames.iter().position(|frame| frame.robots[0].in_contact).expect("it comes to the wall");
        for (tick, frame) in (0..).zip(&frames).take(201) {
            let robot = &frame.robots[0];
            assert_eq!((robot.in_contact, robot.contacts), (tick >= first, u32::from(tick >= first)), "{kind} {tick}");
            assert!(clearance(kind, frame) >= MIN_CLEARANCE, "{kind} {tick}");
            assert!(tick <= first || robot.configuration == frames[first].robots[0].configuration, "{kind} {tick}");
        }
        assert!(frames[200].robots[0].channels[0] > 0, "it is still pulled");
        assert!(clearance(kind, frames[200]) <= 1e-4);
        let last = &frames[210].robots[0];
        assert_eq!((last.in_contact, last.contacts), (false, 1), "{kind}");
    }
}

#[test]
fn a_towed_robot_arrives_and_holds_channels_of_0() {
    for (kind, near) in [("rusty", 0.02), ("hitch", 0.05)] {
        let aim = Point2::new(2.0, 1.0);
        let log = towed(kind, &[-3.0, -1.0, 0.0], &[(aim, 400)]);
        let frames = frames(&log);
        let last = &frames[400].robots[0];
        let off = Point2::new(last.configuration[0], last.configuration[1]) - aim;
        assert!(off.norm() <= near && last.channels == [0, 0], "{kind}: {off} {:?}", last.channels);
        assert_eq!(last.configuration, frames[380].robots[0].configuration, "{kind} stands");
    }
}

#[test]
fn a_towed_run_is_made_again_from_its_script_bit_for_bit() {
    let aims = [(3.0, 1.0), (-3.0, 2.0), (0.0, -4.0)].map(|(x, y)| (Point2::new(x, y), 90));
    for (kind, start) in [("rusty", &[0.0; 3][..]), ("hitch", &[0.0; 3]), ("hitch", &[0.0; 4])] {
        let log = towed(kind, start, &aims);
        let recipe = &log.recipe;
        assert!(recipe.script.events.iter().all(|event| matches!(event.input, RobotInput::Drive(..))));
        assert!(recipe.script.events.len() > 20, "{}", recipe.script.events.len());
        assert_eq!(verify(&log, |_| {}).unwrap().identical, 270);
        let again = Run::record((*recipe.config).clone(), (recipe.seed, recipe.script.clone())).unwrap();
        assert_eq!(again.digest(), log.digest(), "{kind}");
    }
}

#[test]
fn a_car_towed_sideways_in_a_run_does_not_slip() {
    let log = towed("hitch", &[0.0, 0.0, 0.5], &[(Point2::new(-3.0, 4.0), 60), (Point2::new(4.0, 0.5), 60)]);
    let poses: Vec<Pose2> = frames(&log)
        .iter()
        .map(|frame| HitchCfg::from_coordinates(&frame.robots[0].configuration).unwrap().body)
        .collect();
    let mut way = 0.0;
    for pair in poses.windows(2) {
        // the chord of an arc points along the mean of the headings at its ends
        let turn = motion_lab_core::num::wrap(pair[1].theta - pair[0].theta);
        let chord = Pose2 { theta: pair[0].theta + 0.5 * turn, ..pair[0] }.inverse().transform(pair[1].position());
        assert!(chord.y.abs() < 1e-12, "{}", chord.y);
        way += chord.x.abs();
    }
    assert!(way > 1.5, "{way}");
}
