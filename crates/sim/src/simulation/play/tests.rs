//! Scripts of paths, run by the simulator's own schedule.

use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::run::{Frame, RobotInput, Script};
use crate::simulation::tick::refusals::Refusals;
use crate::simulation::{LatestFrame, SimulationPlugin, start_run, step};
use crate::tour::TourConfig;
use motion_lab_core::collision::{Checker, Problem, Scene};
use motion_lab_core::configuration::{HitchCfg, R2, T2};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::{greater, hypot, lesser, wrap};
use motion_lab_core::planning::curves::reeds_shepp;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::planning::{Bounds, CertifiedPath, LinePath, RrtConnect, solve};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, CarCmd, Drivable, HITCH, Reach, RustyDisc};
use motion_lab_core::worlds::{Resident, World};

/// The frames of a run, from tick 0 on. No input is refused.
fn run(world: &World, seed: Seed, played: &PlayedPath, after: u64) -> Vec<Frame> {
    let mut app = bevy::app::App::new();
    app.add_plugins(SimulationPlugin);
    let config = TourConfig { worlds: vec![world.clone()], ticks: played.ticks + after, sensor: None };
    played.script.check_for(&config).unwrap();
    let world = app.world_mut();
    start_run(world, config, (seed, played.script.clone())).unwrap();
    let mut frames = vec![world.resource::<LatestFrame>().frame().clone()];
    for _ in 0..played.ticks + after {
        step(world);
        frames.push(world.resource::<LatestFrame>().frame().clone());
    }
    assert_eq!(world.resource::<Refusals>().count(), 0);
    for frame in &frames {
        assert!(!frame.robots[0].in_contact && frame.robots[0].contacts == 0, "tick {}", frame.tick);
    }
    frames
}

fn last(frames: &[Frame]) -> Vec<f64> {
    frames[frames.len() - 1].robots[0].configuration.to_vec()
}

#[test]
fn an_arm_plays_its_path_round_the_post() {
    let world = World::workbench();
    let checker = Checker::new(Scene::workbench(), Reach::<2>::workbench());
    for seed in 0..5 {
        let problem = Problem::try_new(checker.clone(), T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(seed)).unwrap();
        let path = solve(&mut RrtConnect::new(problem), &Bounds::default()).unwrap();
        let played = Script::of_path(&path, &PlayStage::new(&world, "Reach", Seed(seed))).unwrap();
        assert!(matches!(played.script.events[0].input, RobotInput::Teleport(_)), "it starts elsewhere");
        assert!(played.strayed < 3e-6 && played.missed < 3e-6 && played.clearance > 0.0, "{played:?}");
        let frames = run(&world, Seed(seed), &played, 5);
        let end = last(&frames);
        assert!((end[0] - 3.1).abs() < 1e-6 && end[1].abs() < 1e-6, "{end:?}");
        // no joint turns faster than 2 rad/s, after the first tick
        for pair in frames[1..].windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|frame| &frame.robots[0].configuration);
            assert!(a.iter().zip(b.iter()).all(|(a, b)| wrap(b - a).abs() <= 0.1 + 2e-6), "tick {}", pair[1].tick);
        }
        // it passes every corner of the path after the start, where it was put
        for corner in &path.corners()[1..] {
            let near = frames.iter().any(|frame| {
                let q = &frame.robots[0].configuration;
                wrap(q[0] - corner.0[0]).abs() + wrap(q[1] - corner.0[1]).abs() < 3e-6
            });
            assert!(near, "{corner}");
        }
    }
}

#[test]
fn a_trailer_is_parked_bit_for_bit() {
    let world = World::lot();
    let start = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: Some(0.0) };
    let goal = HitchCfg { body: Pose2::new(6.75, 7.0, -FRAC_PI_2), trailer: Some(-FRAC_PI_2) };
    let problem = Problem::try_new(Checker::new(Scene::lot(), HITCH.with_trailer()), start, goal, Seed(1)).unwrap();
    let mut planner = HybridAStar::new(problem);
    // the path's end is near the goal, and the simulator's is the path's
    let path = solve(&mut planner, &Bounds::default()).unwrap();
    let played = Script::of_path(&path, &PlayStage::new(&world, "Hitch", Seed(3))).unwrap();
    assert_eq!((played.strayed, played.missed), (0.0, 0.0));
    assert_eq!(played.script.events[0].input, RobotInput::SetTrailer(true), "the resident has none at first");
    let frames = run(&world, Seed(3), &played, 10);
    let end = path.goal();
    assert_eq!(last(&frames), [end.body.x, end.body.y, end.body.theta, end.trailer.unwrap()]);
    assert_eq!(frames[played.ticks as usize].robots[0].configuration, frames[frames.len() - 1].robots[0].configuration);
}

