//! Many robots in one world.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Placed};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, Resident, World};
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Frame, Recipe, RobotInput, Script};
use motion_lab_sim::simulation::MIN_CLEARANCE;
use motion_lab_sim::tour::TourConfig;

use super::state::compare_ways;
use super::{event, quantized, script};
use crate::shrink::witness::assert_holds;

/// A walled square of this half-width with these robots: name, kind, start.
pub(crate) fn arena(half: f64, robots: &[(&str, &str, &[f64])]) -> World {
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Point2::new(x, y));
    let side = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        (Pose2::IDENTITY, Shape::Segment { a, b })
    };
    let wall = Obstacle::new("the wall", ObstacleKind::Wall, (0..4).map(side).collect());
    World {
        name: "the arena".into(),
        bounds: Aabb { min: corners[0], max: corners[2] },
        obstacles: vec![wall],
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots: robots.iter().map(|(name, kind, start)| Resident::new(*name, *kind, *start)).collect(),
    }
}

fn config(world: World, ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![world], ticks, sensor: None }
}

fn pose(frame: &Frame, robot: usize) -> Pose2 {
    let c = &frame.robots[robot].configuration;
    Pose2 { x: c[0], y: c[1], theta: c[2] }
}

/// Nine Rusties in a small arena and a script that keeps them bumping into one another.
fn bumper_cars(seed: u64, ticks: u64) -> (TourConfig, (Seed, Script)) {
    let names: Vec<String> = (0..9).map(|i| format!("Rusty {i}")).collect();
    let starts: Vec<[f64; 3]> =
        (0..9).map(|i| [f64::from(i % 3) * 0.4 - 0.4, f64::from(i / 3) * 0.4 - 0.4, f64::from(i)]).collect();
    let robots: Vec<_> = names.iter().zip(&starts).map(|(n, s)| (n.as_str(), "rusty", &s[..])).collect();
    let mut draws = Stream::new(Seed(seed), "bumper cars");
    let mut events = Vec::new();
    for tick in (1..=ticks).step_by(15) {
        for name in &names {
            let (v, w) = (draws.below(257) as i16 - 128, draws.below(129) as i16 - 64);
            events.push(event(tick, name, RobotInput::Drive(v, w)));
        }
    }
    (config(arena(0.8, &robots), ticks), (Seed(seed), script(events)))
}

#[test]
fn nobody_drives_through_anybody() {
    for seed in 0..3 {
        let (config, input) = bumper_cars(seed, 300);
        let scene = Scene::of_world(&config.worlds[0]);
        let log = Run::record(config, input).unwrap();
        let mut before = log.initial().unwrap();
        for frame in log.frames() {
            // each robot's arc at eleven places: the whole of one against the whole of the other, regardless of time
            let arcs: Vec<Vec<Placed>> = (0..9)
                .map(|i| {
                    let (from, to) = (pose(before, i), pose(frame, i));
                    let t = to.boxminus(&from);
                    let at = |s: f64| {
                        from.boxplus(&motion_lab_core::geometry::Tangent2::new(s * t.dx, s * t.dy, s * t.dtheta))
                    };
                    (0..=10).map(|k| RUSTY.footprint(&at(f64::from(k) / 10.0)).parts()[0].placed().clone()).collect()
                })
                .collect();
            for i in 0..9 {
                let end = RUSTY.footprint(&pose(frame, i));
                assert!(scene.distance(&end) >= MIN_CLEARANCE);
                for j in 0..i {
                    for a in &arcs[i] {
                        for b in &arcs[j] {
                            let gap = (a.core()[0] - b.core()[0]).norm() - 2.0 * RUSTY.body_radius;
                            assert!(gap >= MIN_CLEARANCE, "seed {seed} tick {}: {i} and {j} at {gap}", frame.tick);
                        }
                    }
                }
            }
            before = frame;
        }
        let last = log.frames().last().unwrap();
        assert!(last.robots.iter().filter(|r| r.contacts > 2).count() >= 6, "they do bump into one another");
        let moved = |i: usize| (pose(last, i).position() - pose(log.initial().unwrap(), i).position()).norm();
        assert!((0..9).filter(|&i| moved(i) > 0.1).count() >= 6, "and they do not get stuck");
    }
}

