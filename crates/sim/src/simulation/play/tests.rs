//! Scripts of paths, run by the simulator's own schedule.

use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::run::{Frame, RobotInput, Script};
use crate::simulation::tick::refusals::Refusals;
use crate::simulation::{LatestFrame, SimulationPlugin, start_run, step};
use crate::tour::TourConfig;
use motion_lab_core::collision::{Checker, Collision, Problem, Scene};
use motion_lab_core::configuration::{HitchCfg, R2, T2};
use motion_lab_core::geometry::{Footprint, Point2, Pose2};
use motion_lab_core::num::{cos, greater, hypot, lesser, sin, sin_cos, wrap};
use motion_lab_core::planning::curves::reeds_shepp;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::planning::{Bounds, CertifiedPath, LinePath, RrtConnect, solve};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, CarCmd, Drivable, HITCH, Motion, Reach, Robot, RustyDisc};
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

/// A path says how fast it is to be driven: half as fast takes twice the ticks, and is the car's own half channel.
#[test]
fn an_arc_of_whole_ticks_is_played_at_its_own_speed() {
    let start = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: None };
    for (v, ticks, channel) in [(1.5, 10_u64, 128), (0.75, 20, 64), (-0.375, 40, -32)] {
        let arc = HITCH.drive(&start, &CarCmd { v, phi: 0.0 }, ticks as f64 * 0.05).unwrap();
        let path = CertifiedPath::try_new(&Checker::new(Scene::lot(), HITCH), vec![arc]).unwrap();
        let played = Script::of_path(&path, &PlayStage::new(&World::lot(), "Hitch", Seed(1))).unwrap();
        let inputs: Vec<_> = played.script.events.iter().map(|event| (event.tick, event.input.clone())).collect();
        assert_eq!(inputs, [(1, RobotInput::Drive(channel, 0)), (ticks + 1, RobotInput::Drive(0, 0))], "{v} m/s");
        assert_eq!((played.strayed, played.missed, played.ticks), (0.0, 0.0, ticks));
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

/// The path of an arm on the Workbench, of a car in the Lot and of a rover in the Apartment, each played in a tube.
fn played_in(tube: f64) -> [Result<PlayedPath, PlayError>; 3] {
    let (bench, lot, flat) = (World::workbench(), World::lot(), World::apartment());
    let arm = Checker::new(Scene::workbench(), Reach::<2>::workbench());
    let arm = LinePath::through(&arm, &[T2::new(-0.5, 0.3), T2::new(-0.2, -0.4), T2::new(0.1, -0.3)]).unwrap();
    let start = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: None };
    let curve = reeds_shepp(&start.body, &Pose2::new(5.0, 2.9, 0.3), HITCH.tightest()).unwrap();
    let car = curve.certified(&Checker::new(Scene::lot(), HITCH), &start).unwrap();
    let corners = [(2.25, 6.25), (2.9375, 5.375), (2.9375, 4.0)].map(|(x, y)| R2::new(x, y));
    let rover = LinePath::through(&Checker::new(Scene::apartment(), RustyDisc::default()), &corners).unwrap();
    let stage = |world, robot| PlayStage { tube, ..PlayStage::new(world, robot, Seed(4)) };
    [
        Script::of_path(&arm, &stage(&bench, "Reach")),
        Script::of_path(&car, &stage(&lot, "Hitch")),
        Script::of_path(&rover, &stage(&flat, "Rusty")),
    ]
}

#[test]
fn a_tube_as_wide_as_a_robot_strays_is_wide_enough_and_one_narrower_by_a_bit_is_not() {
    let wide = played_in(0.05);
    for (number, played) in wide.into_iter().enumerate() {
        let played = played.unwrap();
        let (strayed, narrower) = (played.strayed, played.strayed.next_down());
        assert!(strayed > 0.0, "{number}");
        assert_eq!(played_in(strayed)[number].as_ref(), Ok(&played), "{number}");
        let refused = played_in(narrower)[number].clone().unwrap_err();
        let PlayError::LeavesTube { tick, strayed: there, tube } = refused else { panic!("{number}: {refused}") };
        assert_eq!(
            (there, tube),
            (strayed, narrower),
            "{number}: the first tick beyond it is the one that is farthest"
        );
        assert!((1..=played.ticks).contains(&tick), "{number}");
    }
}

