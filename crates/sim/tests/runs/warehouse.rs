//! Generated warehouses in runs: everybody moves, and nobody comes near anybody, by shapes and distances of the tests'
//! own.

use motion_lab_core::configuration::{ArmSizes, Sizes};
use motion_lab_core::geometry::{Aabb, Placed, Vertices};
use motion_lab_core::num;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::HITCH;
use motion_lab_core::worlds::{Resident, Route, Warehouse, World};
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{Frame, Log};
use motion_lab_sim::simulation::{Extra, SimulatedRobot};
use motion_lab_sim::tour::{RouteTours, TourConfig, Touring};

use oracle::fixtures::count_from_env;
use oracle::plain;

/// What everybody keeps from everything, metres.
const APART: f64 = 0.05;

fn warehouse(robots: usize, trailers: bool) -> World {
    Warehouse { seed: Seed(5), robots, trailers }.world().unwrap()
}

fn record(world: World, ticks: u64) -> Log {
    Run::record(TourConfig { worlds: vec![world], ticks, sensor: None }, Seed(3)).unwrap()
}

/// A rectangle in the frame of a pose, from `back` to `front` ahead of it and `half` to either side.
fn rectangle([x, y, theta]: [f64; 3], [back, front]: [f64; 2], half: f64) -> Placed {
    let (sin, cos) = num::sin_cos(theta);
    let corner = |u: f64, v: f64| Point2::new(x + u * cos - v * sin, y + u * sin + v * cos);
    let corners = [corner(back, -half), corner(front, -half), corner(front, half), corner(back, half)];
    Placed::new(Vertices::from_slice(&corners), 0.0)
}

/// What a robot of a warehouse covers, by its name and coordinates, with the sizes that the warehouse gives it.
fn covered(world: &World, id: usize, q: &[f64]) -> Vec<Placed> {
    let robot = &world.robots[id];
    let p = Point2::new(q[0], q[1]);
    match robot.name.split(' ').next().unwrap() {
        "rover" => vec![Placed::new(Vertices::from_slice(&[p]), 0.11)],
        "car" => {
            let mut parts = vec![rectangle([p.x, p.y, q[2]], [-0.3, 1.5], 0.45)];
            parts.extend(q.get(3).map(|&psi| rectangle([p.x, p.y, psi], [-1.8, -0.8], 0.4)));
            parts
        }
        "arm" => {
            let Some(Sizes::Arm(ArmSizes { base, .. })) = robot.sizes else { panic!("{robot:?} says no base") };
            let along = |from: Point2, theta: f64, length: f64| {
                let (sin, cos) = num::sin_cos(theta);
                Point2::new(from.x + length * cos, from.y + length * sin)
            };
            let elbow = along(base, q[0], 0.5);
            let tip = along(elbow, q[0] + q[1], 0.4);
            [[base, elbow], [elbow, tip]].map(|link| Placed::new(Vertices::from_slice(&link), 0.03)).to_vec()
        }
        other => panic!("{other}"),
    }
}

fn middle(part: &Placed) -> Point2 {
    let sum = part.core().iter().fold((0.0, 0.0), |(x, y), p| (x + p.x, y + p.y));
    Point2::new(sum.0 / part.core().len() as f64, sum.1 / part.core().len() as f64)
}

/// The least distance between two robots, and between a robot and an obstacle, where it is below 1 m. No part reaches
/// 1.5 m from its middle, so what is 4 m from there is not asked.
fn least_distances(world: &World, frame: &Frame, obstacles: &[Placed]) -> [f64; 2] {
    let mut parts: Vec<(usize, Placed, Point2)> = frame
        .robots
        .iter()
        .enumerate()
        .flat_map(|(id, state)| covered(world, id, &state.configuration).into_iter().map(move |part| (id, part)))
        .map(|(id, part)| (id, part.clone(), middle(&part)))
        .collect();
    parts.sort_by(|(_, _, a), (_, _, b)| a.x.total_cmp(&b.x));
    let mut least = [f64::INFINITY; 2];
    for (i, (id, part, at)) in parts.iter().enumerate() {
        for (other_id, other, other_at) in parts[..i].iter().rev().take_while(|(_, _, other)| at.x - other.x < 4.0) {
            if id != other_id && (other_at - at).norm() < 4.0 {
                least[0] = num::lesser(least[0], plain::distance(part, other));
            }
        }
        for obstacle in obstacles {
            let Aabb { min, max } = obstacle.bounds();
            if min.x - 4.0 < at.x && at.x < max.x + 4.0 && min.y - 4.0 < at.y && at.y < max.y + 4.0 {
                least[1] = num::lesser(least[1], plain::distance(part, obstacle));
            }
        }
    }
    least
}

