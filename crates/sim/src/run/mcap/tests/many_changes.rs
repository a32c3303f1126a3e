//! Tests of logs of many changes of worlds, whose frames hold what is not as after the tick before.

use std::collections::BTreeMap;

use mcap::MessageStream;
use prost::Message;

use super::*;
use crate::run::mcap::encoder::Encoder;
use crate::run::mcap::message::FrameMessage;
use crate::run::mcap::preamble::Preamble;
use crate::run::{Frame, ObstacleState, Quantized, RunDigest, Script, WorldChange, WorldEvent};

/// A log of this many ticks, whose script adds this many obstacles.
fn log(ticks: u64, changes: usize, frame: impl Fn(u64, &mut Frame)) -> Log {
    let mut log = fixture::log();
    config_of(&mut log).ticks = ticks;
    let (initial, frames) = frames_of(&mut log);
    let mut now = initial.clone();
    *frames = (1..=ticks)
        .map(|tick| {
            frame(tick, &mut now);
            Frame { obstacles: now.obstacles.clone(), ..fixture::frame(tick) }
        })
        .collect();
    let added = |k: usize| WorldEvent {
        tick: 1 + k as u64 * ticks / changes as u64,
        world: "Yard".into(),
        change: WorldChange::Add {
            name: format!("added {k}"),
            points: vec![(Quantized(k as i64), Quantized(1 << 20))],
            radius: Quantized(1 << 12),
        },
    };
    log.recipe.script = Script::new(log.recipe.script.events, (0..changes).map(added).collect());
    log
}

fn state(obstacle: u32, present: bool, x: f64) -> ObstacleState {
    ObstacleState { world: 0, obstacle, present, pose: Pose2::new(x, 0.0, 0.0) }
}

/// Obstacles come, move by the sign of a zero, go, and are as at the start again.
fn busy(tick: u64, frame: &mut Frame) {
    let number = |k: u64| ((k * 37) % 300) as u32;
    (0..40).for_each(|k| frame.obstacles.set(state(number(40 * tick + k), !tick.is_multiple_of(3), (tick / 2) as f64)));
    (0..9).for_each(|k| frame.obstacles.remove((0, number(80 * tick + 7 * k))));
    let zero = if tick.is_multiple_of(2) { 0.0 } else { -0.0 };
    frame.obstacles.set(ObstacleState { pose: Pose2 { x: zero, y: 0.0, theta: 0.0 }, ..state(301, true, 0.0) });
}

/// The bytes of a log of a version of the format, and its digest.
fn written_as(log: &Log, format: &'static str) -> Vec<u8> {
    let initial = log.initial().unwrap();
    let preamble = Preamble { format, ..Preamble::new(&log.recipe, LogKind::Frames, initial).unwrap() };
    let mut run = RunDigest::new(&log.recipe, initial);
    let mut encoder = Encoder::begin(preamble, run.lower_half()).unwrap();
    let mut file = encoder.piece().to_vec();
    for frame in log.frames() {
        encoder.tick(frame, &mut run).unwrap();
        file.extend_from_slice(encoder.piece());
    }
    encoder.finish(Some(run.digest())).unwrap();
    file.extend_from_slice(encoder.piece());
    file
}

fn has_format(file: &[u8], format: &str) -> bool {
    let entry = format!("format\u{1}\0\0\0{format}");
    file.windows(entry.len()).any(|window| window == entry.as_bytes())
}

#[test]
fn from_257_changes_on_a_log_has_format_3_and_is_read_to_the_bit() {
    for (changes, format) in [(256, "2"), (257, "3")] {
        let log = log(30, changes, busy);
        let file = written(&log);
        assert!(has_format(&file, format), "{changes} changes");
        let read = Log::read_mcap(&file).unwrap();
        assert_same(&read.log, &log);
        assert_eq!((read.format, read.sealed), (format, log.digest()));
        assert_eq!(read.log.frames()[29].obstacles.since(&log.frames()[29].obstacles), []);
    }
}

