//! What a door, a moved obstacle and a new one do to a run.

use motion_lab_core::collision::{Checker, Collision, Scene};
use motion_lab_core::robots::RustyDisc;
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{ObstacleState, RobotInput};

use super::*;
use crate::simulator::event;

/// A door is a segment: the disc's centre stays a body radius away, and a hair.
const LOWEST: f64 = 4.75 + 0.11;

#[test]
fn a_closed_door_holds_rusty_and_an_opened_one_lets_it_pass() {
    let through = passes(&Run::record(apartment(1200), Seed(2005)).unwrap()).expect("the tour leads through the door");
    let held = Run::record(apartment(1200), (Seed(2005), changes(&[(1, close())]))).unwrap();
    assert_eq!(passes(&held), None);
    let lowest = held.frames().iter().map(y).fold(f64::INFINITY, |a, b| if b < a { b } else { a });
    assert!((LOWEST..LOWEST + 1e-3).contains(&lowest), "it drives up to the door: {lowest}");
    assert!(held.frames()[1199].robots[0].contacts > 0);

    // it has pushed at the door for a while, at rest, with the same command each tick
    let late = through + 200;
    let opened = Run::record(apartment(1200), (Seed(2005), changes(&[(1, close()), (late, open())]))).unwrap();
    let (before, after) = (&opened.frames()[late as usize - 3], &opened.frames()[late as usize - 2]);
    assert_eq!(before.robots[0].configuration, after.robots[0].configuration, "held");
    assert!(y(&opened.frames()[late as usize - 1]) < y(after), "at the very tick of the change");
    let passed = passes(&opened).expect("it goes on");
    assert!((late..late + 100).contains(&passed), "{passed}");
    // the frames say what is not as at the start, and no more
    let closed = ObstacleState { world: 0, obstacle: number_of_door(), present: true, pose: Pose2::IDENTITY };
    assert_eq!(opened.initial().unwrap().obstacles, []);
    assert_eq!(opened.frames()[0].obstacles, [closed]);
    assert_eq!(opened.frames()[late as usize - 2].obstacles, [closed]);
    assert_eq!(opened.frames()[late as usize - 1].obstacles, []);
}

/// The doors come after the world file's obstacles; the door of room A is the first.
fn number_of_door() -> u32 {
    World::apartment().obstacles.len() as u32
}

#[test]
fn a_door_is_not_closed_on_a_robot() {
    let config = apartment(40);
    let put = |x, y| RobotInput::Teleport([x, y, 0.0].map(quantized).to_vec());
    let run = |x: f64, y: f64| {
        let script = Script { events: vec![event(1, "Rusty", put(x, y))], ..changes(&[(2, close())]) };
        Run::record(config.clone(), (Seed(1), script)).unwrap()
    };
    // the disc has a radius of 0.11 m; put there, it stands still
    for (y, closes) in [(4.75, false), (4.85, false), (4.75 - 0.109, false), (4.87, true), (4.75 - 0.12, true)] {
        let log = run(2.9375, y);
        assert_eq!(log.frames()[1].obstacles.len(), usize::from(closes), "{y}");
    }
    assert_eq!(run(2.5 - 0.2, 4.9).frames()[1].obstacles.len(), 1, "beside it");
}