#[test]
fn a_car_drives_reeds_and_shepps_curve_to_within_a_tube() {
    let world = World::lot();
    let checker = Checker::new(Scene::lot(), HITCH);
    let start = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: None };
    for goal in [Pose2::new(9.0, 2.5, 0.0), Pose2::new(5.0, 2.9, 0.3), Pose2::new(8.0, 3.0, 0.2)] {
        let curve = reeds_shepp(&start.body, &goal, HITCH.tightest()).unwrap();
        let path = curve.certified(&checker, &start).unwrap();
        let off = path.goal().body.boxminus(&goal);
        assert!(hypot(off.dx, off.dy) < 1e-9 && off.dtheta.abs() < 1e-9, "{off:?}");
        let played = Script::of_path(&path, &PlayStage { tube: 0.01, ..PlayStage::new(&world, "Hitch", Seed(9)) });
        let played = played.unwrap();
        assert!(played.strayed > 0.0 && played.missed < 0.01, "{played:?}");
        let end = last(&run(&world, Seed(9), &played, 5));
        assert!(hypot(end[0] - goal.x, end[1] - goal.y) <= played.missed + 1e-9, "{end:?}");
    }
}

/// How far a point is from a chain of lines, metres.
fn beside(p: Point2, corners: &[Point2]) -> f64 {
    corners.windows(2).fold(f64::INFINITY, |least, ends| {
        let (d, to) = (ends[1] - ends[0], p - ends[0]);
        let s = ((to.x * d.x + to.y * d.y) / (d.x * d.x + d.y * d.y)).clamp(0.0, 1.0);
        lesser(least, hypot(to.x - s * d.x, to.y - s * d.y))
    })
}

#[test]
fn a_rover_stays_in_its_tube_at_every_seed_that_its_script_is_made_for() {
    let world = World::apartment();
    let corners = [(2.25, 6.25), (2.9375, 5.375), (2.9375, 4.0), (9.0625, 4.0), (9.0625, 5.375), (9.75, 6.25)];
    let corners = corners.map(|(x, y)| Point2::new(x, y));
    let checker = Checker::new(Scene::apartment(), RustyDisc { radius: 0.13 });
    let path = LinePath::through(&checker, &corners.map(R2)).unwrap();
    let mut farthest = 0.0;
    let mut scripts = Vec::new();
    for seed in 0..20 {
        let stage = PlayStage { tube: 0.02, ..PlayStage::new(&world, "Rusty", Seed(seed)) };
        let played = Script::of_path(&path, &stage).unwrap();
        let frames = run(&world, Seed(seed), &played, 10);
        for frame in &frames {
            let q = &frame.robots[0].configuration;
            let strayed = beside(Point2::new(q[0], q[1]), &corners);
            assert!(strayed <= played.strayed && played.strayed <= 0.02, "{strayed} at tick {}", frame.tick);
            farthest = greater(farthest, strayed);
        }
        let end = last(&frames);
        assert!(hypot(end[0] - 9.75, end[1] - 6.25) <= played.missed + 1e-9 && played.missed < 2e-3, "{end:?}");
        scripts.push(played.script);
    }
    assert!(farthest > 1e-4, "slip moves it off its line: {farthest}");
    scripts.dedup();
    assert_eq!(scripts.len(), 20, "each seed has a script of its own");
}

