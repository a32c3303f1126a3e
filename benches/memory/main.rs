//! The heap that scenes, robots and frames take, and the bytes of a log, by a counting allocator: the same numbers at
//! every run.
//!
//! `cargo bench --no-default-features --features headless --bench memory`
#![allow(missing_docs, dead_code, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout)]

#[path = "../table/worlds.rs"]
mod worlds;

use allocation_counter::measure;
use motion_lab::collision::Scene;
use motion_lab::random::Seed;
use motion_lab::recording::{Recorder, Run};
use motion_lab::run::{LogKind, LogWriter};
use motion_lab::sensors::RangeSensor;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::Warehouse;

/// The bytes that stay allocated for what `make` returns.
fn kept<T>(make: impl FnOnce() -> T) -> f64 {
    let mut made = None;
    let info = measure(|| made = Some(make()));
    drop(made);
    info.bytes_current as f64
}

/// A run of this number of robots after a few ticks, without keyframes. In its warehouse every fifth robot has no range
/// sensor.
fn crowd(robots: usize) -> Recorder {
    let world = Warehouse { seed: Seed(1), robots, trailers: false }.world().expect("a number in range");
    let sensor = Some(RangeSensor { n_rays: 360, max_range: 4.0 });
    let config = TourConfig { worlds: vec![world], ticks: 1_000_000, sensor };
    let mut recorder = Recorder::new(config, BOOK_SEED).expect("the warehouse runs").without_keyframes();
    (0..5).for_each(|_| _ = recorder.step());
    recorder
}

fn say(what: &str, bytes: f64) {
    println!("| {what} | {bytes:.0} bytes |");
}

fn main() {
    println!("| what | takes |\n|---|---|");
    for count in [100, 10_000] {
        let side = (count as f64).sqrt();
        let walls = |count| kept(|| worlds::walls(count, side, 1.0));
        say(&format!("a wall in a scene of {count}"), walls(count) / count as f64);
        let boxes = |count| kept(|| worlds::boxes(count, 0.2));
        say(&format!("a box in a scene of {count}"), boxes(count) / count as f64);
    }
    say("the scene of the Apartment", kept(Scene::apartment));
    let [few, many] = [1_000, 10_000].map(|robots| kept(|| crowd(robots)));
    say("a robot of a warehouse, with its scan, shelves and frame", (many - few) / 9_000.0);
    let log = Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs");
    let frame = &log.frames()[600];
    let copy = kept(|| frame.clone());
    let scans = frame.scans.iter().map(|scan| 8.0 * scan.ranges.len() as f64).sum::<f64>();
    say("a frame of the tour in memory, its scan of 360 rays included", copy + scans);
    let written = |frames| {
        let mut writer =
            LogWriter::new(Vec::new(), &log.recipe, LogKind::Frames, log.initial().expect("its first frame"))
                .expect("a log of the tour");
        log.frames().iter().take(frames).for_each(|frame| writer.tick(frame).expect("the next tick"));
        writer.into_inner().len() as f64
    };
    say("a tick of the tour in a log, its scan and seal included", (written(1_200) - written(0)) / 1_200.0);
}
