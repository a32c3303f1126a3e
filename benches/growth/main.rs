//! How what is built and changed grows with the number of its segments: each work at sizes ten times apart, and the
//! exponent from the last size but one to the last, 1 where ten times as much takes ten times as long.
//!
//! `cargo bench --no-default-features --features headless --bench growth`
#![allow(missing_docs, dead_code, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout)]

#[path = "../table/worlds.rs"]
mod worlds;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use allocation_counter::measure;
use motion_lab::atlas::{EditShape, Editor, Op};
use motion_lab::collision::{Checker, Scene};
use motion_lab::configuration::AnyConfiguration;
use motion_lab::cspace::{CellMap, Slice};
use motion_lab::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab::num;
use motion_lab::random::Seed;
use motion_lab::recording::Recorder;
use motion_lab::robots::{AnyRobot, RUSTY};
use motion_lab::run::{Frame, Log, LogKind, LogWriter, Quantized, Recipe, Script, WorldChange, WorldEvent};
use motion_lab::sensors::{RangeSensor, Scanner};
use motion_lab::tour::TourConfig;
use motion_lab::worlds::{Obstacle, ObstacleKind, World, convex_pieces};

/// The least seconds of three times, or of one that takes long.
fn seconds<T>(mut work: impl FnMut() -> T) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let begun = Instant::now();
        black_box(work());
        least = num::lesser(least, begun.elapsed().as_secs_f64());
        if least > 2.0 {
            break;
        }
    }
    least
}