#[test]
fn a_crowd_s_run_replays_seeks_and_restores() {
    let (config, input) = bumper_cars(7, 150);
    assert_holds(&Recipe::new(config, input), compare_ways);
}

#[test]
fn two_that_drive_at_each_other_stop_nose_to_nose_and_part_again() {
    let robots: [(&str, &str, &[f64]); 2] =
        [("west", "rusty", &[-0.5, 0.0, 0.0]), ("east", "rusty", &[0.5, 0.0, std::f64::consts::PI])];
    let drive = |tick, v| ["west", "east"].map(|r| event(tick, r, RobotInput::Drive(v, 0)));
    let events = drive(1, 128).into_iter().chain(drive(60, -128)).collect();
    let log = Run::record(config(arena(2.0, &robots), 80), (Seed(1), script(events))).unwrap();
    let gap = |f: &Frame| (pose(f, 1).position() - pose(f, 0).position()).norm() - 2.0 * RUSTY.body_radius;
    assert!((1e-5..=1e-4).contains(&gap(&log.frames()[58])), "{}", gap(&log.frames()[58]));
    assert!(log.frames()[58].robots.iter().all(|r| r.in_contact && r.contacts >= 1));
    assert!(log.frames()[59].robots.iter().all(|r| !r.in_contact), "away is free at once");
    assert!(gap(&log.frames()[79]) > 0.5);
}

#[test]
fn an_arm_is_never_held_and_holds_what_it_lies_on() {
    let robots: [(&str, &str, &[f64]); 2] = [("arm", "reach", &[0.0, 0.0]), ("Rusty", "rusty", &[0.0, 1.0, 0.0])];
    let turn = |tick, th1: f64| event(tick, "arm", RobotInput::MoveTo(quantized(&[th1, 0.0])));
    let events = vec![
        event(1, "Rusty", RobotInput::Drive(0, 0)),
        turn(1, 0.5),
        turn(3, 1.57),
        event(5, "Rusty", RobotInput::Drive(128, 0)),
        turn(10, 3.0),
    ];
    let sensor = Some(RangeSensor { n_rays: 4, max_range: 9.0 });
    let config = TourConfig { sensor, ..config(arena(3.0, &robots), 20) };
    let log = Run::record(config, (Seed(1), script(events))).unwrap();
    let state = |tick: usize, robot: usize| &log.frames()[tick - 1].robots[robot];
    assert_eq!(state(2, 0).configuration[0], 0.5);
    assert!(!state(2, 0).in_contact);
    assert!((state(3, 0).configuration[0] - 1.57).abs() < 1e-6, "the arm goes where its input says");
    assert!(state(3, 0).in_contact && state(9, 0).in_contact);
    assert_eq!(state(9, 0).contacts, 1, "one episode, not one a tick");
    assert_eq!(state(4, 1).configuration, log.initial().unwrap().robots[1].configuration);
    assert!(state(9, 1).in_contact);
    assert_eq!(state(9, 1).configuration, log.initial().unwrap().robots[1].configuration, "pinned, though it drives");
    assert!(state(9, 1).extra[0] > state(5, 1).extra[0], "its wheels turn");
    assert_eq!(*log.frames()[8].scans[0].ranges, [0.0; 4], "its sensor sits inside the arm");
    assert!(log.frames()[19].scans[0].ranges.iter().all(|r| *r > RUSTY.body_radius));
    assert!(!state(20, 0).in_contact && !state(20, 1).in_contact);
    assert!(state(20, 1).configuration[0] > 0.2, "and when the arm has left it drives on");
}