/// How far the elbow and the tip of the arm are from their places at other angles, at most, metres, and what no point
/// of its links, 3 cm thick, can exceed.
fn arm_off(q: [f64; 2], planned: [f64; 2]) -> [f64; 2] {
    let place = |[a, b]: [f64; 2]| {
        let elbow = [cos(a), sin(a)];
        [elbow, [elbow[0] + cos(a + b), elbow[1] + sin(a + b)]]
    };
    let apart = |(p, q): ([f64; 2], [f64; 2])| hypot(p[0] - q[0], p[1] - q[1]);
    let off = place(q).into_iter().zip(place(planned)).map(apart).fold(0.0, greater);
    let [a, b] = [0, 1].map(|i| (q[i] - planned[i]).abs());
    [off, 2.03 * a + 1.03 * b]
}

/// The tick's motion and the path's line side by side, both at constant rates of the joints.
#[test]
fn an_arm_is_as_near_to_its_path_between_ticks_as_is_said() {
    let played = played_in(0.05)[0].clone().unwrap();
    let frames = run(&World::workbench(), Seed(4), &played, 0);
    let rounded = |q: [f64; 2]| q.map(|x| (x * 1048576.0).round() / 1048576.0);
    let corners = [[-0.5, 0.3], [-0.2, -0.4], [0.1, -0.3]];
    let (mut before, mut tick, mut farthest, mut most) = (rounded(corners[0]), 0, 0.0, 0.0);
    let mut look = |q, planned| {
        let [off, bound] = arm_off(q, planned);
        (farthest, most) = (greater(off, farthest), greater(bound, most));
        bound
    };
    look(before, corners[0]);
    for ends in corners.windows(2) {
        let turns = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let ticks = (greater(turns[0].abs(), turns[1].abs()) / 0.1).ceil();
        let planned = |k: f64| [0, 1].map(|i| ends[0][i] + turns[i] * k / ticks);
        for k in 0..ticks as usize {
            tick += 1;
            let now = &frames[tick].robots[0].configuration;
            assert!((0..2).all(|i| now[i] == rounded(planned(k as f64 + 1.0))[i]), "tick {tick}");
            for u in 0..=16 {
                let u = f64::from(u) / 16.0;
                look([0, 1].map(|i| before[i] + (now[i] - before[i]) * u), planned(k as f64 + u));
            }
            before = [now[0], now[1]];
        }
    }
    assert_eq!(played.ticks as usize, tick);
    assert!(farthest <= played.strayed && played.strayed <= most + 1e-12, "{farthest} {played:?} {most}");
    let [missed, bound] = arm_off(before, corners[2]);
    assert!(missed <= played.missed && played.missed <= bound + 1e-12, "{missed} {played:?} {bound}");
}

