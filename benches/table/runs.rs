//! Whole runs: the tour beside the scans in it, and the same minute by other simulators.

use std::time::Instant;

use motion_lab::collision::Scene;
use motion_lab::geometry::Pose2;
use motion_lab::num::{hypot, wrap};
use motion_lab::prelude::RustyDisc;
use motion_lab::recording::{Recorder, Run};
use motion_lab::run::{DT, Frame, Log, LogKind, LogWriter};
use motion_lab::sensors::Scanner;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::World;

use crate::Table;
use crate::contest::sides;
use crate::measure::{Entrant, race};
use crate::rivals::Task;
use crate::row::{Mark, Row};

fn recorded() -> Log {
    Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs")
}

/// Times some work on every tick of a minute; returns the time of one, nanoseconds.
fn ticks(count: usize, work: impl FnMut(usize)) -> f64 {
    let start = Instant::now();
    (0..count).for_each(work);
    start.elapsed().as_secs_f64() * 1e9 / count as f64
}

fn begin(config: TourConfig) -> Recorder {
    Recorder::new(config, BOOK_SEED).expect("the tour runs")
}

/// A log that begins in memory that has been used before, as a file's pages have.
fn write(log: &Log, mut room: Vec<u8>) -> LogWriter<Vec<u8>> {
    room.clear();
    LogWriter::new(room, &log.recipe, LogKind::Frames, log.initial().expect("its first frame")).expect("a log")
}

/// The poses from which the rover scans, tick by tick.
fn poses(log: &Log) -> Vec<Pose2> {
    let pose = |frame: &Frame| {
        let q = &frame.robots[frame.scans[0].robot as usize].configuration;
        Pose2::new(q[0], q[1], q[2])
    };
    log.frames().iter().map(pose).collect()
}

/// A tick of the tour and its parts, in units of the one scan in it.
fn tick(table: &mut Table) {
    let works = [
        ("a tick of the tour: three robots, a scan, frame, digest, written and sealed", Mark::cost(" scans")),
        ("the tour recorded and re-simulated with digests, a tick", Mark::at_most(12.0, " scans")),
        ("of a tick the step: three robots, a scan, frame", Mark::cost(" scans")),
        ("of a tick the schedule: a world without a robot", Mark::cost(" scans")),
        ("of a tick what is written and sealed, to memory", Mark::cost(" scans")),
    ];
    let works = works.map(|(work, mark)| (work.to_owned(), mark));
    let log = recorded();
    let count = log.frames().len();
    table.race(&works, |_| {
        let log = &log;
        let scene = Scene::of_world(&log.recipe.config.worlds[0]);
        let mut scanner = Scanner::new(log.recipe.config.sensor.expect("the tour has a sensor"));
        let (poses, mut ranges) = (poses(log), vec![0.0; 360]);
        for (pose, frame) in poses.iter().zip(log.frames()) {
            scanner.scan_into(&scene, &[], pose, &mut ranges);
            assert!(frame.scans[0].ranges.iter().eq(&ranges), "the scan alone is that of tick {}", frame.tick);
        }
        let mut room = Vec::new();
        let whole = move || {
            let (mut recorder, mut writer) = (begin(TourConfig::default()), write(log, std::mem::take(&mut room)));
            let took = ticks(count, |_| writer.tick(recorder.step()).expect("the next tick"));
            assert_eq!(Some(writer.digest()), log.digest(), "the same minute");
            room = writer.into_inner();
            took
        };
        let twice = move || {
            ticks(1, |_| {
                let log = recorded();
                let frames = Run::replay(&log).expect("it replays");
                assert!(
                    frames.iter().map(Frame::digest).eq(log.frames().iter().map(Frame::digest)),
                    "the replay differs"
                );
            }) / count as f64
        };
        let step = move || {
            let mut recorder = begin(TourConfig::default());
            ticks(count, |_| _ = std::hint::black_box(recorder.step().tick))
        };
        let schedule = move || {
            let mut world = World::workbench();
            world.robots.clear();
            let mut recorder = begin(TourConfig { worlds: vec![world], ..TourConfig::default() });
            ticks(count, |_| _ = std::hint::black_box(recorder.step().tick))
        };
        let mut room = Vec::new();
        let written = move || {
            let mut writer = write(log, std::mem::take(&mut room));
            let took = ticks(count, |i| writer.tick(&log.frames()[i]).expect("the next tick"));
            room = writer.into_inner();
            took
        };
        let scan = move || {
            ticks(count, |i| {
                scanner.scan_into(&scene, &[], &poses[i], &mut ranges);
                std::hint::black_box(&ranges);
            })
        };
        vec![
            Entrant::by_own_clock("", whole),
            Entrant::by_own_clock("", twice),
            Entrant::by_own_clock("", step),
            Entrant::by_own_clock("", schedule),
            Entrant::by_own_clock("", written),
            Entrant::by_own_clock("its scan alone", scan),
        ]
    });
}

/// The rover's minute as a task: its world, its start, and its speeds tick by tick. The other simulators do without arm
/// and car.
fn minute(log: &Log) -> Task {
    let poses = poses(log);
    let speeds = poses
        .windows(2)
        .flat_map(|w| [hypot(w[1].x - w[0].x, w[1].y - w[0].y) / DT, wrap(w[1].theta - w[0].theta) / DT]);
    let sensor = log.recipe.config.sensor.expect("the tour has a sensor");
    Task {
        kind: "minute".into(),
        settings: vec![sensor.max_range, DT, RustyDisc::default().radius],
        obstacles: sides(&Scene::of_world(&log.recipe.config.worlds[0])),
        cases: vec![[poses[0].x, poses[0].y, poses[0].theta].into_iter().chain(speeds).collect()],
    }
}

pub fn rows(table: &mut Table) {
    tick(table);
    let work = "the 60 s tour recorded with digests";
    if !table.wants(work) {
        return;
    }
    let log = recorded();
    println!("  digest {}", log.digest().expect("it has frames"));
    let peers = table.peers.entrants(&minute(&log), |_, _| ());
    let ours = Entrant::new("", 1, |_| recorded());
    let timings = race(std::iter::once(ours).chain(peers).collect());
    let (ours, peers) = (&timings[0], &timings[1..]);
    for peer in peers {
        let mark = if peer.name == "ir-sim" { 150.0 } else { 10.0 };
        let work = format!("{work}, the rover's minute by {}", peer.name);
        table.push(Row::new(work, Mark::faster_by(mark), ours, std::slice::from_ref(peer)));
    }
    if peers.is_empty() {
        table.push(Row::note(work.into(), crate::row::time(ours.median)));
    }
}
