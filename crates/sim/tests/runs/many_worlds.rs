//! Several worlds in one run: things at the same coordinates of another world neither block nor are seen.

use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Event, Frame, RobotInput, RobotState};
use motion_lab_sim::tour::TourConfig;

use crate::runs::controls::open;
use crate::simulator::{event, quantized, script};

/// The distance a car covers in a tick at full speed, metres: 1.5 m/s for 0.05 s.
const FULL: f64 = 0.075;

fn drive(tick: u64, robot: &str, speed: i16) -> Event {
    event(tick, robot, RobotInput::Drive(speed, 0))
}

/// Three worlds whose cars drive through one another's coordinates: one goes east from the origin, one comes from the
/// east, and one goes east alone in its world. Two worlds have a rover each at the same place to the south.
fn crossing() -> [World; 3] {
    let south: &[f64] = &[0.0, -20.0, 0.0];
    [
        open("one", &[("east", "hitch", &[0.0; 3]), ("eye", "rusty", south)]),
        open("two", &[("west", "hitch", &[12.0, 0.0, std::f64::consts::PI]), ("other eye", "rusty", south)]),
        open("three", &[("alone", "hitch", &[0.0; 3])]),
    ]
}

/// The state of the robot of this name in a run of these worlds, and its scan.
fn of<'a>(frame: &'a Frame, worlds: &[World], name: &str) -> (&'a RobotState, &'a [f64]) {
    let id = worlds.iter().flat_map(|w| &w.robots).position(|r| r.name == name).unwrap();
    let scan = frame.scans.iter().find(|s| s.robot as usize == id).map_or(&[][..], |s| &s.ranges[..]);
    (&frame.robots[id], scan)
}

#[test]
fn who_is_at_the_same_place_of_another_world_is_not_in_the_way_and_not_seen() {
    let put = |robot| event(161, robot, RobotInput::Teleport(quantized(&[0.0; 3])));
    let events =
        vec![drive(1, "east", 128), drive(1, "west", 128), drive(1, "alone", 128), put("eye"), put("other eye")];
    // whichever has the lower id
    for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2]] {
        let worlds = order.map(|i| crossing()[i].clone());
        let sensor = Some(RangeSensor { n_rays: 4, max_range: 30.0 });
        let config = TourConfig { worlds: worlds.to_vec(), ticks: 161, sensor };
        let log = Run::record(config, (Seed(1), script(events.clone()))).unwrap();
        let near = |found: f64, expected: f64| found == expected || (found - expected).abs() < 1e-11;
        for frame in std::iter::once(log.initial().unwrap()).chain(log.frames()) {
            let gone = frame.tick as f64 * FULL;
            for (name, x) in [("east", gone), ("west", 12.0 - gone), ("alone", gone)] {
                let (car, _) = of(frame, &worlds, name);
                assert!(near(car.configuration[0], x), "{name} is at {:?}, not {x}", car.configuration);
                assert!(!car.in_contact && car.contacts == 0, "{name} touches somebody at tick {}", frame.tick);
            }
            // the origin is straight north of the rovers' place, and the side of a car there is half its width nearer.
            // A car reaches from 0.7 m behind its rear axle to 3.2 m ahead of it
            let above = |x: f64, heading: f64| (-3.2..0.7).contains(&(heading * x));
            for (name, x, heading) in [("eye", gone, 1.0), ("other eye", 12.0 - gone, -1.0)] {
                let (_, scan) = of(frame, &worlds, name);
                let north = if above(x, heading) { 20.0 - 0.85 } else { f64::INFINITY };
                if frame.tick < 161 {
                    let rest = scan[0].is_infinite() && scan[2].is_infinite() && scan[3].is_infinite();
                    assert!(near(scan[1], north) && rest, "{name} sees {scan:?} at tick {}, not {north}", frame.tick);
                }
            }
        }
        // at the end the car from the east stands over the origin in its own world only
        let last = log.frames().last().unwrap();
        let ((eye, seen), (other, _)) = (of(last, &worlds, "eye"), of(last, &worlds, "other eye"));
        assert_eq!((&eye.configuration[..], eye.refusals), (&[0.0; 3][..], 0));
        assert_eq!((&other.configuration[..], other.refusals), (&[0.0, -20.0, 0.0][..], 1));
        assert!(near(seen[0], 161.0 * FULL - 0.7) && seen[1..].iter().all(|r| r.is_infinite()), "{seen:?}");
    }
}