#[test]
fn what_cant_be_played_is_an_error_of_its_own_kind() {
    let (world, lot) = (World::apartment(), World::lot());
    let checker = Checker::new(Scene::apartment(), RustyDisc::default());
    let path = LinePath::through(&checker, &[R2::new(2.25, 6.25), R2::new(2.6, 5.9)]).unwrap();
    let stage = PlayStage::new(&world, "Rusty", Seed(1));
    assert!(Script::of_path(&path, &stage).is_ok());
    let none = Script::of_path(&path, &PlayStage { robot: "Dusty", ..stage });
    assert!(matches!(none, Err(PlayError::NoSuchRobot { .. })));
    let other = Script::of_path(&path, &PlayStage { world: &lot, robot: "Hitch", ..stage });
    assert!(matches!(other, Err(PlayError::OtherKind { wanted: "rusty", .. })), "{other:?}");
    let mut crowded = world.clone();
    crowded.robots.push(Resident::new("Rusty 2", "rusty", vec![6.0, 4.0, 0.0]));
    let crowded = Script::of_path(&path, &PlayStage { world: &crowded, ..stage });
    assert!(matches!(crowded, Err(PlayError::Company { .. })));
    // slip takes it farther than a hair
    let narrow = Script::of_path(&path, &PlayStage { tube: 1e-6, ..stage });
    assert!(matches!(narrow, Err(PlayError::LeavesTube { .. })), "{narrow:?}");
    // certified in an empty scene, through a wall of the apartment
    let empty = Checker::new(Scene::empty(Scene::apartment().bounds()), RustyDisc::default());
    let through = LinePath::through(&empty, &[R2::new(2.25, 6.25), R2::new(6.0, 6.25)]).unwrap();
    let through = Script::of_path(&through, &stage);
    assert!(matches!(through, Err(PlayError::NotFree { tick }) if tick > 1), "{through:?}");
    let from_wall = LinePath::through(&empty, &[R2::new(4.5, 4.75), R2::new(4.5, 4.0)]).unwrap();
    let from_wall = Script::of_path(&from_wall, &stage);
    assert!(matches!(from_wall, Err(PlayError::Start { .. })), "{from_wall:?}");
    // faster than the car goes
    let (car, q) = (Checker::new(Scene::lot(), HITCH), HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: None });
    let fast = HITCH.drive(&q, &CarCmd { v: 2.0, phi: 0.0 }, 0.5).unwrap();
    let fast = CertifiedPath::try_new(&car, [fast]).unwrap();
    let fast = Script::of_path(&fast, &PlayStage { world: &lot, robot: "Hitch", ..stage });
    assert!(matches!(fast, Err(PlayError::Speed { leg: 0, .. })), "{fast:?}");
    // sideways, by a straight line of its chart
    let (hitch, from) = AnyRobot::of_kind("hitch", &[6.5, 2.5, 0.0]).unwrap();
    let beside = AnyRobot::of_kind("hitch", &[6.5, 2.8, 0.0]).unwrap().1;
    let sideways = LinePath::through(&Checker::new(Scene::lot(), hitch), &[from, beside]).unwrap();
    let sideways = Script::of_path(&sideways, &PlayStage { world: &lot, robot: "Hitch", ..stage });
    assert_eq!(sideways, Err(PlayError::Undriven));
}

#[test]
fn a_path_of_any_robot_is_played_as_the_robot_s_own() {
    let (world, seed) = (World::apartment(), Seed(4));
    let (rover, from) = AnyRobot::of_kind("rusty", &[2.25, 6.25, 0.0]).unwrap();
    let to = AnyRobot::of_kind("rusty", &[2.6, 5.9, 0.0]).unwrap().1;
    let stage = PlayStage::new(&world, "Rusty", seed);
    let any = LinePath::through(&Checker::new(Scene::apartment(), rover), &[from, to]).unwrap();
    let disc = Checker::new(Scene::apartment(), RustyDisc::default());
    let own = LinePath::through(&disc, &[R2::new(2.25, 6.25), R2::new(2.6, 5.9)]).unwrap();
    assert_eq!(Script::of_path(&any, &stage).unwrap(), Script::of_path(&own, &stage).unwrap());
    let (world, at) = (World::workbench(), |q: [f64; 2]| AnyRobot::of_kind("reach", &q).unwrap());
    let stage = PlayStage::new(&world, "Reach", seed);
    let (arm, from) = at([-0.5, 0.3]);
    let any = LinePath::through(&Checker::new(Scene::workbench(), arm), &[from, at([-0.2, -0.4]).1]).unwrap();
    let reach = Checker::new(Scene::workbench(), Reach::<2>::workbench());
    let own = LinePath::through(&reach, &[T2::new(-0.5, 0.3), T2::new(-0.2, -0.4)]).unwrap();
    assert_eq!(Script::of_path(&any, &stage).unwrap(), Script::of_path(&own, &stage).unwrap());
}