#[test]
fn an_obstacle_that_is_taken_away_frees_edges_and_motions() {
    let scene = Scene::of_world(&World::apartment());
    let without = |name: &str| {
        let mut world = World::apartment();
        world.obstacles.retain(|o| o.name != name);
        Scene::of_world(&world)
    };
    // through the round table of room B: a disc about (6, 6.75) with a radius of 0.5
    let (a, b) = (R2(Point2::new(5.0, 6.75)), R2(Point2::new(7.0, 6.75)));
    let disc = RustyDisc::default();
    assert!(!Checker::new(scene, disc).edge_free(&a, &b));
    assert!(Checker::new(without("B's round table"), disc).edge_free(&a, &b));

    // the same in a run: driven at the table from the left, along y = 6.75
    let put = RobotInput::Teleport([5.0, 6.75, 0.0].map(quantized).to_vec());
    let events = vec![event(1, "Rusty", put), event(2, "Rusty", RobotInput::Drive(128, 0))];
    let run = |of: &[(u64, WorldChange)]| {
        let script = Script { events: events.clone(), ..changes(of) };
        Run::record(apartment(160), (Seed(1), script)).unwrap()
    };
    let x = |log: &Log, tick: usize| log.frames()[tick - 1].robots[0].configuration[0];
    let stays = run(&[]);
    // 6 - 0.5 - 0.11, less the clearance that a held robot keeps
    assert!((5.389..5.39).contains(&x(&stays, 160)), "{}", x(&stays, 160));
    let removed = run(&[(100, WorldChange::Remove("B's round table".into()))]);
    assert_eq!(x(&removed, 99).to_bits(), x(&stays, 99).to_bits());
    assert!(x(&removed, 160) > 6.5, "{}", x(&removed, 160));
    // moved up by a metre, it is out of the way; turned by half a turn about the origin it is far away
    for to in [(0.0, 1.0, 0.0), (0.0, 0.0, 3.0)] {
        let to = (quantized(to.0), quantized(to.1), quantized(to.2));
        let moved = run(&[(100, WorldChange::Move { name: "B's round table".into(), to })]);
        assert!(x(&moved, 160) > 6.5);
    }
    // moved left by 0.2 m it would stand on the robot, which touches it
    let to = (quantized(-0.2), quantized(0.0), quantized(0.0));
    let refused = run(&[(100, WorldChange::Move { name: "B's round table".into(), to })]);
    assert_eq!(x(&refused, 160).to_bits(), x(&stays, 160).to_bits());
    assert_eq!(refused.frames()[120].obstacles, []);
}

/// A car without noise that pushes at a bar gives the same command at the same place, tick after tick: what is kept of
/// its motion must be forgotten when the bar goes, and when it comes.
#[test]
fn a_motion_that_is_kept_is_kept_with_its_scene() {
    let world = crate::runs::controls::open("field", &[("Car", "hitch", &[0.0, 0.0, 0.0])]);
    let points = [(6.0, -3.0), (6.0, 3.0)].map(|(x, y)| (quantized(x), quantized(y))).to_vec();
    let bar = WorldChange::Add { name: "bar".into(), points, radius: quantized(0.0) };
    let change = |tick, change| WorldEvent { tick, world: "field".into(), change };
    let changes = vec![change(1, bar), change(100, WorldChange::Remove("bar".into()))];
    let script = Script::new(vec![event(1, "Car", RobotInput::Drive(128, 0))], changes);
    let log = Run::record(TourConfig { worlds: vec![world], ticks: 110, sensor: None }, (Seed(1), script)).unwrap();
    let x = |tick: usize| log.frames()[tick - 1].robots[0].configuration[0];
    // the chassis reaches 3.2 m ahead of the rear axle
    assert!((6.0 - 3.2 - 1e-4..6.0 - 3.2).contains(&x(99)), "{}", x(99));
    assert_eq!(x(90).to_bits(), x(99).to_bits());
    assert!((x(100) - x(99) - 1.5 * 0.05).abs() < 1e-12, "free in the very tick: {}", x(100) - x(99));
}