#[test]
fn robots_and_scans_come_in_the_order_of_worlds_and_lists_and_each_is_called_by_its_name() {
    let names = |i: usize| (0..4).map(|k| format!("{i}{k}")).collect::<Vec<_>>();
    // rovers and arms in turn; east of every rover is a disc at a distance of its own
    let place = |i: usize, k: usize| [10.0 + 4.0 * i as f64, 10.0 * k as f64, 0.0];
    let world = |i: usize| {
        let names = names(i);
        let starts: Vec<[f64; 3]> = (0..4).map(|k| place(i, k)).collect();
        let kind = |k: usize| if k % 2 == i % 2 { "rusty" } else { "reach3" };
        let robots: Vec<_> = (0..4).map(|k| (names[k].as_str(), kind(k), &starts[k][..])).collect();
        let disc = |k: usize| {
            let [x, y, _] = place(i, k);
            (Pose2::new(x + 2.0 + (i + k) as f64, y, 0.0), Shape::Disc { radius: 0.5 })
        };
        let obstacles = vec![Obstacle::new("the discs", ObstacleKind::Solid, (0..4).map(disc).collect())];
        World { obstacles, ..open(&format!("world {i}"), &robots) }
    };
    let config = TourConfig {
        worlds: (0..3).map(world).collect(),
        ticks: 1,
        sensor: Some(RangeSensor { n_rays: 1, max_range: 20.0 }),
    };
    let run = Recorder::new(config, Seed(1)).unwrap();
    let (frame, view) = (run.frame(), run.view());
    let all: Vec<String> = (0..3).flat_map(names).collect();
    assert!(view.iter().map(|r| &r.name).eq(&all) && view.iter().map(|r| r.id).eq(0..12_u32), "{view:?}");
    assert!(view.iter().map(|r| r.world as usize).eq((0..12_usize).map(|id| id / 4)));
    assert!(frame.robots.iter().map(|r| r.id).eq(0..12_u32));
    let rovers: Vec<u32> = (0..12).filter(|id| id % 2 == id / 4 % 2).collect();
    assert!(frame.scans.iter().map(|s| s.robot).eq(rovers.iter().copied()), "{:?}", frame.scans);
    for scan in &frame.scans {
        let (i, k) = (scan.robot / 4, scan.robot % 4);
        let expected = 1.5 + f64::from(i + k);
        assert!((scan.ranges[0] - expected).abs() < 1e-12, "robot {}: {:?}, not {expected}", scan.robot, scan.ranges);
    }
}

#[test]
fn every_robot_counts_its_own_contacts() {
    let lane = |y: f64| [5.0, y, 0.0];
    let (first, second, third) = (lane(0.0), lane(10.0), lane(20.0));
    let world = |name: &str, robots: [(&str, &[f64]); 3]| {
        let wall = Shape::Segment { a: Point2::new(10.0, -5.0), b: Point2::new(10.0, 30.0) };
        let obstacles = vec![Obstacle::new("the wall", ObstacleKind::Wall, vec![(Pose2::IDENTITY, wall)])];
        World { obstacles, ..open(name, &robots.map(|(name, start)| (name, "hitch", start))) }
    };
    let worlds = vec![
        world("one", [("twice", &first), ("never", &second), ("once", &third)]),
        world("two", [("still", &first), ("three times", &second), ("late", &third)]),
    ];
    // 1.8 m from the wall: 24 ticks at full speed, and 20 there and back
    let mut events: Vec<Event> =
        ["twice", "once", "three times", "never", "still", "late"].map(|r| drive(1, r, 0)).to_vec();
    events.extend([
        drive(2, "twice", 128),
        drive(2, "once", 128),
        drive(2, "three times", 128),
        drive(2, "never", -128),
    ]);
    events.extend([drive(50, "twice", -128), drive(50, "three times", -128)]);
    events.extend([drive(70, "twice", 128), drive(70, "three times", 128)]);
    events.extend([drive(100, "three times", -128), drive(120, "three times", 128), drive(130, "late", 128)]);
    let log = Run::record(TourConfig { worlds, ticks: 160, sensor: None }, (Seed(1), script(events))).unwrap();
    let contacts = |tick: usize| log.frames()[tick - 1].robots.iter().map(|r| r.contacts).collect::<Vec<_>>();
    assert_eq!(contacts(24), [0, 0, 0, 0, 0, 0]);
    assert_eq!(contacts(26), [1, 0, 1, 0, 1, 0]);
    assert_eq!(contacts(95), [2, 0, 1, 0, 2, 0]);
    assert_eq!(contacts(160), [2, 0, 1, 0, 3, 1]);
    let touching = log.frames()[159].robots.iter().map(|r| r.in_contact);
    assert!(touching.eq([true, false, true, false, true, true]));
}

/// Cars, because they drive exactly as far as their inputs say. Two stand bumper to bumper; the third is alone in its
/// world, where the first of them stands in the other.
#[test]
fn who_is_near_a_robot_is_not_near_the_next_one_in_another_world() {
    let pair = open("pair", &[("first", "hitch", &[0.0; 3]), ("second", "hitch", &[3.95, 0.0, 0.0])]);
    let alone = open("alone", &[("third", "hitch", &[0.0; 3])]);
    // whichever is cut first
    for worlds in [vec![pair.clone(), alone.clone()], vec![alone, pair]] {
        let config = TourConfig { worlds: worlds.clone(), ticks: 10, sensor: None };
        let events = vec![drive(1, "first", 64), drive(1, "second", -64), drive(1, "third", 128)];
        let log = Run::record(config, (Seed(1), script(events))).unwrap();
        let last = log.frames().last().unwrap();
        let state = |name| of(last, &worlds, name).0;
        assert!(state("first").contacts > 0 && state("second").contacts > 0, "5 cm apart, they meet");
        assert!((state("third").configuration[0] - 10.0 * FULL).abs() < 1e-11, "{:?}", state("third").configuration);
        assert_eq!(state("third").contacts, 0);
    }
}