#[test]
fn another_reader_adds_the_obstacles_up_as_the_schema_says() {
    let log = log(30, 300, busy);
    let (mut now, mut frames, mut back) = (BTreeMap::new(), 0, 0);
    for message in MessageStream::new(&written(&log)).unwrap() {
        let message = message.unwrap();
        assert_eq!(message.channel.schema.clone().unwrap().data, crate::run::mcap::message::SCHEMA_3);
        if message.channel.topic != "/frame" {
            continue;
        }
        for o in FrameMessage::decode(&message.data[..]).unwrap().obstacles {
            if o.at_start {
                assert!(!o.present && o.pose.is_empty() && now.remove(&o.obstacle).is_some());
                back += 1;
            } else {
                let bits: Vec<u64> = o.pose.iter().map(|x| x.to_bits()).collect();
                let value = (o.present, bits);
                assert_ne!(now.insert(o.obstacle, value.clone()), Some(value), "what stays as it is is not said");
            }
        }
        let bits = |p: &Pose2| [p.x, p.y, p.theta].map(f64::to_bits).to_vec();
        let frame = log.frame(frames).unwrap();
        let held = frame.obstacles.iter().map(|o| (o.obstacle, (o.present, bits(&o.pose))));
        assert_eq!(now, held.collect(), "tick {frames}");
        frames += 1;
    }
    assert!(frames == 31 && now.len() > 200 && back > 50, "{frames} frames, {} obstacles, {back} back", now.len());
}

#[test]
fn a_log_of_before_that_repeats_many_obstacles_is_read_and_goes_on() {
    let log = log(12, 300, |tick, frame| {
        if !tick.is_multiple_of(3) {
            busy(tick, frame)
        }
    });
    let (before, now) = (written_as(&log, FORMAT_VERSION_WITH_CHANGES), written(&log));
    assert!(has_format(&before, "2") && before.len() > now.len());
    assert_eq!(written_as(&log, FORMAT_VERSION_WITH_MANY_CHANGES), now);
    let read = Log::read_mcap(&before).unwrap();
    assert_same(&read.log, &log);
    assert_eq!(read.sealed, log.digest());
    // frames that were read whole share what is the same in them: of tick 12 all that tick 11 had
    let [a, b] = [10, 11].map(|k| &read.log.frames()[k].obstacles);
    assert!(b.len() > 100 && b.bytes_beyond(a) < 100, "{} bytes of {}", b.bytes_beyond(a), b.len());
    for whole in [&before, &now] {
        for cut in (whole.len() / 3..whole.len()).step_by(1013) {
            let Err(LogError::Damaged(damaged)) = Log::read_mcap(&whole[..cut]) else { panic!("cut at {cut}") };
            let (sealed, at) = (damaged.sealed_ticks as usize, damaged.first_unsealed_offset as usize);
            let Some(read) = damaged.recovered else { continue };
            let mut writer = LogWriter::resume(whole[..at].to_vec(), &read).unwrap();
            log.frames()[sealed..].iter().for_each(|frame| writer.tick(frame).unwrap());
            assert!(writer.finish().unwrap() == *whole, "resumed after a cut at {cut}");
        }
    }
}

#[test]
fn a_log_in_a_format_that_its_script_does_not_have_is_refused() {
    let (few, many, none) = (log(3, 256, busy), log(3, 257, busy), fixture::log());
    let wrong = [(&few, "3"), (&few, "1"), (&many, "1"), (&none, "2"), (&none, "3")];
    for (log, format) in wrong {
        let format = [FORMAT_VERSION, FORMAT_VERSION_WITH_CHANGES, FORMAT_VERSION_WITH_MANY_CHANGES]
            .into_iter()
            .find(|known| *known == format)
            .unwrap();
        let refused = Log::read_mcap(&written_as(log, format)).unwrap_err();
        assert!(matches!(refused, LogError::Foreign { .. }), "{format}: {refused}");
    }
}

/// Ten times as many obstacles added in as many ticks make a log ten times as long, not more.
#[test]
fn a_log_grows_with_what_changes() {
    let [small, large] = [1000, 10_000].map(|count: usize| {
        let added = |tick: u64, frame: &mut Frame| {
            let to = |tick: u64| (tick as usize * count / 100) as u32;
            (to(tick - 1)..to(tick)).for_each(|number| frame.obstacles.set(state(number, true, 0.0)));
        };
        let log = log(100, count, added);
        let file = written(&log);
        assert_eq!(Log::read_mcap(&file).unwrap().log.frames()[99].obstacles.len(), count);
        file.len()
    });
    assert!(large < 11 * small, "{small} bytes, {large} bytes");
}
