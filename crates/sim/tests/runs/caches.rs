//! Caches: a result kept from one query or tick to the next is used for the same query only. Each input of a cached
//! result is changed alone, and the new answer is read off the geometry.

use motion_lab_core::collision::ObstacleId;
use motion_lab_core::num::{tan, wrap};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::{RangeSensor, Scanner};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Frame, RobotInput};
use motion_lab_sim::simulation::RobotPlugin;
use motion_lab_sim::tour::TourConfig;

use crate::runs::controls::open;
use crate::simulator::{event, quantized, script};
use oracle::fixtures::PLANE;

/// The distance a car covers in a tick at full speed, metres: 1.5 m/s for 0.05 s.
const FULL: f64 = 0.075;

/// The frames of ticks 1 to `ticks`; the frame of tick k is at index k - 1.
fn frames(world: World, events: Vec<Event>, ticks: u64) -> Vec<Frame> {
    let config = TourConfig { worlds: vec![world], ticks, sensor: None };
    Run::record(config, (Seed(1), script(events))).unwrap().into_frames()
}

/// A held car with an unchanged control keeps its last answer, unless another robot may change it.
#[test]
fn a_held_car_goes_on_when_what_held_it_leaves() {
    let (it, other) =
        (("it", "hitch", &[0.0; 3][..]), ("other", "hitch", &[8.0, 0.0, std::f64::consts::FRAC_PI_2][..]));
    let drive = |tick, robot: &str, speed| event(tick, robot, RobotInput::Drive(speed, 0));
    let events = vec![drive(1, "it", 128), drive(1, "other", 0), drive(100, "other", 128)];
    for (id, robots) in [(0, [it, other]), (1, [other, it])] {
        let frames = frames(open("open", &robots), events.clone(), 200);
        let it = |tick: usize| &frames[tick - 1].robots[id];
        // its front, 3.2 m ahead of its rear axle, stands at the other's side, half a width before 8 m
        let gap = 8.0 - 0.85 - 3.2 - it(60).configuration[0];
        assert!((1e-5..=1e-4).contains(&gap) && it(60).in_contact, "held at {gap}");
        assert!((60..=120).all(|tick| it(tick).configuration == it(60).configuration && it(tick).in_contact));
        // the other's rear, 0.7 m behind its axle, passes the car's side after 1.55 m: at the end of its 21st tick
        assert!((121..=200).all(|tick| !it(tick).in_contact && it(tick).contacts == 1));
        let way = it(200).configuration[0] - it(120).configuration[0];
        assert!((way - 80.0 * FULL).abs() < 1e-12, "it went on by {way}");
    }
}

#[test]
fn a_car_held_at_a_wall_goes_on_from_elsewhere_and_with_another_steering() {
    let wall = Shape::Segment { a: Point2::new(10.0, -9.0), b: Point2::new(10.0, 9.0) };
    let obstacles = vec![Obstacle::new("the wall", ObstacleKind::Wall, vec![(Pose2::IDENTITY, wall)])];
    let world = World { obstacles, ..open("walled", &[("it", "hitch", &[5.0, 0.0, 0.0])]) };
    let put = RobotInput::Teleport(quantized(&[0.0, 5.0, 0.0]));
    let events = vec![event(1, "it", RobotInput::Drive(128, 0)), event(50, "it", put)];
    let run = frames(world.clone(), events, 60);
    let x = |run: &[Frame], tick: usize| run[tick - 1].robots[0].configuration[0];
    assert!(x(&run, 30) == x(&run, 49) && run[48].robots[0].in_contact, "1.8 m are 24 ticks");
    // put 5 m back it drives on with the channels it holds
    assert!((x(&run, 60) - 11.0 * FULL).abs() < 1e-12 && !run[59].robots[0].in_contact, "{}", x(&run, 60));
    // with the wheels turned it is held as before, and in reverse it leaves
    let drives = [(1, 128, 0), (40, 128, 64), (50, -128, 64)];
    let events = drives.map(|(tick, a, b)| event(tick, "it", RobotInput::Drive(a, b))).to_vec();
    let run = frames(world, events, 60);
    assert!(run[38].robots[0].in_contact && run[48].robots[0].in_contact && !run[49].robots[0].in_contact);
    let turn = -11.0 * FULL * tan(0.5 * HITCH.max_steer) / HITCH.wheelbase;
    assert!(wrap(run[59].robots[0].configuration[2] - run[48].robots[0].configuration[2] - turn).abs() < 1e-12);
}

