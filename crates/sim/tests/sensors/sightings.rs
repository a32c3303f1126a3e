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

/// A walled square with a column in it and these robots.
fn world(name: &str, robots: &str) -> World {
    let text = format!(
        "World(version: 1, name: \"{name}\", bounds: (min: (-7, -7), max: (7, 7)),
         walls: [(name: \"the wall\", points: [(-7, -7), (7, -7), (7, 7), (-7, 7)], closed: true)],
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
    [world("west", west), world("east", east)]
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