/// The tick's arc and the stretch of the path's arc that is as long, side by side, by all corners of the car.
#[test]
fn a_car_is_as_near_to_its_path_between_ticks_as_is_said() {
    let checker = Checker::new(Scene::lot(), HITCH);
    let start = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: None };
    let curve = reeds_shepp(&start.body, &Pose2::new(5.0, 2.9, 0.3), HITCH.tightest()).unwrap();
    let path = curve.certified(&checker, &start).unwrap();
    let played = played_in(0.05)[1].clone().unwrap();
    let frames = run(&World::lot(), Seed(4), &played, 0);
    let apart = |a: &HitchCfg, b: &HitchCfg| {
        let [a, b] = [a, b].map(|q| HITCH.footprint(q));
        let pairs = a.parts()[0].placed().core().iter().zip(b.parts()[0].placed().core());
        pairs.map(|(p, q)| hypot(p.x - q.x, p.y - q.y)).fold(0.0, greater)
    };
    let (mut tick, mut farthest, mut nearest, mut channels) = (0, 0.0, f64::INFINITY, [0; 2]);
    for leg in path.legs() {
        // 0.075 m a tick at full speed, and the rest in a last tick at the nearest of 128 speeds
        let (arc, mut before, mut driven) = (leg.motion(), 0.0, 0.0);
        let length = (arc.control().v * arc.seconds()).abs();
        let rest = ((length / 0.075).fract() * 128.0).round() / 128.0;
        let ticks = (length / 0.075).floor() as usize;
        for k in 0..ticks + usize::from(rest > 0.0) {
            tick += 1;
            driven += if k < ticks { 0.075 } else { 0.075 * rest };
            if let Some(event) = played.script.events.iter().find(|event| event.tick == tick)
                && let RobotInput::Drive(speed, steering) = event.input
            {
                channels = [speed, steering];
            }
            let control = CarCmd {
                v: f64::from(channels[0]) / 128.0 * HITCH.max_speed,
                phi: f64::from(channels[1]) / 128.0 * HITCH.max_steer,
            };
            let from = &frames[tick as usize - 1].robots[0].configuration;
            let from = HitchCfg { body: Pose2::new(from[0], from[1], from[2]), trailer: None };
            let motion = HITCH.drive(&from, &control, 0.05).unwrap();
            let s = lesser(driven / length, 1.0);
            for u in 0..=16 {
                let u = f64::from(u) / 16.0;
                let q = motion.at(u);
                farthest = greater(apart(&q, &arc.at(before + u * (s - before))), farthest);
                nearest = lesser(checker.distance(&q), nearest);
            }
            before = s;
        }
    }
    assert_eq!(played.ticks, tick);
    // a tick turns the car by 0.01 rad and bends its corners' ways by less than a millimetre
    assert!(farthest <= played.strayed && played.strayed <= farthest + 2e-3, "{farthest} {played:?}");
    assert!(played.clearance <= nearest && nearest <= played.clearance + 1e-2, "{nearest} {played:?}");
    let missed = apart(&motion_end(&frames), &path.goal());
    assert!(missed <= played.missed + 1e-12 && played.missed <= missed * 2.0, "{missed} {played:?}");
}

/// Where a car without a trailer stands at the last frame.
fn motion_end(frames: &[Frame]) -> HitchCfg {
    let end = last(frames);
    HitchCfg { body: Pose2::new(end[0], end[1], end[2]), trailer: None }
}

/// Each tick's arc by its chord and its turn, and the chain of the path's lines.
#[test]
fn a_rover_is_as_near_to_its_path_between_ticks_as_is_said() {
    let played = played_in(0.05)[2].clone().unwrap();
    let frames = run(&World::apartment(), Seed(4), &played, 0);
    let corners = [(2.25, 6.25), (2.9375, 5.375), (2.9375, 4.0)].map(|(x, y)| Point2::new(x, y));
    let (scene, mut farthest, mut nearest) = (Scene::apartment(), 0.0, f64::INFINITY);
    for ends in frames.windows(2) {
        let [a, b] = [0, 1].map(|k| &ends[k].robots[0].configuration);
        let (chord, turn) = (Point2::new(b[0] - a[0], b[1] - a[1]), wrap(b[2] - a[2]));
        for u in 0..=32 {
            let u = f64::from(u) / 32.0;
            // the chord of a part of the arc, in the direction that it has half way
            let part = if turn == 0.0 { u } else { sin(0.5 * u * turn) / sin(0.5 * turn) };
            let (s, c) = sin_cos(0.5 * (u - 1.0) * turn);
            let p = Point2::new(a[0] + part * (c * chord.x - s * chord.y), a[1] + part * (s * chord.x + c * chord.y));
            if ends[0].tick > 0 {
                farthest = greater(beside(p, &corners), farthest);
                nearest = lesser(scene.distance(&Footprint::disc(p, 0.11)), nearest);
            }
        }
    }
    assert!(farthest <= played.strayed && played.strayed <= farthest + 1e-3, "{farthest} {played:?}");
    assert!(played.clearance <= nearest + 1e-12 && nearest <= played.clearance + 1e-2, "{nearest} {played:?}");
    let end = last(&frames);
    assert!((played.missed - hypot(end[0] - 2.9375, end[1] - 4.0)).abs() < 1e-12, "{played:?}");
}