#[test]
fn robots_of_one_type_keep_the_dimensions_of_their_kinds() {
    let robots: [(&str, &str, &[f64]); 4] = [
        ("short", "hitch", &[0.0; 3]),
        ("long", "x-long", &[0.0, 20.0, 0.0]),
        ("longer", "x-longer", &[0.0, 40.0, 0.0]),
        ("short too", "hitch", &[20.0, 0.0, 0.0]),
    ];
    let events = robots.map(|(name, ..)| event(1, name, RobotInput::Drive(128, 128))).to_vec();
    let config = TourConfig { worlds: vec![open("open", &robots)], ticks: 40, sensor: None };
    let log = Run::record_with_robots(config, (Seed(1), script(events)), |app| {
        app.add_plugins((
            RobotPlugin::new("x-long", Hitch { wheelbase: 5.0, max_speed: 1.0, ..HITCH }),
            RobotPlugin::new("x-longer", Hitch { wheelbase: 4.0, max_steer: 0.3, ..HITCH }),
        ));
    });
    let last = log.unwrap().into_frames().remove(39);
    let expected = [(1.5, 0.6, 2.5), (1.0, 0.6, 5.0), (1.5, 0.3, 4.0), (1.5, 0.6, 2.5)];
    for (robot, (v, phi, wheelbase)) in last.robots.iter().zip(expected) {
        let turned = 2.0 * v * tan(phi) / wheelbase;
        let found = robot.configuration[2];
        assert!((found - turned).abs() < 1e-12, "robot {} turned by {found}, not {turned}", robot.id);
    }
}

/// Four discs of radius 0.5 about the origin, their near sides `near` metres away, and `far_walls` walls in a corner
/// where no ray goes.
fn about_the_origin(near: f64, far_walls: u32) -> Scene {
    let wall = |i: u32| {
        let at = Point2::new(20.0 + 0.25 * f64::from(i % 32), 20.0 + 0.25 * f64::from(i / 32));
        Segment::new(at, Point2::new(at.x + 0.125, at.y + 0.0625))
    };
    let scene = Scene::of_walls(&(0..far_walls).map(wall).collect::<Vec<_>>());
    let c = near + 0.5;
    [(c, 0.0), (0.0, c), (-c, 0.0), (0.0, -c)].into_iter().fold(scene, |scene, (x, y)| {
        scene.with_obstacle_at(&format!("disc at {x} {y}"), Pose2::new(x, y, 0.0), Shape::Disc { radius: 0.5 })
    })
}

#[test]
fn one_scanner_sees_each_scene_and_each_robot_as_if_it_were_its_first() {
    let mut scanner = Scanner::new(RangeSensor { n_rays: 4, max_range: 15.0 });
    let other = |x: f64, y: f64| Shape::Disc { radius: 0.25 }.place(&Pose2::new(x, y, 0.0));
    let empty = Scene::empty(PLANE);
    // small scenes and large, growing and shrinking
    for (near, far_walls) in [(2.0, 4), (3.0, 150), (4.0, 40), (5.0, 600), (6.0, 150), (2.5, 0), (3.5, 601), (1.5, 200)]
    {
        let scene = about_the_origin(near, far_walls);
        for (others, ahead) in [(vec![], near), (vec![other(1.0, 0.0)], 0.75), (vec![], near)] {
            for quarters in [0_usize, 1, 3, 0] {
                let heading = wrap(std::f64::consts::FRAC_PI_2 * quarters as f64);
                let mut ranges = [-1.0; 4];
                scanner.scan_into(&scene, &others, &Pose2::new(0.0, 0.0, heading), &mut ranges);
                let mut expected = [ahead, near, near, near];
                expected.rotate_left(quarters);
                let same = ranges.iter().zip(expected).all(|(r, e)| (r - e).abs() < 1e-12);
                assert!(same, "{ranges:?}, not {expected:?}, among {far_walls} walls");
            }
        }
        let mut ranges = [-1.0; 4];
        scanner.scan_into(&empty, &[], &Pose2::IDENTITY, &mut ranges);
        assert_eq!(ranges, [f64::INFINITY; 4], "after {near}");
        scanner.scan_into(&scene, &[other(0.0, 0.0)], &Pose2::IDENTITY, &mut ranges);
        assert_eq!(ranges, [0.0; 4], "inside another robot");
    }
}

/// Discs are added one after the other along a line toward the origin. Whichever index the scene uses, the newest disc
/// is the nearest.
#[test]
fn every_answer_of_a_scene_sees_what_was_added_last_however_many_there_are() {
    let sensor = RangeSensor { n_rays: 8, max_range: 400.0 };
    let rover = Footprint::disc(Point2::origin(), 0.25);
    let mut scene = Scene::empty(PLANE);
    for i in 0..150_u32 {
        let x = 170.0 - f64::from(i);
        let shape = Shape::Disc { radius: 0.25 };
        scene = scene.with_obstacle_at(&format!("disc {i}"), Pose2::new(x, 0.0, 0.0), shape);
        let w = scene.witness(&rover).unwrap();
        assert_eq!((scene.distance(&rover), w.dist, w.obstacle), (x - 0.5, x - 0.5, ObstacleId(i)));
        let there = Footprint::disc(Point2::new(x - 0.5, 0.0), 0.25);
        assert!(scene.intersects(&there) && scene.swept(&rover, &there), "it touches the disc at {x}");
        let short = Footprint::disc(Point2::new(x - 0.75, 0.0), 0.25);
        assert!(!scene.intersects(&short) && !scene.swept(&rover, &short), "a quarter of a metre before it");
        assert_eq!(scene.touched(&there), [ObstacleId(i)]);
        let ranges = sensor.scan(&scene, Point2::origin());
        assert!((ranges[0] - (x - 0.25)).abs() < 1e-9, "{} to the disc at {x}", ranges[0]);
        assert!(ranges[1..].iter().all(|r| r.is_infinite()), "{ranges:?}");
    }
}
