//! Manual driving by script: taking over, holding, refusals, and giving back.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::prelude::*;
use motion_lab_core::worlds::World;
use motion_lab_sim::recording::{Recorder, Run, RunError};
use motion_lab_sim::run::{Event, Frame, RobotInput};
use motion_lab_sim::simulation::{FLASH_TICKS, MIN_CLEARANCE};
use motion_lab_sim::tour::TourConfig;

use super::crowd::arena;
use super::{event, quantized, script, tour, wild_script};

fn frames(config: TourConfig, events: Vec<Event>) -> Vec<Frame> {
    let log = Run::record(config, (Seed(2005), script(events))).unwrap();
    assert_eq!(Run::replay(&log).unwrap(), log.frames());
    log.initial().into_iter().chain(log.frames()).cloned().collect()
}

fn one(kind: &str, start: &[f64], ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![arena(5.0, &[("it", kind, start)])], ticks, sensor: None }
}

#[test]
fn an_input_applies_before_the_step_of_its_tick() {
    let frames = frames(one("rusty", &[0.0; 3], 6), vec![event(4, "it", RobotInput::Drive(128, 0))]);
    let x = |k: usize| frames[k].robots[0].configuration[0];
    assert_eq!((x(0), x(3)), (0.0, 0.0));
    let step = RUSTY.max_speed * 0.05;
    assert!((x(4) - step).abs() <= step * RUSTY.max_slip);
    assert!(!frames[3].robots[0].manual && frames[4].robots[0].manual);
    assert_eq!(frames[4].robots[0].channels, [128, 0]);
}

#[test]
fn rusty_is_held_a_body_radius_from_the_wall_while_its_wheels_turn() {
    let events = vec![event(1, "it", RobotInput::Drive(128, 0)), event(200, "it", RobotInput::Drive(-128, 0))];
    let frames = frames(one("rusty", &[3.0, 0.0, 0.0], 210), events);
    let scene = Scene::of_world(&arena(5.0, &[]));
    let q = |k: usize| Pose2::new(frames[k].robots[0].configuration[0], frames[k].robots[0].configuration[1], 0.0);
    let held = &frames[199].robots[0];
    let clearance = scene.distance(&RUSTY.footprint(&q(199)));
    assert!((1e-5..=1e-4).contains(&clearance), "{clearance}");
    assert!(held.in_contact && held.flash == FLASH_TICKS);
    let turned = |k: usize| frames[k].robots[0].extra[0];
    let per_tick = RUSTY.max_speed * 0.05 / RUSTY.wheel_radius;
    assert!((turned(199) - turned(150) - 49.0 * per_tick).abs() < 1e-9, "wheels turn while it is held");
    assert!(!frames[200].robots[0].in_contact && q(200).x < q(199).x - 0.02, "backing off is free at once");
    let flashes: Vec<u32> = frames[199..=207].iter().map(|f| f.robots[0].flash).collect();
    assert_eq!(flashes, [6, 5, 4, 3, 2, 1, 0, 0, 0]);
}

#[test]
fn an_episode_is_counted_once_at_its_first_tick() {
    let forth = |tick| event(tick, "it", RobotInput::Drive(128, 0));
    let back = |tick| event(tick, "it", RobotInput::Drive(-128, 0));
    let frames = frames(one("rusty", &[4.8, 0.0, 0.0], 60), vec![forth(1), back(20), forth(30), back(50)]);
    let mut episodes = 0;
    for pair in frames.windows(2) {
        episodes += u32::from(pair[1].robots[0].in_contact && !pair[0].robots[0].in_contact);
        assert_eq!(pair[1].robots[0].contacts, episodes);
    }
    assert_eq!(episodes, 2);
}

#[test]
fn a_car_is_held_with_its_trailer_and_leaves_again() {
    for trailer in [false, true] {
        let start: &[f64] = if trailer { &[0.0, 0.0, 0.5, 0.5] } else { &[0.0, 0.0, 0.5] };
        let events = vec![event(1, "it", RobotInput::Drive(-128, 40)), event(200, "it", RobotInput::Drive(128, 40))];
        let frames = frames(one("hitch", start, 204), events);
        let scene = Scene::of_world(&arena(5.0, &[]));
        let car = if trailer { HITCH.with_trailer() } else { HITCH };
        let clearance = |k: usize| {
            let q = HitchCfg::from_coordinates(&frames[k].robots[0].configuration).unwrap();
            scene.distance(&car.footprint(&q))
        };
        assert!(frames[199].robots[0].in_contact && (1e-5..=1e-4).contains(&clearance(199)), "{}", clearance(199));
        assert!(frames.iter().enumerate().all(|(k, _)| clearance(k) >= 1e-5));
        assert!(!frames[200].robots[0].in_contact && clearance(204) > 1e-2);
    }
}