#[test]
fn nobody_comes_near_anybody_and_everybody_moves() {
    for (robots, trailers, ticks) in [(80, true, 260), (150, false, 120)] {
        let world = warehouse(robots, trailers);
        let obstacles: Vec<Placed> = world.obstacles.iter().flat_map(|o| o.placed()).collect();
        let log = record(world.clone(), ticks);
        let mut least = [f64::INFINITY; 2];
        for frame in
            std::iter::once(log.initial().unwrap()).chain(log.frames().iter().filter(|f| f.tick.is_multiple_of(10)))
        {
            let found = least_distances(&world, frame, &obstacles);
            assert!(found.iter().all(|d| *d >= APART), "tick {}: {found:?}", frame.tick);
            least = [num::lesser(least[0], found[0]), num::lesser(least[1], found[1])];
        }
        assert!(least.iter().all(|d| *d < 1.0), "{least:?}: this test no longer sees who is next to whom");
        let last = log.frames().last().unwrap();
        for (id, robot) in world.robots.iter().enumerate() {
            let state = &last.robots[id];
            assert!(state.contacts == 0 && !state.in_contact, "{} touches something", robot.name);
            let at = |frame: &Frame| frame.robots[id].configuration.clone();
            let frames: Vec<&Frame> = std::iter::once(log.initial().unwrap()).chain(log.frames()).collect();
            let steps = frames.windows(2).map(|f| {
                let (a, b) = (at(f[0]), at(f[1]));
                num::hypot(b[0] - a[0], b[1] - a[1])
            });
            let way: f64 = steps.sum();
            let time = 0.05 * ticks as f64;
            let Some(route) = world.routes.iter().find(|r| Some(&r.name) == robot.route.as_ref()) else {
                assert!(way > 0.2 * time, "{} swings by {way} rad in {time} s", robot.name);
                continue;
            };
            // a seed takes nine tenths of a route's speed or more; corners of slipping wheels add or take a little
            let (low, high) = (0.88 * route.speed * time, 1.02 * route.speed * time);
            assert!((low..high).contains(&way), "{} goes {way} m in {time} s at {}", robot.name, route.speed);
        }
    }
}

/// A thousand robots, for a second, or for an hour with MOTION_LAB_TICKS=72000.
#[test]
fn a_thousand_robots_go_on_without_an_overlap() {
    let ticks = count_from_env("MOTION_LAB_TICKS", 20);
    let world = warehouse(1000, true);
    let obstacles: Vec<Placed> = world.obstacles.iter().flat_map(|o| o.placed()).collect();
    let config = TourConfig { worlds: vec![world.clone()], ticks, sensor: None };
    let mut run = Recorder::new(config, Seed(3)).unwrap().without_keyframes();
    let mut least = least_distances(&world, run.frame(), &obstacles);
    while !run.is_complete() {
        let frame = run.step();
        let found = least_distances(&world, frame, &obstacles);
        assert!(found.iter().all(|d| *d >= APART), "tick {}: {found:?}", frame.tick);
        assert!(frame.robots.iter().all(|robot| robot.contacts == 0), "tick {}: somebody was held", frame.tick);
        least = [num::lesser(least[0], found[0]), num::lesser(least[1], found[1])];
    }
    println!(
        "{ticks} ticks: no two robots nearer than {} m, none nearer than {} m to anything else",
        least[0], least[1]
    );
    assert!(least.iter().all(|d| *d < 1.0), "{least:?}: this test no longer sees who is next to whom");
}

/// Ten minutes of a small one: wheels slip by up to 5 % in every tick, and the rovers keep to their lines all the same.
#[test]
fn slipping_rovers_keep_to_their_routes() {
    let world = warehouse(10, true);
    let paths: Vec<_> = world.routes.iter().map(|r| (r.name.clone(), r.path().unwrap())).collect();
    let log = record(world.clone(), 12_000);
    let mut farthest = [0.0, 0.0];
    for frame in log.frames() {
        for (robot, state) in world.robots.iter().zip(&frame.robots) {
            let Some((_, path)) = paths.iter().find(|(name, _)| Some(name) == robot.route.as_ref()) else { continue };
            let at = Point2::new(state.configuration[0], state.configuration[1]);
            let off = (path.at(path.nearest(at)).position() - at).norm();
            let kind = usize::from(robot.name.starts_with("car"));
            farthest[kind] = num::greater(farthest[kind], off);
            assert_eq!(state.contacts, 0, "{} at tick {}", robot.name, frame.tick);
        }
    }
    assert!(farthest[0] < 0.05 && farthest[1] < 0.005, "{farthest:?} m off the routes");
    assert!(farthest[0] > 0.002, "wheels do slip: {farthest:?}");
}