#[test]
fn nobody_is_put_onto_anybody() {
    let robots: [(&str, &str, &[f64]); 2] = [("a", "rusty", &[0.0, 0.0, 0.0]), ("b", "rusty", &[1.0, 0.0, 0.0])];
    let to = |tick, robot, x: f64| event(tick, robot, RobotInput::Teleport(quantized(&[x, 0.0, 0.0])));
    // two bodies of radius 0.11 m need 0.22 m; within a tick the order of the script decides
    let events =
        vec![to(1, "a", 0.79), to(2, "a", 0.7), to(3, "a", 0.75), to(4, "b", 1.5), to(4, "a", 1.0), to(5, "b", 1.0)];
    let log = Run::record(config(arena(3.0, &robots), 5), (Seed(1), script(events))).unwrap();
    let state = |tick: usize, robot: usize| &log.frames()[tick - 1].robots[robot];
    assert_eq!((state(1, 0).configuration[0], state(1, 0).refusals), (0.0, 1));
    assert!((state(2, 0).configuration[0] - 0.7).abs() < 1e-6 && state(2, 0).refusals == 1);
    assert_eq!(state(3, 0).refusals, 1);
    assert_eq!((state(4, 0).configuration[0], state(4, 1).configuration[0]), (1.0, 1.5));
    assert_eq!((state(5, 1).configuration[0], state(5, 1).refusals), (1.5, 1));
}

#[test]
fn adding_a_robot_changes_nobody_else_s_numbers() {
    let one: [(&str, &str, &[f64]); 1] = [("Hitch", "hitch", &[-10.0, -10.0, 0.0])];
    let two: [(&str, &str, &[f64]); 2] =
        [("Hitch", "hitch", &[-10.0, -10.0, 0.0]), ("arm", "reach3", &[0.1, 0.2, 0.3])];
    let a = Run::record(config(arena(40.0, &one), 400), Seed(3)).unwrap();
    let b = Run::record(config(arena(40.0, &two), 400), Seed(3)).unwrap();
    assert!(a.frames().iter().zip(b.frames()).all(|(a, b)| a.robots[0] == b.robots[0]));
    assert_eq!(b.frames()[399].robots[1].configuration.len(), 3);
}

#[test]
fn a_sensor_sees_the_others_and_not_its_own_robot() {
    let robots: [(&str, &str, &[f64]); 2] = [("a", "rusty", &[0.0, 0.0, 0.0]), ("b", "rusty", &[0.0, 1.0, 0.0])];
    let mut config = config(arena(2.0, &robots), 1);
    config.sensor = Some(RangeSensor { n_rays: 4, max_range: 1.5 });
    let log = Run::record(config, Seed(1)).unwrap();
    let frame = log.initial().unwrap();
    let [a, b] = &frame.scans[..] else { panic!("two sensors") };
    assert_eq!((a.robot, b.robot), (0, 1));
    let near =
        |seen: &[f64], expected: [f64; 4]| seen.iter().zip(expected).all(|(s, e)| *s == e || (s - e).abs() < 1e-15);
    let nothing = f64::INFINITY;
    assert!(near(&a.ranges, [nothing, 1.0 - RUSTY.body_radius, nothing, nothing]), "{:?}", a.ranges);
    assert!(near(&b.ranges, [nothing, 1.0, nothing, 1.0 - RUSTY.body_radius]), "{:?}", b.ranges);
}

/// An arm that turns by 0.1 rad in a tick, beside it a rover, in this order of their ids. Returns whether the arm and
/// the rover are in contact after the tick, the arm's shoulder, and how far the rover has gone.
fn arm_and_rover(arm_first: bool, turn: f64, rover: [f64; 3], channels: [i16; 2]) -> (bool, bool, f64, f64) {
    let (arm, rover_of): ((_, _, &[f64]), (_, _, &[f64])) = (("arm", "reach", &[0.0, 0.0]), ("rover", "rusty", &rover));
    let world = arena(4.0, &if arm_first { [arm, rover_of] } else { [rover_of, arm] });
    let events = vec![
        event(1, "arm", RobotInput::MoveTo(quantized(&[turn, 0.0]))),
        event(1, "rover", RobotInput::Drive(channels[0], channels[1])),
    ];
    let log = Run::record(config(world, 1), (Seed(1), script(events))).unwrap();
    let [a, r] = if arm_first { [0, 1] } else { [1, 0] };
    let (robots, from) = (&log.frames()[0].robots, Point2::new(rover[0], rover[1]));
    (
        robots[a].in_contact,
        robots[r].in_contact,
        robots[a].configuration[0],
        (pose(&log.frames()[0], r).position() - from).norm(),
    )
}

