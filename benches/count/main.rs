//! Fixed work for `benches/instructions`, which counts the instructions it takes: `count KERNEL TIMES`.
#![allow(missing_docs, dead_code, clippy::unwrap_used, clippy::expect_used, clippy::disallowed_methods)]

#[path = "../table/pairs.rs"]
mod pairs;
#[path = "../table/worlds.rs"]
mod worlds;

use std::hint::black_box;

use motion_lab::collision::{ChainChecker, Checker, Collision, Scene};
use motion_lab::planning::{Bounds, RrtConnect, solve};
use motion_lab::prelude::*;
use motion_lab::recording::Recorder;
use motion_lab::robots::RUSTY;
use motion_lab::sensors::{Instructions, RangeSensor, Scanner};
use motion_lab::simulation::Replicas;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::World;

use pairs::Pairs;

/// Scans of a square hall, with the baseline instructions so that every machine counts the same, or with AVX2.
fn hall(instructions: Instructions, times: usize) {
    scans(&worlds::walls(40, 8.0, 2.0), 8.0, 4.0, instructions, times);
}

/// The same among a thousand walls.
fn yard(instructions: Instructions, times: usize) {
    scans(&worlds::walls(1_000, 12.6, 1.0), 12.6, 12.0, instructions, times);
}

/// The same among ten thousand.
fn field(instructions: Instructions, times: usize) {
    scans(&worlds::walls(10_000, 40.0, 1.0), 40.0, 12.0, instructions, times);
}

fn scans(scene: &Scene, side: f64, max_range: f64, instructions: Instructions, times: usize) {
    let poses = worlds::free_points(scene, 0.3 * side, 0.7 * side);
    let mut scanner = Scanner::with_instructions(RangeSensor { n_rays: 360, max_range }, instructions);
    let mut ranges = [0.0; 360];
    for pose in poses.iter().cycle().take(times) {
        scanner.scan_into(scene, &[], pose, &mut ranges);
        black_box(&ranges);
    }
}

/// Scans of the Apartment by a robot that drives round and round it, 3 cm a tick.
fn apartment(instructions: Instructions, times: usize) {
    let scene = Scene::apartment();
    let mut scanner = Scanner::with_instructions(RangeSensor { n_rays: 360, max_range: 4.0 }, instructions);
    let mut ranges = [0.0; 360];
    // a rectangle of 32 m, through walls and doors: where it is in a wall there is no scan
    let (width, height) = (10.0, 6.0);
    let poses = (0_u32..).filter_map(|k| {
        let way = (0.03 * f64::from(k)) % (2.0 * (width + height));
        let (x, y, theta) = match way {
            w if w < width => (w, 0.0, 0.1),
            w if w < width + height => (width, w - width, 1.7),
            w if w < 2.0 * width + height => (2.0 * width + height - w, height, -3.0),
            w => (0.0, 2.0 * (width + height) - w, -1.4),
        };
        let pose = Pose2::new(1.0 + x, 1.0 + y, theta);
        (!scene.intersects(&Footprint::disc(pose.position(), 0.11))).then_some(pose)
    });
    for pose in poses.take(times) {
        scanner.scan_into(&scene, &[], &pose, &mut ranges);
        black_box(&ranges);
    }
}

fn arms(times: usize, ask: impl Fn(&Checker<Reach<2>>, &T2, &T2)) {
    let checker = Checker::new(worlds::boxes(100, 0.2), Reach::<2>::workbench());
    let mut s = worlds::draws("count");
    let mut draw = || T2::new(s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0));
    for _ in 0..times {
        let a = draw();
        ask(&checker, &a, &T2::new(a.0[0] + 0.3, a.0[1] - 0.2));
    }
}

/// Edges between free configurations, as in the table, asked whether they are free, or also how near they come.
fn edges<R: Robot>(asked: &str, Pairs { checker, pairs }: &Pairs<R>, times: usize) {
    for [a, b] in pairs.iter().cycle().take(times) {
        match asked {
            "free" => _ = black_box(checker.edge_free(a, b)),
            _ => _ = black_box(checker.edge(a, b)),
        }
    }
}

/// The arm's scene of this number of obstacles.
fn arm_scene(obstacles: usize) -> Scene {
    let scene = worlds::arm_scenes().into_iter().find(|(n, _)| *n == obstacles);
    scene.unwrap_or_else(|| panic!("no scene of the arm has {obstacles} obstacles")).1
}

