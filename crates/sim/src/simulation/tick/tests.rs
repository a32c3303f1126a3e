//! The tick among neighbours compared with the slow one, in which every robot looks at all others.

use bevy::prelude::*;

use super::hold::margin_from;
use super::settle::cut_among;
use super::swept_set::sweeps_meet;
use super::world_crowds::{WorldCrowds, with_sweep};
use crate::run::{Event, RobotInput, Script};
use crate::simulation::{
    Cut, LatestFrame, PreviousConfiguration, RobotId, RobotModel, RobotOps, Roster, SimulatedRobot, SimulationPlugin,
    TickMotion, WorldScene, start_run, step,
};
use crate::tour::TourConfig;
use motion_lab_core::collision::footprint_distance;
use motion_lab_core::configuration::{ArmSizes, HitchCfg, Sizes};
use motion_lab_core::geometry::{Aabb, Footprint, Placed, Point2, Pose2, Shape};
use motion_lab_core::num::greater;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{CarCmd, Drivable, Hitch, Motion, RUSTY, Reach, Rusty, RustyCmd};
use motion_lab_core::sensors::{RangeSensor, Scanner};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, Resident, World as WorldModel};

const SENSOR: RangeSensor = RangeSensor { n_rays: 40, max_range: 2.0 };

/// Forty rovers, cars, trailers and arms in a square of this half side, with pillars, all driven at random.
fn arena(half: f64, seed: Seed) -> (TourConfig, Script) {
    let corner = Point2::new(half, half);
    let mut world = WorldModel::empty("arena", Aabb { min: -corner, max: corner });
    let mut draws = Stream::new(seed, "arena");
    for k in 0..5 {
        let at = Pose2::new(draws.uniform(-half, half), draws.uniform(-half, half), 0.0);
        let pillar = vec![(at, Shape::Disc { radius: 0.2 })];
        world.obstacles.push(Obstacle::new(format!("pillar {k}"), ObstacleKind::Solid, pillar));
    }
    let mut events = Vec::new();
    for k in 0..40 {
        let (x, y, theta) = (draws.uniform(-half, half), draws.uniform(-half, half), draws.uniform(-3.0, 3.0));
        let (kind, start) = match k % 8 {
            0 => ("hitch", vec![x, y, theta]),
            1 => ("hitch", vec![x, y, theta, theta + 0.4]),
            2 => ("reach", vec![theta, 1.0]),
            _ => ("rusty", vec![x, y, theta]),
        };
        let mut robot = Resident::new(format!("{kind} {k}"), kind, start);
        if kind == "reach" {
            robot.sizes = Some(Sizes::Arm(ArmSizes { base: Point2::new(x, y), lengths: vec![0.7, 0.5], radius: 0.03 }));
        }
        for tick in [1, 20, 40] {
            let (a, b) = (draws.below(257) as i16 - 128, draws.below(257) as i16 - 128);
            if kind != "reach" {
                events.push(Event { tick, robot: robot.name.clone(), input: RobotInput::Drive(a, b) });
            }
        }
        world.robots.push(robot);
    }
    events.sort_by_key(|event| event.tick);
    (TourConfig { worlds: vec![world], ticks: 60, sensor: Some(SENSOR) }, Script { events, ..Script::empty() })
}

/// What a robot should have done.
type Expected = (f64, bool);

/// The footprint of a robot of one type at the start of the last tick.
fn start<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Footprint> {
    let (model, from) = (world.get::<RobotModel<R>>(e)?, world.get::<PreviousConfiguration<R>>(e)?);
    Some(model.0.fitted(&from.0).footprint(&from.0))
}

/// The cut of a robot of one type among all of these parts.
fn recut<R: SimulatedRobot>(world: &World, e: Entity, scene: &WorldScene, others: &[Placed]) -> Option<Expected> {
    let cut: Cut<R> = cut_among(&scene.0, others, world.get::<TickMotion<R>>(e)?.0.as_ref()?);
    Some((cut.until, cut.contact))
}

/// The cut that the tick made.
fn made<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Expected> {
    world.get::<Cut<R>>(e).map(|cut| (cut.until, cut.contact))
}

fn parts<'a>(footprints: impl Iterator<Item = &'a Footprint>) -> Vec<Placed> {
    footprints.flat_map(|f| f.parts().iter().map(|part| part.placed().clone())).collect()
}