#[test]
fn a_moved_obstacle_is_where_the_rigid_motion_takes_it() {
    // (x, y) -> (4 - y, x - 1): a quarter turn, then a shift; the table's middle (6, 6.75) comes to (-2.75, 5)
    let quarter = std::f64::consts::FRAC_PI_2;
    let to = (quantized(4.0), quantized(-1.0), quantized(quarter));
    let change = WorldChange::Move { name: "B's round table".into(), to };
    let mut recorder = Recorder::new(apartment(3), (Seed(1), changes(&[(2, change)]))).unwrap();
    let distance = |recorder: &Recorder| {
        let roster = recorder.world().resource::<motion_lab_sim::simulation::Roster>();
        let scene = recorder.world().get::<motion_lab_sim::simulation::WorldScene>(roster.worlds()[0]).unwrap();
        scene.0.distance(&Footprint::disc(Point2::new(-2.75, 8.0), 0.25))
    };
    recorder.step();
    assert!((distance(&recorder) - 2.5).abs() < 1e-12, "the outer wall, at (0, 8)");
    recorder.step();
    // the angle is rounded to 2^-20 rad, over 9 m
    assert!((distance(&recorder) - 2.25).abs() < 1e-5, "{}", distance(&recorder));
}

#[test]
fn a_new_obstacle_stands_where_the_script_puts_it() {
    let points = [(2.5, 4.75), (3.375, 4.75)].map(|(x, y)| (quantized(x), quantized(y))).to_vec();
    let bar = WorldChange::Add { name: "the bar".into(), points, radius: quantized(0.0) };
    let script = changes(&[(1, bar.clone()), (900, WorldChange::Remove("the bar".into()))]);
    let log = Run::record(apartment(1000), (Seed(2005), script)).unwrap();
    // the bar is the closed door, under another name and number
    let door = Run::record(apartment(1000), (Seed(2005), changes(&[(1, close()), (900, open())]))).unwrap();
    let robots = |log: &Log| log.frames().iter().map(|f| f.robots.clone()).collect::<Vec<_>>();
    assert_eq!(robots(&log), robots(&door));
    let number = (World::apartment().obstacles.len() + World::apartment().doors.len()) as u32;
    let states = [ObstacleState { world: 0, obstacle: number, present: true, pose: Pose2::IDENTITY }];
    assert_eq!(log.frames()[898].obstacles, states);
    assert_eq!(log.frames()[899].obstacles, []);
    assert!(verify(&log, |_| {}).unwrap().difference.is_none());
}

#[test]
fn a_capture_shows_the_doors_as_they_stand() {
    let log = Run::record(apartment(6), (Seed(3), changes(&[(2, close()), (5, open())]))).unwrap();
    let subject = motion_lab_sim::capture::Subject::Dashboard { names: false, scan: false, nearest: false };
    for (tick, is_open) in [(1, true), (2, false), (4, false), (5, true)] {
        let captured = motion_lab_sim::capture::at_tick(&log, &subject, tick, 640.0).unwrap();
        let items = &captured.figure.panels[0].picture.items;
        assert!(items.iter().any(|item| item.id == "door/door A"));
        assert_eq!(items.iter().any(|item| item.id == "door/door A/leaf"), is_open, "tick {tick}");
    }
}

#[test]
fn a_run_goes_back_over_its_changes_and_forward_again() {
    let table = "B's round table".to_owned();
    let to = (quantized(0.25), quantized(0.5), quantized(0.125));
    let script = changes(&[
        (10, close()),
        (20, WorldChange::Remove(table.clone())),
        (30, WorldChange::Move { name: table, to }),
        (40, open()),
    ]);
    let log = Run::record(apartment(300), (Seed(3), script.clone())).unwrap();
    let frame = |tick: u64| if tick == 0 { log.initial().unwrap() } else { &log.frames()[tick as usize - 1] };
    let mut recorder = Recorder::new(apartment(300), (Seed(3), script)).unwrap();
    for tick in [300, 5, 15, 25, 299, 35, 0, 45, 200, 12, 300] {
        assert_eq!(recorder.seek(tick).unwrap(), frame(tick), "{tick}");
    }
    let mut strange = frame(15).clone();
    let state = ObstacleState { obstacle: 1000, ..*strange.obstacles.last().unwrap() };
    strange.obstacles = [state].into_iter().collect();
    let refused = recorder.restore(&strange).unwrap_err().to_string();
    assert!(refused.contains("obstacle 1000 of world 0"), "{refused}");
}