/// Distances of an arm from what it does not meet, with their witnesses.
fn witnesses(obstacles: usize, times: usize) {
    let scene = arm_scene(obstacles);
    for footprint in pairs::free_arms(&scene).iter().cycle().take(times) {
        _ = black_box(scene.witness(footprint));
    }
}

/// A car's drives of a second in the Lot, integrated, free or not.
fn drives(car: Hitch, times: usize) {
    let (lot, drives) = pairs::drives(car);
    for (q, u, _) in drives.iter().cycle().take(times) {
        black_box(car.drive(q, u, 1.0).is_ok_and(|arc| lot.motion_free(&arc)));
    }
}

/// Steps of 64 replicas of Rusty in the Apartment, which have driven for 200 steps before, with a scan or without.
fn replicas(sensor: Option<RangeSensor>, times: usize) {
    let world = World::apartment();
    let mut replicas = Replicas::new(&RUSTY, &world, &world.robots[0], sensor, (0..64).map(Seed)).expect("they start");
    (0..200 + times / replicas.len()).for_each(|_| replicas.step());
    black_box(replicas.configuration(0));
}

/// Plans of the arm round the workbench's post, with a seed each, from the start to the certified path.
fn plans(times: usize) {
    for seed in 0..times as u64 {
        let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
        let problem = Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(seed)).expect("free ends");
        black_box(solve(&mut RrtConnect::new(problem), &Bounds::default()).expect("there is a way"));
    }
}

fn discs(times: usize) {
    (0..times).for_each(|i| _ = black_box(Footprint::disc(Point2::new(i as f64, 1.0), black_box(0.11))));
}

fn arms_places(times: usize) {
    let arm = Reach::<2>::workbench();
    (0..times).for_each(|i| _ = black_box(arm.footprint(&T2::new(black_box(i as f64 * 1e-3), 1.0))));
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let kernel = arguments.next().unwrap_or_default();
    let times = arguments.next().and_then(|n| n.parse().ok()).expect("how many times");
    // the last word may be a number of obstacles
    let (named, obstacles) = match kernel.rsplit_once('-').map(|(named, n)| (named, n.parse())) {
        Some((named, Ok(obstacles))) => (named, obstacles),
        _ => (kernel.as_str(), 0),
    };
    let asked = named.split('-').next().unwrap_or_default();
    match named {
        "scan-hall" => hall(Instructions::Baseline, times),
        "scan-yard" => yard(Instructions::Baseline, times),
        "scan-field" => field(Instructions::Baseline, times),
        "scan-apartment" => apartment(Instructions::Baseline, times),
        "scan-hall-avx2" => hall(Instructions::Avx2, times),
        "scan-yard-avx2" => yard(Instructions::Avx2, times),
        "scan-field-avx2" => field(Instructions::Avx2, times),
        "scan-apartment-avx2" => apartment(Instructions::Avx2, times),
        "disc" => discs(times),
        "arm" => arms_places(times),
        "witness" => arms(times, |c, a, _| _ = black_box(c.scene().witness(&c.robot().footprint(a)))),
        "edge" => arms(times, |c, a, b| _ = black_box(c.edge(a, b))),
        "free" => arms(times, |c, a, b| _ = black_box(c.edge_free(a, b))),
        "witness-arm" => witnesses(obstacles, times),
        "free-disc" | "edge-disc" => edges(asked, &pairs::disc(worlds::walls(40, 8.0, 2.0), 8.0), times),
        "free-arm" | "edge-arm" => edges(asked, &pairs::arm(arm_scene(obstacles)), times),
        "free-car" | "edge-car" => edges(asked, &pairs::car(worlds::boxes(obstacles, 0.0)), times),
        "drive-car" => drives(HITCH, times),
        "drive-trailer" => drives(HITCH.with_trailer(), times),
        "replica" => replicas(Some(RangeSensor { n_rays: 360, max_range: 4.0 }), times),
        "replica-blind" => replicas(None, times),
        "plan" => plans(times),
        "tick" => {
            let mut recorder = Recorder::new(TourConfig::default(), BOOK_SEED).expect("the tour runs");
            (0..times).for_each(|_| _ = black_box(recorder.step().tick));
        }
        _ => panic!("no kernel is named {kernel:?}"),
    }
}