/// Compares the last tick with the slow one. Returns how many robots were cut by others, and how many met one.
fn compare(world: &World) -> (usize, usize) {
    let roster = world.resource::<Roster>();
    let robots = roster.robots();
    let scene = world.get::<WorldScene>(roster.worlds()[0]).unwrap();
    let starts: Vec<Footprint> = robots
        .iter()
        .map(|&e| start::<Rusty>(world, e).or_else(|| start::<Hitch>(world, e)).or_else(|| start::<Reach<2>>(world, e)))
        .map(Option::unwrap)
        .collect();
    let frame = world.resource::<LatestFrame>().frame();
    let now: Vec<Footprint> =
        robots.iter().map(|&e| (world.get::<RobotOps>(e).unwrap().footprint)(world, e).unwrap()).collect();
    let (mut cut_by_others, mut meeting) = (0, 0);
    for (i, &e) in robots.iter().enumerate() {
        let all = parts(starts.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, start)| start));
        let recut = |others: &[Placed]| {
            recut::<Rusty>(world, e, scene, others)
                .or_else(|| recut::<Hitch>(world, e, scene, others))
                .or_else(|| recut::<Reach<2>>(world, e, scene, others))
        };
        let made = made::<Rusty>(world, e).or_else(|| made::<Hitch>(world, e)).or_else(|| made::<Reach<2>>(world, e));
        assert_eq!(made, recut(&all), "robot {i} at tick {}", frame.tick);
        cut_by_others += usize::from(made != recut(&[]));
        let mut met = false;
        with_sweep(world, i as u32, &mut |own, until| {
            for j in 0..i {
                let margin = margin_from(footprint_distance(&starts[i], &starts[j]));
                with_sweep(world, j as u32, &mut |lower, _| {
                    met |= until > 0.0 && !lower.is_still() && sweeps_meet(own, lower, margin);
                });
            }
        });
        assert_eq!(world.resource::<WorldCrowds>().has_met(RobotId(i as u32)), met, "robot {i} at tick {}", frame.tick);
        meeting += usize::from(met);
        if let Some(scan) = frame.scans.iter().find(|scan| scan.robot == i as u32) {
            let others = parts(now.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, f)| f));
            let mut ranges = vec![0.0; 40];
            let pose = Pose2 { theta: frame.robots[i].configuration[2], ..*now[i].parts()[0].pose() };
            Scanner::new(SENSOR).scan_into(&scene.0, &others, &pose, &mut ranges);
            assert_eq!(*scan.ranges, ranges, "robot {i} at tick {}", frame.tick);
        }
    }
    (cut_by_others, meeting)
}

#[test]
fn what_a_robot_cannot_reach_changes_no_bit_of_a_tick() {
    let (mut cut_by_others, mut meeting) = (0, 0);
    for (half, seed) in [(1.5, 4), (2.5, 5), (4.0, 1), (8.0, 2), (40.0, 3)] {
        let (config, script) = arena(half, Seed(seed));
        let mut app = App::new();
        app.add_plugins(SimulationPlugin);
        start_run(app.world_mut(), config, (Seed(seed), script)).unwrap();
        for _ in 0..60 {
            step(app.world_mut());
            let (cut, met) = compare(app.world());
            (cut_by_others, meeting) = (cut_by_others + cut, meeting + met);
        }
    }
    assert!(cut_by_others > 100 && meeting > 0, "{cut_by_others} {meeting}");
}

/// A proof asks what lies within the sagitta of the hull of a motion's two ends, as `Motion` says: no farther from the
/// start than an end and the sagitta. A rover's centre goes no way that its bound does not count.
#[test]
fn a_motion_reaches_all_that_its_proof_may_ask_about() {
    fn asked(motion: &impl Motion) -> f64 {
        let (from, to) = (motion.footprint_at(0.0), motion.footprint_at(1.0));
        let count = from.parts().len();
        let of_part = |k: usize| {
            let ends = from.parts()[k].placed().core().iter().zip(to.parts()[k].placed().core());
            let farthest = ends.map(|(a, b)| (b - a).norm()).fold(0.0, greater);
            farthest + motion.sagitta(k, 0.0, 1.0)
        };
        let asked = (0..count).map(of_part).fold(0.0, greater);
        let reach = super::drive::reach(motion, count);
        assert!(reach >= asked - 1e-12, "{reach} m, and up to {asked} m are asked about");
        asked
    }
    let car = motion_lab_core::robots::HITCH.with_trailer();
    let q = HitchCfg { body: Pose2::new(1.0, 2.0, 0.3), trailer: Some(0.1) };
    for (v, phi, seconds) in [(1.5, 0.6, 0.05), (1.5, -0.6, 1.0), (-1.0, 0.4, 0.5)] {
        assert!(asked(&car.drive(&q, &CarCmd { v, phi }, seconds).unwrap()) > 0.05);
    }
    // an arc of 0.3 m through a radian has a chord of 0.2877 m, and 1.2 m/s^2 over half a second stray 0.0375 m
    let arc = RUSTY.drive(&q.body, &RustyCmd { v: 0.6, omega: 2.0 }, 0.5).unwrap();
    assert!((asked(&arc) - 0.3252).abs() < 1e-4, "{}", asked(&arc));
}
