//! Tests of the log as a file: what is written, read, refused and recovered.

mod damage;
mod many_changes;
mod peers;
mod schema;
mod sealed_digest;

use std::slice::from_ref;

use super::*;
use crate::run::fixture::{config_of, frames_of};
use crate::run::{Log, LogKind, first_divergence, fixture};
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::worlds::{Obstacle, ObstacleKind};

fn written(log: &Log) -> Vec<u8> {
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    file
}

/// Asserts that two logs are the same run, to the last bit of every number. (`==` takes -0.0 and 0.0 for equal.)
fn assert_same(found: &Log, expected: &Log) {
    assert_eq!(found, expected);
    assert_eq!(found.digest(), expected.digest());
    assert_eq!(first_divergence(expected.frames(), found.frames()), None);
    assert_eq!(first_divergence(from_ref(expected.initial().unwrap()), from_ref(found.initial().unwrap())), None);
}

#[test]
fn a_log_read_back_is_the_log_written() {
    let log = fixture::log();
    let read = Log::read_mcap(&written(&log)).unwrap();
    assert_same(&read.log, &log);
    assert_eq!(read.program, concat!("motion-lab ", env!("CARGO_PKG_VERSION")));
    assert!(read.log.frames()[0].robots[0].configuration[1].is_sign_negative(), "-0.0 kept its sign");
    assert_eq!(read.log.frames()[0].robots[0].configuration[2].to_bits(), 1, "the least subnormal number");
}

#[test]
fn a_log_without_ticks_events_sensor_or_robots_is_one_too() {
    let mut log = fixture::log();
    config_of(&mut log).ticks = 0;
    config_of(&mut log).sensor = None;
    config_of(&mut log).worlds[0].robots.clear();
    log.recipe.script.events.clear();
    let (initial, frames) = frames_of(&mut log);
    frames.clear();
    initial.robots.clear();
    initial.scans.clear();
    assert_same(&Log::read_mcap(&written(&log)).unwrap().log, &log);
}

#[test]
fn the_same_run_gives_the_same_bytes_and_they_only_grow() {
    let log = fixture::log();
    let whole = written(&log);
    assert_eq!(whole, written(&log));
    for ticks in 0..=3 {
        let mut writer = LogWriter::new(Vec::new(), &log.recipe, LogKind::Frames, log.initial().unwrap()).unwrap();
        log.frames()[..ticks].iter().for_each(|frame| writer.tick(frame).unwrap());
        let sealed = writer.sealed_bytes();
        let so_far = writer.into_inner();
        assert!(whole.starts_with(&so_far) && so_far.len() as u64 == sealed, "after {ticks} ticks");
    }
}

#[test]
fn a_run_cut_short_goes_on_where_its_seals_end() {
    let log = fixture::log();
    let whole = written(&log);
    for cut in (0..whole.len()).step_by(97) {
        let Err(LogError::Damaged(damaged)) = Log::read_mcap(&whole[..cut]) else { panic!("cut at {cut}") };
        let DamagedLog { recovered: Some(read), sealed_ticks, first_unsealed_offset, .. } = *damaged else { continue };
        let kept = whole[..usize::try_from(first_unsealed_offset).unwrap()].to_vec();
        let mut writer = LogWriter::resume(kept, &read).unwrap();
        assert_eq!((writer.ticks(), writer.sealed_bytes()), (sealed_ticks, first_unsealed_offset));
        for frame in &log.frames()[usize::try_from(sealed_ticks).unwrap()..] {
            writer.tick(frame).unwrap();
        }
        assert_eq!(writer.finish().unwrap(), whole, "resumed after a cut at {cut}");
    }
}

#[test]
fn what_is_no_run_is_not_written() {
    type Change = fn(&mut Log);
    let changes: [(&str, Change); 12] = [
        ("the frame of tick 3 came where that of tick 2 belongs", |l| drop(frames_of(l).1.remove(1))),
        ("the frame of tick 1 came where that of tick 0 belongs", |l| frames_of(l).0.tick = 1),
        ("2 of 3 ticks are recorded", |l| drop(frames_of(l).1.pop())),
        ("tick 3 lies beyond the run's 2 ticks", |l| config_of(l).ticks = 2),
        ("tick 2: the frame's robots", |l| drop(frames_of(l).1[1].robots.pop())),
        ("tick 2: the frame's robots", |l| frames_of(l).1[1].robots.swap(0, 1)),
        ("tick 2: the frame's robots", |l| frames_of(l).1[1].scans[0].robot = 2),
        ("tick 2, robot 1: target[1] is not a number", |l| frames_of(l).1[1].robots[1].target[1] = f64::NAN),
        ("worlds/0.ron in the log: worlds/0.ron:", |l| config_of(l).worlds[0].robots[1].start.push(0.0)),
        ("worlds/0.ron in the log: the world is not one", |l| {
            let wall = Shape::Segment { a: Point2::new(0.0, 0.0), b: Point2::new(1.0, 0.0) };
            let pieces = vec![(Pose2::new(0.0, 0.0, 0.5), wall)];
            config_of(l).worlds[0].obstacles.push(Obstacle::new("turned", ObstacleKind::Wall, pieces));
        }),
        ("the configuration: 0 worlds", |l| config_of(l).worlds.clear()),
        ("the script: events[2]: there is no robot \"Cat\"", |l| l.recipe.script.events[2].robot = "Cat".into()),
    ];
    for (reason, change) in changes {
        let mut log = fixture::log();
        change(&mut log);
        let error = log.write_mcap(Vec::new()).expect_err(reason).to_string();
        assert!(error.starts_with(reason), "{error}");
    }
}

/// An output with a limited number of bytes left.
struct Disk<'a> {
    room: &'a std::cell::Cell<usize>,
}

impl std::io::Write for Disk<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let n = bytes.len().min(self.room.get());
        self.room.set(self.room.get() - n);
        if n == 0 { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(n) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_and_nothing_is_written_after_it() {
    let log = fixture::log();
    let length = written(&log).len();
    let room = std::cell::Cell::new(0);
    for bytes in (0..length).step_by(53) {
        room.set(bytes);
        assert!(matches!(log.write_mcap(Disk { room: &room }), Err(LogError::Io(_))), "{bytes} of {length} bytes");
    }
    room.set(length);
    assert!(log.write_mcap(Disk { room: &room }).is_ok());

    room.set(usize::MAX);
    let mut writer =
        LogWriter::new(Disk { room: &room }, &log.recipe, LogKind::Frames, log.initial().unwrap()).unwrap();
    writer.tick(&log.frames()[0]).unwrap();
    room.set(10);
    assert!(writer.tick(&log.frames()[1]).is_err());
    room.set(usize::MAX);
    assert!(writer.tick(&log.frames()[2]).is_err(), "half a piece is out: going on would leave a hole");
    assert_eq!(room.get(), usize::MAX, "nothing was written");
}
