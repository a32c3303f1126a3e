//! Crowds: a robot-step beside the static scan of the same robots in the same world.

use motion_lab::collision::Scene;
use motion_lab::configuration::RobotKind;
use motion_lab::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab::random::Seed;
use motion_lab::recording::Recorder;
use motion_lab::robots::RUSTY;
use motion_lab::run::{Event, RobotInput, RunDigest, Script};
use motion_lab::sensors::{RangeSensor, Scanner};
use motion_lab::simulation::Replicas;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::{Obstacle, ObstacleKind, Resident, World};

use crate::Table;
use crate::measure::{Contender, race};

const SENSOR: RangeSensor = RangeSensor { n_rays: 360, max_range: 4.0 };

/// Aisles between shelves, with a rover every two metres.
pub fn warehouse(robots: usize) -> World {
    let columns = (robots as f64 / 0.625).sqrt().ceil() as usize;
    let mut world = World::empty("warehouse", Aabb { min: Point2::new(-5.0, -5.0), max: Point2::new(2000.0, 3000.0) });
    for i in 0..robots {
        let (column, row) = (i % columns, i / columns);
        let (x, y) = (2.0 * column as f64, 3.2 * row as f64);
        world.robots.push(Resident::new(format!("rover {i}"), RobotKind::RUSTY.name, vec![x, y, (i % 6) as f64]));
        if column.is_multiple_of(5) {
            let shelf = Shape::try_rectangle(Point2::new(x, y + 1.2), Point2::new(x + 8.0, y + 2.0)).unwrap();
            world.obstacles.push(Obstacle::new(
                format!("shelf {i}"),
                ObstacleKind::Solid,
                vec![(Pose2::IDENTITY, shelf)],
            ));
        }
    }
    world
}

fn begin(robots: usize) -> (Recorder, RunDigest) {
    let world = warehouse(robots);
    let events = world.robots.iter().enumerate();
    let events = events
        .map(|(i, r)| Event { tick: 1, robot: r.name.clone(), input: RobotInput::Drive(40 + (i % 40) as i16, 128) })
        .collect();
    let script = Script { events, ..Script::empty() };
    let config = TourConfig { worlds: vec![world], ticks: 1_000_000, sensor: Some(SENSOR) };
    let recorder = Recorder::new(config.clone(), (BOOK_SEED, script.clone())).expect("the warehouse runs");
    let digest = RunDigest::new(BOOK_SEED, &config, &script, recorder.frame());
    (recorder, digest)
}

pub fn rows(table: &mut Table) {
    for robots in [10, 100, 1000, 10_000] {
        let work = format!("a robot-step among {robots} robots with a scan each");
        if !table.wants(&work) {
            continue;
        }
        let scene = Scene::of_world(&warehouse(robots));
        let (mut recorder, mut digest) = begin(robots);
        (0..20).for_each(|_| _ = recorder.step());
        let poses: Vec<Pose2> = recorder
            .frame()
            .robots
            .iter()
            .map(|r| Pose2::new(r.configuration[0], r.configuration[1], r.configuration[2]))
            .collect();
        let mut scanner = Scanner::new(SENSOR);
        let mut ranges = vec![0.0; 360 * robots];
        table.row(&work, "", || {
            let timings = race(vec![
                Contender::new("", |_| {
                    let frame = recorder.step();
                    digest.tick(frame);
                    frame.tick
                }),
                Contender::new("scan alone", |_| {
                    for (pose, ranges) in poses.iter().zip(ranges.chunks_mut(360)) {
                        scanner.scan_into(&scene, &[], pose, ranges);
                    }
                    ranges[7]
                }),
            ]);
            let contacts: u32 = recorder.frame().robots.iter().map(|r| r.contacts).sum();
            println!("  {contacts} contacts at tick {}, digest {}", recorder.frame().tick, digest.digest());
            timings.iter().map(|t| t.per(robots as f64)).collect()
        });
    }
}

/// Many runs of one robot, stepped together, beside their scans alone.
pub fn replicas(table: &mut Table) {
    let work = "a step of 1,024 replicas of Rusty in the Apartment with its scan, one thread";
    table.row(work, "<= 3x", || {
        let world = World::apartment();
        let seeds = (0..1024).map(Seed);
        let mut replicas = Replicas::new(&RUSTY, &world, &world.robots[0], Some(SENSOR), seeds).expect("they start");
        (0..200).for_each(|_| replicas.step());
        let poses: Vec<Pose2> = (0..replicas.len()).map(|i| *replicas.configuration(i)).collect();
        let scene = Scene::apartment();
        let mut scanner = Scanner::new(SENSOR);
        let mut ranges = vec![0.0; 360 * poses.len()];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        race(vec![
            Contender::new("", |_| pool.install(|| replicas.step())),
            Contender::new("scans alone", |_| {
                for (pose, ranges) in poses.iter().zip(ranges.chunks_mut(360)) {
                    scanner.scan_into(&scene, &[], pose, ranges);
                }
                ranges[7]
            }),
        ])
    });
}