#[test]
fn a_teleport_is_refused_where_it_would_touch_and_changes_nothing_but_the_count() {
    let to = |tick, x: f64| event(tick, "it", RobotInput::Teleport(quantized(&[x, 0.0, 0.25])));
    // 5 - 4.75 = 0.25 is a free place. Touching at 4.89 exactly is impossible on the grid of 2^-20, so a place just
    // beyond is tried, and a place outside
    let frames = frames(one("rusty", &[0.0; 3], 9), vec![to(1, 4.75), to(3, 4.9), to(5, 5.0), to(7, -4.75)]);
    let state = |k: usize| &frames[k].robots[0];
    assert_eq!((state(1).configuration[0], state(1).configuration[2]), (4.75, 0.25));
    assert_eq!((state(3).configuration[0], state(3).refusals), (4.75, 1));
    assert_eq!((state(5).configuration[0], state(5).refusals), (4.75, 2));
    assert_eq!((state(7).configuration[0], state(7).refusals), (-4.75, 2));
}

#[test]
fn touching_exactly_is_refused() {
    // an arm of two unit links, straight: its capsules reach x = 2.03, here exactly the wall of an arena of that size
    let world = arena(2.03, &[("it", "reach", &[1.0, 2.0])]);
    let config = |world| TourConfig { worlds: vec![world], ticks: 1, sensor: None };
    let straight = || vec![event(1, "it", RobotInput::Teleport(quantized(&[0.0, 0.0])))];
    assert_eq!(frames(config(world), straight())[1].robots[0].refusals, 1);
    let wider = arena(2.030_001, &[("it", "reach", &[1.0, 2.0])]);
    assert_eq!(frames(config(wider), straight())[1].robots[0].refusals, 0);
}

#[test]
fn the_trailer_goes_on_straight_behind_or_is_refused() {
    let trailer = |tick, on| event(tick, "it", RobotInput::SetTrailer(on));
    let frames1 =
        frames(one("hitch", &[1.0, 0.0, 0.5], 6), vec![trailer(1, true), trailer(3, true), trailer(5, false)]);
    let psi = |k: usize| frames1[k].robots[0].configuration.get(3).copied();
    assert_eq!((psi(0), psi(1), psi(3), psi(5)), (None, Some(0.5), Some(0.5), None));
    assert_eq!(frames1[6].robots[0].refusals, 0);
    // its back 1 m from the wall: no room for a trailer that reaches 2.8 m behind the axle
    let tight = frames(one("hitch", &[-3.3, 0.0, 0.0], 3), vec![trailer(2, true)]);
    assert_eq!((tight[2].robots[0].configuration.len(), tight[2].robots[0].refusals), (3, 1));
    assert!(!tight[2].robots[0].manual, "a refused input does not take over");
    let rusty = frames(one("rusty", &[0.0; 3], 2), vec![trailer(1, true)]);
    assert_eq!((rusty[1].robots[0].refusals, rusty[1].robots[0].manual), (1, false));
}

#[test]
fn inputs_that_mean_nothing_to_a_robot_are_refused() {
    let arm = frames(
        one("reach", &[0.0, 1.0], 3),
        vec![
            event(1, "it", RobotInput::Drive(10, 10)),
            event(2, "it", RobotInput::MoveTo(quantized(&[1.0]))),
            event(3, "it", RobotInput::Teleport(quantized(&[1.0, 2.0, 3.0]))),
        ],
    );
    assert_eq!((arm[3].robots[0].refusals, arm[3].robots[0].manual), (3, false));
    let rusty =
        frames(one("rusty", &[0.0; 3], 1), vec![event(1, "it", RobotInput::MoveTo(quantized(&[1.0, 0.0, 0.0])))]);
    assert_eq!(rusty[1].robots[0].refusals, 1);
}

#[test]
fn an_arm_goes_where_its_input_says_by_the_end_of_the_tick_and_stays() {
    let frames =
        frames(one("reach", &[0.0, 1.0], 5), vec![event(2, "it", RobotInput::MoveTo(quantized(&[3.5, -0.5])))]);
    let q = |k: usize| (frames[k].robots[0].configuration[0], frames[k].robots[0].configuration[1]);
    assert_eq!(q(2), (motion_lab_core::num::wrap(3.5), -0.5));
    assert_eq!(q(5), q(2));
    assert!(frames[2].robots[0].target.is_empty(), "it is there");
}