/// A time in the unit that suits it.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.3} us", s * 1e6),
        s if s < 1.0 => format!("{:.3} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}

/// Prints a work at its sizes, and how it grows from the last but one to the last.
fn row(what: &str, sizes: &[usize], shown: impl Fn(f64) -> String, mut value: impl FnMut(usize) -> f64) {
    let values: Vec<f64> = sizes.iter().map(|&size| value(size)).collect();
    let of = |at: usize| (sizes[at] as f64, values[at]);
    let ((n, a), (m, b)) = (of(sizes.len() - 2), of(sizes.len() - 1));
    let exponent = num::ln(b / a) / num::ln(m / n);
    let mut cells: Vec<String> = values.into_iter().map(&shown).collect();
    cells.resize(5, String::new());
    println!("| {what} | {} | {exponent:.2} |", cells.join(" | "));
}

/// A world of boxes of 0.4 m, a metre apart.
fn yard(count: usize) -> World {
    let columns = (count as f64).sqrt().ceil() as usize;
    let boxes = (0..count).map(|i| {
        let (x, y) = ((i % columns) as f64, (i / columns) as f64);
        let shape = Shape::try_rectangle(Point2::new(x + 0.3, y + 0.3), Point2::new(x + 0.7, y + 0.7)).expect("a box");
        Obstacle::new(format!("box {i}"), ObstacleKind::Solid, vec![(Pose2::IDENTITY, shape)])
    });
    let corner = columns as f64;
    World {
        name: "yard".into(),
        bounds: Aabb { min: Point2::origin(), max: Point2::new(corner, corner) },
        obstacles: boxes.collect(),
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots: vec![],
    }
}

/// A run of 30 s in which this many obstacles are added, the same number in each tick.
fn adding(count: usize) -> Recipe {
    let world = World::apartment();
    let at = |x: f64| Quantized::try_new(x).expect("a number in range");
    let columns = (count as f64).sqrt().ceil() as usize;
    let changes = (0..count).map(|i| {
        let (x, y) = (1000.0 + (i % columns) as f64, (i / columns) as f64);
        let points = vec![(at(x), at(y)), (at(x + 0.4), at(y)), (at(x), at(y + 0.4))];
        let change = WorldChange::Add { name: format!("added {i}"), points, radius: at(0.0) };
        WorldEvent { tick: 1 + (i * 600 / count) as u64, world: world.name.clone(), change }
    });
    let script = Script::new(vec![], changes.collect());
    Recipe::new(TourConfig { worlds: vec![world.clone()], ticks: 600, sensor: None }, (Seed(1), script))
}

/// Runs a recipe to its end.
fn run(recipe: &Recipe, mut tick: impl FnMut(&Frame)) {
    let mut run = Recorder::of(recipe).expect("it starts");
    (0..600).for_each(|_| tick(black_box(run.step())));
}

/// The bytes of the log of a recipe.
fn log_of(recipe: &Recipe) -> Vec<u8> {
    let start = Recorder::of(recipe).expect("it starts");
    let mut writer = LogWriter::new(Vec::new(), recipe, LogKind::Frames, start.frame()).expect("a run");
    run(recipe, |frame| writer.tick(frame).expect("the next"));
    writer.finish().expect("a whole run")
}

/// A star of this many corners.
fn star(corners: usize) -> Vec<Point2> {
    let corner = |i: usize| {
        let (sin, cos) = num::sin_cos(TAU * i as f64 / corners as f64);
        let radius = [50.0, 30.0][i % 2];
        Point2::new(radius * cos, radius * sin)
    };
    (0..corners).map(corner).collect()
}

fn main() {
    println!("| work | 100 | 1,000 | 10,000 | 100,000 | 1,000,000 | exponent |\n|---|---|---|---|---|---|---|");
    let sizes = [100, 1_000, 10_000, 100_000, 1_000_000];
    let side = |count: usize| (count as f64).sqrt();
    row("a scene of walls is built", &sizes, time, |count| {
        let walls = worlds::wall_segments(count, side(count), 1.0);
        seconds(|| Scene::of_walls(&walls))
    });
    row(
        "its memory",
        &sizes,
        |bytes| format!("{:.2} MB", bytes / 1e6),
        |count| {
            let walls = worlds::wall_segments(count, side(count), 1.0);
            let mut made = None;
            measure(|| made = Some(Scene::of_walls(&walls))).bytes_current as f64
        },
    );
    row("a scan of 360 rays, 12 m", &sizes, time, |count| {
        let scene = worlds::walls(count, side(count), 1.0);
        let mut scanner = Scanner::new(RangeSensor { n_rays: 360, max_range: 12.0 });
        let mut ranges = [0.0; 360];
        let poses = worlds::free_points(&scene, 0.4 * side(count), 0.6 * side(count));
        let all = seconds(|| poses.iter().for_each(|pose| scanner.scan_into(&scene, &[], pose, &mut ranges)));
        all / poses.len() as f64
    });
    row("a rover's configuration space, proven in cells to a 256th", &sizes[..4], time, |count| {
        let checker = Checker::new(Scene::of_world(&yard(count)), AnyRobot::Rusty(RUSTY));
        let at = AnyConfiguration::Pose(Pose2::new(0.0, 0.0, 0.0));
        seconds(|| {
            let mut map = CellMap::new(Slice::through(&checker, &at).expect("a plane"), 8);
            while map.refine(u32::MAX) {}
        })
    });
    row("a world file is read", &sizes[..4], time, |count| {
        let text = yard(count).to_ron();
        seconds(|| World::parse("yard.ron", &text).expect("a world"))
    });
    row("the editor moves a box of a world", &sizes[..4], time, |count| {
        let editor = Editor::new(yard(count));
        let op = Op::Move { name: "box 7".into(), by: Point2::new(0.1, 0.0).coords };
        seconds(|| editor.preview(&op).expect("there is room"))
    });
    row("the editor adds a box to it", &sizes[..4], time, |count| {
        // a world holds no more than 100,000
        let editor = Editor::new(yard(count - 1));
        let shape = EditShape::Box { min: Point2::new(0.0, 0.0), max: Point2::new(0.2, 0.2) };
        let op = Op::Add { name: "another".into(), shape };
        seconds(|| editor.preview(&op).expect("there is room"))
    });
    row("a run of 30 s in which so many obstacles are added", &sizes[..3], time, |count| {
        let recipe = adding(count);
        seconds(|| run(&recipe, |_| ()))
    });
    let megabytes = |bytes: f64| format!("{:.2} MB", bytes / 1e6);
    row("its log, a file", &sizes[..3], megabytes, |count| log_of(&adding(count)).len() as f64);
    row("its log, read into memory", &sizes[..3], megabytes, |count| {
        let (file, mut read) = (log_of(&adding(count)), None);
        measure(|| read = Some(Log::read_mcap(&file).expect("a log"))).bytes_current as f64
    });
    row("a star of 10, 100 and 1,000 corners is cut up", &[10, 100, 1_000], time, |count| {
        let outline = star(count);
        seconds(|| convex_pieces(&outline).expect("a simple polygon"))
    });
}
