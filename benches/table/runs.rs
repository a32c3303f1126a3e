//! Whole runs, and the start of a run.

use std::process::Command;
use std::time::Instant;

use motion_lab::recording::{Recorder, Run};
use motion_lab::run::LogWriter;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::World;

use crate::measure::{Contender, Timing, race};
use crate::{Row, Table, readme};

/// The environment variable of the child process that runs only its first step.
pub const CHILD: &str = "MOTION_LAB_FIRST_STEP";

/// The child's work: one tick, and a print of its peak memory, kilobytes.
pub fn first_step() {
    let mut recorder = Recorder::new(TourConfig::default(), BOOK_SEED).expect("the tour runs");
    std::hint::black_box(recorder.step());
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap_or("0 kB");
    println!("{}", peak.trim().trim_end_matches(" kB"));
}

fn minute() -> Vec<Timing> {
    println!("  digest {}", Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs").digest());
    race(vec![
        Contender::new("", |_| {
            let log = Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs");
            let frames = Run::replay(&log).expect("it replays");
            let same = frames.iter().map(motion_lab::run::Frame::digest).eq(log.digests.iter().copied());
            assert!(same, "the replay differs");
            log.digest()
        }),
        Contender::new("recorded only", |_| Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs")),
    ])
}

pub fn rows(table: &mut Table) {
    let tour = "the 60 s tour, recorded and re-simulated with digests";
    if table.wants(tour) {
        let timings = minute();
        let times = 60e9 / timings[0].median;
        table.push(Row {
            work: tour.into(),
            ours: readme::time(timings[0].median),
            peer: format!("recorded only {}", readme::time(timings[1].median)),
            ratio: format!("{times:.0}x real time"),
            spread: format!("{:.0} %", 100.0 * timings[0].spread),
            must: ">= 4,000x",
        });
    }
    let mut recorder = Recorder::new(TourConfig::default(), BOOK_SEED).expect("the tour runs");
    table.row("a tick of the tour: three robots, 360 rays", "", || {
        race(vec![Contender::new("", |i| {
            if i % 1200 == 1199 {
                recorder = Recorder::new(TourConfig::default(), BOOK_SEED).expect("the tour runs");
            }
            recorder.step().tick
        })])
    });
    table.row("of it the schedule: a tick without a robot", "", || {
        let mut world = World::workbench();
        world.robots.clear();
        let config = TourConfig { worlds: vec![world], ..TourConfig::default() };
        let mut recorder = Recorder::new(config, BOOK_SEED).expect("it runs without robots");
        race(vec![Contender::new("", |_| recorder.step().tick)])
    });
    table.row("a tick of the tour written and sealed, to memory", "", || {
        let log = Run::record(TourConfig::default(), BOOK_SEED).expect("the tour runs");
        let begin = || {
            let room = Vec::with_capacity(16 << 20);
            LogWriter::new(room, BOOK_SEED, &log.config, &log.script, &log.initial).expect("a log of the tour")
        };
        let mut writer = begin();
        race(vec![Contender::new("", |i| {
            if i % log.frames.len() == 0 {
                writer = begin();
            }
            writer.tick(&log.frames[i % log.frames.len()]).expect("the next tick")
        })])
    });
    let start = "start to first step, peak memory";
    if table.wants(start) {
        let me = std::env::current_exe().expect("this program");
        let (mut took, mut peak) = (Vec::new(), 0.0_f64);
        for _ in 0..21 {
            let begin = Instant::now();
            let child = Command::new(&me).env(CHILD, "1").output().expect("the child runs");
            took.push(begin.elapsed().as_secs_f64() * 1e9);
            let kilobytes: f64 = String::from_utf8_lossy(&child.stdout).trim().parse().unwrap_or(f64::NAN);
            peak = if kilobytes > peak { kilobytes } else { peak };
        }
        let took = Timing::of("", took);
        table.push(Row {
            work: start.into(),
            ours: format!("{}, {:.1} MB", readme::time(took.median), peak / 1024.0),
            peer: String::new(),
            ratio: String::new(),
            spread: format!("{:.0} %", 100.0 * took.spread),
            must: "<= 20 ms / 20 MB",
        });
    }
}