#[test]
fn release_gives_the_robot_back_to_its_tour() {
    let events = vec![
        event(1, "Rusty", RobotInput::Teleport(quantized(&[6.0, 4.0, 1.0]))),
        event(1, "Reach", RobotInput::MoveTo(quantized(&[-2.0, 0.5]))),
        event(1, "Hitch", RobotInput::Drive(0, 0)),
        event(20, "Rusty", RobotInput::Release),
        event(20, "Reach", RobotInput::Release),
        event(20, "Hitch", RobotInput::Release),
    ];
    let config = tour(1000);
    let driven = Run::record(config.clone(), (Seed(1), script(events))).unwrap();
    let toured = Run::record(config, Seed(1)).unwrap();
    let state = |log: &motion_lab_sim::run::Log, k: usize, r: usize| log.frames()[k - 1].robots[r].clone();
    assert_eq!(state(&driven, 19, 0).configuration[0], 6.0);
    assert!(driven.frames()[19].robots.iter().all(|r| !r.manual));
    // Rusty was left in the corridor, between the two doors, and finds its loop again without touching anything
    assert_eq!(state(&driven, 1000, 0).contacts, 0);
    let waypoints: Vec<f64> = driven.frames()[19..].iter().map(|f| f.robots[0].extra[2]).collect();
    assert!(waypoints.windows(2).filter(|w| w[1] < w[0]).count() >= 1, "it completes a loop");
    // Reach turns back at bounded speed, and is then exactly where the tour is
    for k in 20..200 {
        for (a, b) in state(&driven, k, 1).configuration.iter().zip(&state(&driven, k - 1, 1).configuration) {
            assert!(motion_lab_core::num::wrap(a - b).abs() <= motion_lab_sim::tour::MAX_JOINT_SPEED * 0.05 + 1e-12);
        }
    }
    assert_eq!(state(&driven, 200, 1).configuration, state(&toured, 200, 1).configuration);
    assert_ne!(state(&driven, 20, 1).configuration, state(&toured, 20, 1).configuration);
    assert_ne!(state(&driven, 40, 2).configuration, state(&driven, 20, 2).configuration);
}

#[test]
fn held_robots_never_come_nearer_than_the_least_clearance_whatever_is_driven() {
    let scenes = [World::apartment(), World::lot()].map(|w| Scene::of_world(&w));
    for seed in 20..26 {
        let script = wild_script(seed, 400);
        let mut run = Recorder::new(tour(400), (Seed(seed), script.clone())).unwrap();
        let mut last = [f64::INFINITY; 3];
        while !run.is_complete() {
            let tick = run.step().tick;
            for v in run.view() {
                let scene = match v.kind.as_str() {
                    "rusty" => &scenes[0],
                    "hitch" => &scenes[1],
                    _ => continue,
                };
                let clearance = scene.distance(&v.footprint);
                // only a teleport or a trailer put on may bring a robot nearer than driving does; from there on it
                // loses a rounding at most
                let puts = |e: &Event| {
                    let puts = matches!(e.input, RobotInput::Teleport(_) | RobotInput::SetTrailer(_));
                    puts && e.tick == tick && e.robot == v.name
                };
                let kept = std::mem::replace(&mut last[v.id as usize], clearance) - 1e-9;
                let least = if kept < MIN_CLEARANCE { kept } else { MIN_CLEARANCE };
                let near = clearance > 0.0 && (clearance >= least || script.events.iter().any(puts));
                assert!(near, "seed {seed}, tick {tick}: {clearance} m at {}", v.configuration_in_full);
            }
        }
    }
}

#[test]
fn a_script_that_cannot_be_run_is_refused_by_name() {
    let refused = |events| match Run::record(tour(5), script(events)) {
        Err(RunError::Spawn(e)) => e.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(refused(vec![event(1, "Dusty", RobotInput::Release)]).contains("Dusty"));
    assert!(refused(vec![event(0, "Rusty", RobotInput::Release)]).contains("tick 0"));
    assert!(refused(vec![event(1, "Rusty", RobotInput::Drive(129, 0))]).contains("129"));
    let unknown = TourConfig { worlds: vec![], ..tour(5) };
    assert!(Run::record(unknown, Seed(1)).is_err());
}
