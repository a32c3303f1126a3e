//! The other robots in the scans of a run, tick by tick. Their outlines come from the kinematics written out. A sensor
//! sees the robots of its own world alone, and not its own robot.

use std::f64::consts::TAU;

use motion_lab_core::num::{cos, sin};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Quantized, RobotInput, RobotState, Script};
use motion_lab_sim::tour::TourConfig;

use oracle::seen::{Seen, Tally, cast, check, things_of};

/// A walled square of this half side with a column in it and these robots.
fn world(name: &str, half: f64, robots: &str) -> World {
    let text = format!(
        "World(version: 1, name: \"{name}\", bounds: (min: (-{half}, -{half}), max: ({half}, {half})),
         walls: [(name: \"the wall\", closed: true,
                  points: [(-{half}, -{half}), ({half}, -{half}), ({half}, {half}), (-{half}, {half})])],
         obstacles: [(name: \"the column\", shape: Rounded(points: [(-5, 4), (-4, 4.5), (-4.5, 5)], radius: 0.3))],
         robots: [{robots}])"
    );
    World::parse("sightings.ron", &text).unwrap()
}

/// Two worlds. The first two robots of the east stand where the west's sensors look, and see nothing of the west.
fn worlds() -> [World; 2] {
    let west = "(name: \"Anna\", kind: \"rusty\", start: [-3, 0.5, 0.3]), (name: \"Bert\", kind: \"hitch\", start: [2, -4, 0.2, 0.5]),
                (name: \"Cleo\", kind: \"reach\", start: [0.5, 0.8]), (name: \"Dora\", kind: \"rusty\", start: [-2, -1, 2]),
                (name: \"Emil\", kind: \"reach3\", start: [2, -1, 1])";
    let east = "(name: \"Finn\", kind: \"rusty\", start: [-2.5, 0.6, 0]), (name: \"Gina\", kind: \"hitch\", start: [-2, -3, 1.5]),
                (name: \"Hugo\", kind: \"rusty\", start: [5, 5, -2])";
    [world("west", 7.0, west), world("east", 7.0, east)]
}

/// The outlines of a robot of this kind, by its dimensions and the textbook's kinematics.
fn outlines(kind: &str, state: &RobotState) -> Vec<Seen> {
    let q = &state.configuration;
    let p = Point2::new;
    let rectangle = |heading: f64, back: f64, front: f64, half: f64| {
        let (c, s) = (cos(heading), sin(heading));
        let corners = [(back, -half), (front, -half), (front, half), (back, half)];
        Seen::Outline(corners.iter().map(|(u, v)| p(q[0] + c * u - s * v, q[1] + s * u + c * v)).collect())
    };
    let links = |lengths: &[f64]| {
        let (mut at, mut heading, mut links) = (Point2::origin(), 0.0, Vec::new());
        for (length, turn) in lengths.iter().zip(q.iter()) {
            heading += turn;
            let end = p(at.x + length * cos(heading), at.y + length * sin(heading));
            links.push(Seen::Round(vec![at, end], 0.03));
            at = end;
        }
        links
    };
    match (kind, q.len()) {
        ("rusty", _) => vec![Seen::Round(vec![p(q[0], q[1])], 0.11)],
        ("reach", _) => links(&[1.0, 1.0]),
        ("reach3", _) => links(&[0.6, 0.5, 0.4]),
        (_, 3) => vec![rectangle(q[2], -0.7, 3.2, 0.85)],
        // the trailer's axle is 2 m behind the hitch, its box reaches 1 m ahead of that and 0.8 m behind
        _ => vec![rectangle(q[2], -0.7, 3.2, 0.85), rectangle(q[3], -2.8, -1.0, 0.75)],
    }
}

#[test]
fn a_sensor_sees_the_robots_of_its_own_world_where_they_are_after_the_tick_and_no_others() {
    let angle = |x: f64| Quantized::try_new(x).unwrap();
    let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
    let events = vec![
        event(1, "Anna", RobotInput::Drive(60, 50)),
        event(1, "Bert", RobotInput::Drive(90, 60)),
        event(1, "Dora", RobotInput::Drive(0, 90)),
        event(1, "Finn", RobotInput::Drive(30, -40)),
        event(1, "Gina", RobotInput::Drive(-40, 20)),
        event(1, "Hugo", RobotInput::Drive(100, 9)),
        event(10, "Cleo", RobotInput::MoveTo(vec![angle(-2.0), angle(0.5)])),
        event(20, "Bert", RobotInput::SetTrailer(false)),
        event(25, "Gina", RobotInput::SetTrailer(true)),
    ];
    let worlds = worlds();
    let sensor = Some(RangeSensor { n_rays: 72, max_range: 12.0 });
    let config = TourConfig { worlds: worlds.to_vec(), ticks: 40, sensor };
    let log = Run::record(config, (Seed(21), Script { events, ..Script::empty() })).unwrap();
    let residents: Vec<(usize, &str)> = worlds
        .iter()
        .enumerate()
        .flat_map(|(w, world)| world.robots.iter().map(move |r| (w, r.kind.as_str())))
        .collect();
    let mut tally = Tally::default();
    let mut robots_seen = 0;
    for frame in std::iter::once(log.initial().unwrap()).chain(log.frames()) {
        let sensors: Vec<u32> = frame.scans.iter().map(|scan| scan.robot).collect();
        assert_eq!(sensors, [0, 3, 5, 7], "the four rovers have one each");
        for scan in &frame.scans {
            let own = scan.robot as usize;
            let (home, _) = residents[own];
            let mut things = things_of(&worlds[home]);
            let standing = things.len();
            for (i, (state, (world, kind))) in frame.robots.iter().zip(&residents).enumerate() {
                if i != own && *world == home {
                    things.extend(outlines(kind, state));
                }
            }
            let q = &frame.robots[own].configuration;
            let pose = Pose2 { x: q[0], y: q[1], theta: q[2] };
            check(&things, 12.0, &pose, &scan.ranges, &mut tally);
            // a range nearer than the world's obstacles is a robot
            let bearing = |k: usize| pose.theta + TAU * k as f64 / 72.0;
            let nearer =
                |(k, range): &(usize, &f64)| cast(&things[..standing], pose.position(), bearing(*k)) > **range + 0.1;
            robots_seen += scan.ranges.iter().enumerate().filter(nearer).count();
        }
    }
    assert!(
        tally.hits > 9_000 && tally.grazed < 12 && robots_seen > 500,
        "{robots_seen} rays end at a robot: {tally:?}"
    );
}

/// A crowd about a rover with a sensor of 2 m and a car with one of 1.5 m before its front: robots that come and go at
/// the ends of their ranges, seen with all their parts.
#[test]
fn in_a_crowd_a_sensor_sees_to_the_end_of_its_range_whatever_part_of_a_robot_is_there() {
    let mut robots = String::from("(name: \"watch\", kind: \"rusty\", start: [-3, 0, 0.7])");
    robots += ", (name: \"car\", kind: \"hitch\", start: [1, 2, 0.3], sensors: [(name: \"nose\", rays: 90, range: 1.5, \
               mount: (x: 3.5, y: 0.25, theta: 1))])";
    let mut events = vec![];
    let mut drive = |tick: u64, robot: String, a: i16, b: i16| {
        events.push(Event { tick, robot, input: RobotInput::Drive(a, b) });
    };
    drive(1, "watch".into(), 0, 64);
    drive(1, "car".into(), 0, 0);
    // rovers about the watch, whose near sides are 2 m away, give or take 6 cm; they drive out and in again
    for k in 0..60_i16 {
        let (bearing, away) = (TAU * f64::from(k) / 60.0, 2.11 + 0.06 * (f64::from(k % 7) - 3.0) / 3.0);
        let (x, y) = (-3.0 + away * cos(bearing), away * sin(bearing));
        robots += &format!(", (name: \"r{k}\", kind: \"rusty\", start: [{x}, {y}, {bearing}])");
        for (tick, sign) in [(1, 1), (7, -1), (19, 1)] {
            drive(tick, format!("r{k}"), sign * (40 + k), 0);
        }
    }
    // and trailers whose cars are far off: only their ends come near the car's nose
    let (nose, ahead) =
        (Point2::new(1.0 + 3.5 * cos(0.3) - 0.25 * sin(0.3), 2.0 + 3.5 * sin(0.3) + 0.25 * cos(0.3)), 1.5);
    for (k, bearing) in [0.2, 2.0].into_iter().enumerate() {
        let far = ahead + 2.8;
        let (x, y) = (nose.x + far * cos(bearing), nose.y + far * sin(bearing));
        robots += &format!(", (name: \"t{k}\", kind: \"hitch\", start: [{x}, {y}, {bearing}, {bearing}])");
        for (tick, speed) in [(1, -20), (10, 40), (20, -50)] {
            drive(tick, format!("t{k}"), speed, 0);
        }
    }
    events.sort_by_key(|event| event.tick);
    let sensor = Some(RangeSensor { n_rays: 360, max_range: 2.0 });
    let world = world("crowd", 16.0, &robots);
    let config = TourConfig { worlds: vec![world.clone()], ticks: 30, sensor };
    let log = Run::record(config, (Seed(22), Script { events, ..Script::empty() })).unwrap();
    let (mut tally, mut near_the_end, mut by_nose) = (Tally::default(), 0, 0);
    for frame in std::iter::once(log.initial().unwrap()).chain(log.frames()) {
        let of_robots = |own: usize| {
            let others = frame.robots.iter().zip(&world.robots).enumerate().filter(move |(i, _)| *i != own);
            let outlines = others.flat_map(|(_, (state, resident))| outlines(&resident.kind, state));
            things_of(&world).into_iter().chain(outlines).collect::<Vec<Seen>>()
        };
        for scan in frame.scans.iter().filter(|scan| scan.robot < 2) {
            let q = &frame.robots[scan.robot as usize].configuration;
            let own = Pose2 { x: q[0], y: q[1], theta: q[2] };
            let (pose, range) = if scan.robot == 0 {
                (own, 2.0)
            } else {
                let (c, s) = (cos(own.theta), sin(own.theta));
                let (x, y) = (own.x + 3.5 * c - 0.25 * s, own.y + 3.5 * s + 0.25 * c);
                (Pose2 { x, y, theta: own.theta + 1.0 }, 1.5)
            };
            check(&of_robots(scan.robot as usize), range, &pose, &scan.ranges, &mut tally);
            let late = scan.ranges.iter().filter(|r| r.is_finite() && **r > 0.985 * range).count();
            if scan.robot == 0 { near_the_end += late } else { by_nose += late }
        }
    }
    assert!(
        near_the_end > 300 && by_nose > 20,
        "{near_the_end} rays end at the end of their range, {by_nose} of the car's"
    );
}