#[test]
fn a_log_holds_the_routes_and_verifies() {
    let log = record(warehouse(12, true), 40);
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).unwrap();
    let read = Log::read_mcap(&bytes).unwrap().log;
    assert!(read.recipe.config == log.recipe.config && read.recipe.config.worlds[0].robots[0].route.is_some());
    assert!(verify(&read, |_| {}).unwrap().difference.is_none());
    // the same robots without their routes do something else
    let mut world = log.recipe.config.worlds[0].clone();
    world.robots.iter_mut().for_each(|r| r.route = None);
    let without = record(world, 40);
    let at = |log: &Log, id: usize| log.frames()[39].robots[id].configuration.clone();
    let start = |id: usize| log.initial().unwrap().robots[id].configuration.clone();
    for (id, robot) in log.recipe.config.worlds[0].robots.iter().enumerate() {
        assert_eq!(at(&log, id) == at(&without, id), robot.name.starts_with("arm"), "{}", robot.name);
        assert_eq!(at(&without, id) == start(id), robot.name.starts_with("rover"), "{} has no tour", robot.name);
    }
}

/// Worlds made in code, which no parser has checked.
#[test]
fn a_run_on_a_route_that_cannot_be_followed_does_not_start() {
    let corners = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)].map(|(x, y)| Point2::new(x, y));
    let start = |kind: &str, q: &[f64], route: Route| {
        let mut world = warehouse(10, false);
        world.robots = vec![Resident::new("it", kind, q).with_route("round")];
        world.routes = vec![route];
        Run::record(TourConfig { worlds: vec![world], ticks: 1, sensor: None }, Seed(1)).err().map(|e| e.to_string())
    };
    let round = Route { name: "round".into(), points: corners.to_vec(), radius: 5.0, speed: 0.54 };
    let faster = Route { speed: 0.541, ..round.clone() };
    let (rover, car, arm) = ([20.0, 0.0, 0.0], [20.0, 0.0, 0.0], [0.0, 0.0]);
    assert_eq!(start("rusty", &rover, round.clone()), None, "nine tenths of 0.6 m/s");
    let refused = start("rusty", &rover, faster.clone()).unwrap();
    assert!(refused.ends_with("a rusty cannot follow the route \"round\" at 0.541 m/s"), "{refused}");
    assert_eq!(start("hitch", &car, faster), None, "a car is faster");
    assert!(start("reach", &arm, round.clone()).unwrap().contains("a reach cannot follow"));
    let lost = start("rusty", &rover, Route { name: "square".into(), ..round.clone() }).unwrap();
    assert!(lost.ends_with("robot \"it\" in world \"Warehouse of 10, seed 5\": there is no route \"round\""), "{lost}");
    let sharp = start("rusty", &rover, Route { radius: 25.0, ..round }).unwrap();
    assert!(sharp.contains("route \"round\" in world \"Warehouse of 10, seed 5\": from points[0] on"), "{sharp}");
}

/// An error of the law falls as `(1 + k s) exp(-k s)` over s metres, since it is critically damped. A car's k is one
/// over its wheelbase, so that 2 / e of the error are left after a wheelbase, and 4 / e^3 after three.
#[test]
fn a_car_beside_its_route_comes_back_to_it_as_its_wheelbase_says() {
    let corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 12.0), (0.0, 12.0)].map(|(x, y)| Point2::new(x, y));
    let route = Route { name: "round".into(), points: corners.to_vec(), radius: 5.0, speed: 0.5 };
    let world = World { routes: vec![route], ..World::empty("w", Aabb { min: corners[0], max: corners[2] }) };
    let tour = RouteTours::of_world(&world, Seed(3)).unwrap().get("round").unwrap().starting_at(Point2::new(10.0, 0.0));
    let touring = Touring::Route(tour);
    let mut q = HitchCfg { body: Pose2::new(10.0, 0.01, 0.0), trailer: None };
    let (mut tick, mut left) = (0, vec![]);
    for wheelbases in [1.0, 3.0] {
        while q.body.x < 10.0 + wheelbases * HITCH.wheelbase {
            tick += 1;
            let control = HITCH.touring(&touring, tick, 0.05, &q, &mut Extra::default());
            q = HITCH.step(&q, &control, 0.05).unwrap();
        }
        left.push(q.body.y / 0.01);
    }
    let expected = [2.0 * num::exp(-1.0), 4.0 * num::exp(-3.0)];
    assert!(
        left.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 0.02),
        "{left:?} {expected:?}"
    );
}