/// The arm is 2 m long and 3 cm thick, the rover's radius is 11 cm, and it drives 3 cm a tick. At 1.9 m from the
/// shoulder the arm sweeps up to 19 cm.
#[test]
fn of_an_arm_and_a_rover_that_meet_the_one_with_the_higher_id_is_in_contact() {
    let down = -std::f64::consts::FRAC_PI_2;
    // down into what the arm sweeps; neither meets the other where that stood: 1.4 cm are left to the arm, 2.9 cm to
    // the rover
    for (arm_first, in_contact) in [(true, [false, true]), (false, [true, false])] {
        let (arm, rover, shoulder, gone) = arm_and_rover(arm_first, 0.1, [1.9, 0.345, down], [128, 0]);
        assert_eq!([arm, rover], in_contact, "arm first: {arm_first}");
        assert!((shoulder - 0.1).abs() < 1e-6, "an arm is never held");
        if rover { assert_eq!(gone, 0.0, "it stays") } else { assert!((gone - 0.03).abs() < 0.005, "{gone} m") }
    }
    // over a rover that stands: the arm is in contact whatever the ids; the rover if it is the later one
    for (arm_first, in_contact) in [(true, [true, true]), (false, [true, false])] {
        let (arm, rover, shoulder, gone) = arm_and_rover(arm_first, 0.1, [1.9, 0.2, down], [0, 0]);
        assert_eq!(([arm, rover], gone), (in_contact, 0.0), "arm first: {arm_first}");
        assert!((shoulder - 0.1).abs() < 1e-6);
    }
    // into an arm that stands: the rover is held at it whatever the ids, and the arm has no part in it
    for arm_first in [true, false] {
        let (arm, rover, shoulder, gone) = arm_and_rover(arm_first, 0.0, [1.9, 0.16, down], [128, 0]);
        assert_eq!(([arm, rover], shoulder), ([false, true], 0.0), "arm first: {arm_first}");
        assert!((0.0199..0.02).contains(&gone), "{gone} m of 2 cm");
    }
    // away from one another, and past one another at a centimetre
    for arm_first in [true, false] {
        for (y, channels) in [(0.345, [-128, 0]), (0.385, [128, 0])] {
            let (arm, rover, _, gone) = arm_and_rover(arm_first, 0.1, [1.9, y, down], channels);
            assert!(!arm && !rover && gone > 0.025, "{y} {channels:?}, arm first: {arm_first}");
        }
    }
}

/// Two arms by one another, both 1 m long in two links, and both free to go on.
#[test]
fn of_two_arms_that_meet_the_one_with_the_higher_id_is_in_contact_and_both_go_on() {
    use motion_lab_core::configuration::{ArmSizes, Sizes};
    let sizes = |x: f64| Sizes::Arm(ArmSizes { base: Point2::new(x, 0.0), lengths: vec![0.5, 0.5], radius: 0.03 });
    let resident = |name: &str, x: f64| Resident { sizes: Some(sizes(x)), ..Resident::new(name, "reach", [1.5, 0.0]) };
    // they stand side by side with 14 cm between them; a forearm that leans by 0.2 rad takes 10 cm, by 0.5 rad 24 cm
    for (order, leans, expected) in [
        (["left", "right"], [-0.2, 0.2], [false, true]),
        (["right", "left"], [-0.2, 0.2], [true, false]),
        (["left", "right"], [0.2, -0.2], [false, false]),
        (["left", "right"], [0.0, 0.5], [false, true]),
        (["right", "left"], [0.0, 0.5], [true, true]),
    ] {
        let mut world = arena(4.0, &[]);
        world.robots = order.iter().map(|name| resident(name, if *name == "left" { 0.0 } else { 0.2 })).collect();
        let lean = |name, by: f64| event(1, name, RobotInput::MoveTo(quantized(&[1.5, by])));
        let events = vec![lean("left", leans[0]), lean("right", leans[1])];
        let log = Run::record(config(world, 1), (Seed(1), script(events))).unwrap();
        let of = |name: &str| &log.frames()[0].robots[order.iter().position(|other| *other == name).unwrap()];
        assert_eq!(["left", "right"].map(|name| of(name).in_contact), expected, "{order:?} {leans:?}");
        for (name, by) in ["left", "right"].into_iter().zip(leans) {
            assert!((of(name).configuration[1] - by).abs() < 1e-6, "{name} goes where its input says");
        }
    }
}
