//! Worlds of many robots: opened, checked and edited at a cost that grows with their number, not with its square.

use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::atlas::{Atlas, EditShape, Editor, Op, Teleport, names};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Event, RobotInput, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use oracle::fixtures::grid;

use crate::simulator::event;

/// The warnings of a world in the plainest way: for each robot a scene with every part of every other robot.
fn plain_warnings(world: &World) -> Vec<String> {
    let standing: Vec<_> =
        world.robots.iter().map(|r| (r, AnyRobot::of_resident(r).expect("a robot of the lab"))).collect();
    let mut warnings = Vec::new();
    for (i, (resident, (robot, q))) in standing.iter().enumerate() {
        let mut scene = Scene::of_world(world);
        for (_, (other, (model, at))) in standing.iter().enumerate().filter(|(k, _)| *k != i) {
            for part in model.footprint(at).parts() {
                let placed = part.placed();
                let shape = Shape::Hull { vertices: placed.core().into(), radius: placed.radius() };
                scene = scene.with_obstacle(&other.name, shape);
            }
        }
        if let Err(refusal) = Teleport::ask_only(&Checker::new(scene, *robot), q) {
            warnings.push(format!("{} {refusal} at its start", resident.name));
        }
    }
    warnings
}

#[test]
fn the_warnings_of_a_crowd_are_those_of_each_robot_among_all_others() {
    let mut draws = Stream::new(Seed(19), "tests/crowds");
    let mut counts = [0_usize; 3];
    for round in 0..6 {
        let mut world = if round % 2 == 0 { World::apartment() } else { World::workbench() };
        let (min, max) = (world.bounds.min, world.bounds.max);
        world.robots.clear();
        for k in 0..24 {
            let (x, y, theta) = (draws.uniform(min.x, max.x), draws.uniform(min.y, max.y), draws.uniform(-3.0, 3.0));
            let (kind, start) = match k % 4 {
                0 => ("hitch", vec![x, y, theta, theta + 0.3]),
                1 if round % 2 == 1 => ("reach3", vec![theta, 0.3, -0.4]),
                _ => ("rusty", vec![x, y, theta]),
            };
            world.robots.push(Resident::new(format!("robot {k}"), kind, start));
        }
        // two that touch exactly: rovers a diameter apart, where nothing else is
        let x = max.x + 20.0;
        world.bounds.max.x = x + 1.0;
        world.robots.push(Resident::new("left", "rusty", [x, 0.0, 0.0]));
        world.robots.push(Resident::new("right", "rusty", [x + 0.22, 0.0, 0.0]));
        let plain = plain_warnings(&world);
        assert_eq!(Editor::new(world.clone()).warnings(), plain);
        counts[0] += plain.len();
        counts[1] += plain.iter().filter(|w| w.contains(" and ")).count();
        counts[2] += usize::from(plain.contains(&"left would overlap right at its start".to_owned()));
    }
    assert!(counts[0] > 40 && counts[1] > 10 && counts[2] > 0, "too little was met: {counts:?}");
}

/// The number of heap allocations in `work`.
fn allocations(work: impl FnOnce()) -> u64 {
    allocation_counter::measure(work).count_total
}

#[test]
fn opening_checking_and_editing_four_times_as_many_robots_costs_about_four_times_as_much() {
    type Work = (&'static str, fn(&str, usize));
    let works: [Work; 5] = [
        ("open and warn", |text, _| {
            let editor = Editor::open("crowd.ron", text).unwrap();
            assert!(editor.warnings().is_empty());
        }),
        ("edit", |text, n| {
            let mut editor = Editor::open("crowd.ron", text).unwrap();
            let disc = EditShape::Disc { centre: Point2::new(0.0, 0.0), radius: 0.05 };
            let name = editor.free_name("rover 7");
            assert_eq!(name, "rover 7 2");
            editor.apply(&Op::Add { name, shape: disc }).unwrap();
            editor.apply(&Op::Rename { name: format!("rover {}", n - 1), to: "the last".into() }).unwrap();
            assert_eq!(editor.warnings(), ["rover 0 would overlap rover 7 2 at its start"]);
        }),
        ("teleport in the atlas", |text, n| {
            let mut atlas = Atlas::new(World::parse("crowd.ron", text).unwrap());
            let to = atlas.robots()[n - 1].q.with(0, 0.0).with(1, 0.0);
            let refusal = Teleport::ask_only(&atlas.checker(n - 1).unwrap(), &to).unwrap_err();
            assert_eq!(refusal.to_string(), "would overlap rover 0");
            let beside = to.with(0, 0.4);
            assert_eq!(atlas.teleport(n - 1, beside), Some(Ok(())));
            assert_eq!(atlas.from_here().robots[n - 1].start[..2], [0.4, 0.0]);
            assert_eq!(atlas.others().count(), 0);
        }),
        ("labels", |text, n| {
            let atlas = Atlas::new(World::parse("crowd.ron", text).unwrap());
            assert_eq!(names(&atlas, 400.0).len(), 2 * (n + n / 20), "each has its label and its leader");
        }),
        ("start", |text, n| {
            let world = World::parse("crowd.ron", text).unwrap();
            let config = TourConfig { worlds: vec![world], ticks: 1, sensor: None };
            let events: Vec<Event> = (0..n).map(|k| event(1, &format!("rover {k}"), RobotInput::Drive(1, 1))).collect();
            let run = Recorder::new(config, (BOOK_SEED, Script::new(events, vec![]))).unwrap();
            assert_eq!(run.frame().robots.len(), n);
        }),
    ];
    for (what, work) in works {
        let [few, many] = [200, 800].map(|n| {
            let text = grid(n, 20);
            allocations(|| work(&text, n))
        });
        assert!(many > few && many < 6 * few, "{what}: {few} allocations for 200 robots, {many} for 800");
    }
}

#[test]
fn an_input_reaches_the_robot_of_its_name_among_many() {
    let world = World::parse("crowd.ron", &grid(60, 20)).unwrap();
    let config = TourConfig { worlds: vec![world], ticks: 3, sensor: None };
    let events = vec![
        event(1, "rover 41", RobotInput::Drive(128, 0)),
        event(2, "rover 7", RobotInput::Drive(64, 0)),
        // behind the wall, where nobody stands, and onto rover 0, which is refused
        event(2, "rover 59", RobotInput::Teleport(crate::simulator::quantized(&[19.0, 2.875, 0.0]))),
        event(2, "rover 58", RobotInput::Teleport(crate::simulator::quantized(&[0.0, 0.1, 0.0]))),
    ];
    let mut run = Recorder::new(config, (BOOK_SEED, Script::new(events, vec![]))).unwrap();
    (0..3).for_each(|_| _ = run.step());
    for (id, robot) in run.frame().robots.iter().enumerate() {
        let channels = match id {
            41 => [128, 0],
            7 => [64, 0],
            _ => [0, 0],
        };
        assert_eq!((robot.channels, robot.manual), (channels, [7, 41, 59].contains(&id)), "rover {id}");
        assert_eq!(robot.refusals, u32::from(id == 58), "rover {id}");
    }
    assert!((run.frame().robots[59].configuration[1] - 2.875).abs() < 1e-9);
}
