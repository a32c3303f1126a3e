//! Logs of digests: written, read, verified, cut, changed and forged.

use std::sync::Arc;

use motion_lab_core::prelude::*;
use motion_lab_core::worlds::World;
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{
    DamageKind, Difference, Digest, Event, Frame, Log, LogError, LogKind, LogWriter, Recipe, Recorded, RobotInput,
    Script, SecondDigests,
};
use motion_lab_sim::tour::TourConfig;

use crate::runs::controls::open;
use crate::simulator::{event, script};

const SEED: Seed = Seed(11);

/// A car alone in the open, driven a little.
fn config(ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![open("yard", &[("car", "hitch", &[0.0, 0.0, 0.5, 0.5])])], ticks, sensor: None }
}

fn driven() -> Script {
    let drive = |tick, a, b| -> Event { event(tick, "car", RobotInput::Drive(a, b)) };
    script(vec![drive(1, 90, 40), drive(50, -60, 10), drive(1100, 30, 90)])
}

/// The run's frames, with every one's digest.
fn recorded(ticks: u64) -> Log {
    Run::record(config(ticks), (SEED, driven())).unwrap()
}

/// A digest log of these frames; stopped after `stop` ticks.
fn write(log: &Log, stop: Option<u64>) -> Vec<u8> {
    let mut writer = LogWriter::new(Vec::new(), &log.recipe, LogKind::Digests, log.initial().unwrap()).unwrap();
    let count = stop.map_or(log.frames().len(), |stop| stop as usize);
    log.frames()[..count].iter().for_each(|frame| writer.tick(frame).unwrap());
    if stop.is_none() {
        return writer.finish().unwrap();
    }
    writer.stop().unwrap();
    writer.into_inner()
}

/// The digests of a log without frames.
fn seconds(log: &Log) -> &SecondDigests {
    let Recorded::Digests(digests) = &log.recorded else { panic!("it has frames") };
    digests
}

fn seconds_mut(log: &mut Log) -> &mut SecondDigests {
    let Recorded::Digests(digests) = &mut log.recorded else { panic!("it has frames") };
    digests
}

fn written(log: &Log) -> Vec<u8> {
    write(log, None)
}

/// The digest of the run up to `tick`.
fn up_to(log: &Log, tick: usize) -> Digest {
    let begun = Log::with_frames(log.recipe.clone(), log.initial().unwrap().clone(), log.frames()[..tick].to_vec());
    begun.digest().unwrap()
}

#[test]
fn a_digest_log_holds_the_lower_half_of_the_run_s_digest_after_every_second() {
    let log = recorded(1250);
    let read = Log::read_mcap(&written(&log)).unwrap();
    assert!(read.program.starts_with("motion-lab "));
    assert_eq!((&read.log.recipe, read.log.kind()), (&log.recipe, LogKind::Digests));
    let SecondDigests { start, digests, ticks, whole } = seconds(&read.log);
    assert_eq!((*start, *ticks, *whole), (up_to(&log, 0).0 as u64, 1250, log.digest()));
    let after: Vec<u64> = (20..=1240).step_by(20).chain([1250]).map(|tick| up_to(&log, tick).0 as u64).collect();
    assert_eq!(*digests, after);
    let recorded_again = Run::record_recipe(log.recipe.clone(), LogKind::Digests, |_| {}).unwrap();
    assert_eq!(read.log, recorded_again);
    let mut again = Vec::new();
    read.log.write_mcap(&mut again).unwrap();
    assert!(again == written(&log), "written as it was read");
    let mut watched = Vec::new();
    let verified = verify(&read.log, |run| watched.push(run.frame().tick)).unwrap();
    assert_eq!((verified.recorded, verified.identical, verified.difference), (1250, 1250, None));
    assert_eq!((Some(verified.digest), watched), (log.digest(), (0..=1250).collect::<Vec<_>>()));
    for ticks in [0, 1, 20, 1200, 1201] {
        let log = recorded(ticks);
        let read = Log::read_mcap(&written(&log)).unwrap().log;
        assert_eq!(
            (seconds(&read).digests.len() as u64, read.digest()),
            (ticks.div_ceil(20), log.digest()),
            "{ticks} ticks"
        );
        let mut again = Vec::new();
        read.write_mcap(&mut again).unwrap();
        assert!(again == written(&log), "{ticks} ticks");
    }
}

/// The offsets up to which the file is sealed, with the ticks sealed there.
fn seals(file: &[u8]) -> Vec<(usize, u64)> {
    let (mut at, mut seals) = (8, Vec::new());
    while at + 9 <= file.len() {
        let length = u64::from_le_bytes(file[at + 1..at + 9].try_into().unwrap()) as usize;
        if file[at] == 0x0f {
            break;
        }
        if file[at] == 0x80 {
            seals.push((at + 9 + length, u64::from_le_bytes(file[at + 9..at + 17].try_into().unwrap())));
        }
        at += 9 + length;
    }
    seals
}

#[test]
fn a_digest_log_cut_or_changed_anywhere_gives_its_sealed_beginning() {
    let log = recorded(1250);
    let file = written(&log);
    let whole = Log::read_mcap(&file).unwrap().log;
    let seals = seals(&file);
    assert_eq!(seals.iter().map(|s| s.1).collect::<Vec<_>>(), [0, 1200, 1250, 1250], "a minute, the rest, the end");
    let check = |bytes: &[u8], first_bad: usize| {
        let damaged = match Log::read_mcap(bytes) {
            Err(LogError::Damaged(damaged)) => damaged,
            Err(LogError::NotALog) if first_bad < 8 => return DamageKind::Changed,
            other => panic!("byte {first_bad}: {:?}", other.map(|read| read.log.ticks())),
        };
        // the end's own seal belongs to no tick
        let sealed = seals[..3].iter().rev().find(|(end, _)| *end <= first_bad);
        assert_eq!(damaged.recovered.is_some(), sealed.is_some(), "byte {first_bad}");
        let Some(&(end, ticks)) = sealed else { return damaged.kind };
        assert_eq!((damaged.first_unsealed_offset, damaged.sealed_ticks), (end as u64, ticks), "byte {first_bad}");
        let recovered = damaged.recovered.unwrap().log;
        assert_eq!((recovered.ticks(), recovered.digest()), (ticks, None));
        let (found, expected) = (seconds(&recovered), seconds(&whole));
        assert_eq!(found.digests, expected.digests[..ticks.div_ceil(20) as usize], "byte {first_bad}");
        assert_eq!((&recovered.recipe, found.start), (&whole.recipe, expected.start));
        damaged.kind
    };
    for cut in 0..file.len() {
        assert_eq!(check(&file[..cut], cut), DamageKind::Cut, "cut at {cut}");
    }
    for at in 0..file.len() {
        let mut changed = file.clone();
        changed[at] ^= 1 << (at % 8);
        check(&changed, at);
    }
    let mut longer = file.clone();
    longer.push(0);
    assert_eq!(check(&longer, file.len()), DamageKind::Changed);
    let message = Log::read_mcap(&file[..seals[1].0 + 3]).unwrap_err().to_string();
    let expected =
        format!("the digest log is cut off after byte {}: the digests of 1200 of 1250 ticks are whole", seals[1].0);
    assert_eq!(message, expected);
}

#[test]
fn a_run_stopped_at_any_tick_is_verified_up_to_it() {
    let log = recorded(1250);
    for stop in [0, 1, 19, 20, 21, 1199, 1200, 1201, 1234] {
        let file = write(&log, Some(stop));
        let Err(LogError::Damaged(damaged)) = Log::read_mcap(&file) else { panic!("stopped at {stop}") };
        assert_eq!((damaged.kind, damaged.first_unsealed_offset), (DamageKind::Cut, file.len() as u64));
        let read = damaged.recovered.unwrap().log;
        assert_eq!((read.ticks(), seconds(&read).digests.len() as u64), (stop, stop.div_ceil(20)));
        let verified = verify(&read, |_| {}).unwrap();
        assert_eq!((verified.recorded, verified.identical, verified.difference), (stop, stop, None));
        assert_eq!(verified.digest, up_to(&log, stop as usize));
        // nothing can follow the last digest of a run that stopped within a minute
        if stop % 1200 != 0 {
            let whole = written(&log);
            let longer = [&file[..], &whole[seals(&whole)[1].0..]].concat();
            let Err(LogError::Damaged(damaged)) = Log::read_mcap(&longer) else { panic!("{stop}") };
            assert_eq!((damaged.sealed_ticks, damaged.kind), (stop, DamageKind::Changed));
        }
    }
}

/// A record of an MCAP file.
fn record(opcode: u8, content: &[u64]) -> Vec<u8> {
    let content: Vec<u8> = content.iter().flat_map(|word| word.to_le_bytes()).collect();
    [&[opcode][..], &(content.len() as u64).to_le_bytes(), &content].concat()
}

#[test]
fn a_record_of_less_than_a_minute_is_the_last() {
    let log = recorded(1250);
    let stopped = write(&log, Some(40));
    let digest = up_to(&log, 60).0 as u64;
    let mut longer = [stopped.clone(), record(0x81, &[60, digest])].concat();
    let hash = xxhash_rust::xxh3::xxh3_128(&longer);
    longer.extend(record(0x80, &[60, longer.len() as u64, hash as u64, (hash >> 64) as u64]));
    let Err(LogError::Damaged(damaged)) = Log::read_mcap(&longer) else { panic!("accepted") };
    let found = (damaged.sealed_ticks, damaged.first_unsealed_offset, damaged.kind);
    assert_eq!(found, (40, stopped.len() as u64, DamageKind::Changed));
}

/// The run has 1250 ticks, of which 1200 are in its first record.
#[test]
fn a_record_beyond_the_run_s_end_or_of_another_number_of_digests_is_changed() {
    let begun = write(&recorded(1250), Some(1200));
    for (tick, digests) in [(1260, 3), (2400, 60), (1250, 2), (1250, 4), (1200, 0), (1180, 1)] {
        let words: Vec<u64> = std::iter::once(tick).chain((0..digests).map(|k| 7 + k)).collect();
        let mut longer = [begun.clone(), record(0x81, &words)].concat();
        let hash = xxhash_rust::xxh3::xxh3_128(&longer);
        longer.extend(record(0x80, &[tick, longer.len() as u64, hash as u64, (hash >> 64) as u64]));
        let Err(LogError::Damaged(damaged)) = Log::read_mcap(&longer) else { panic!("accepted: {tick}") };
        let found = (damaged.sealed_ticks, damaged.first_unsealed_offset, damaged.kind);
        assert_eq!(found, (1200, begun.len() as u64, DamageKind::Changed), "{digests} digests up to {tick}");
    }
}

#[test]
fn a_run_changed_at_one_tick_is_refused_in_its_second() {
    let log = recorded(70);
    for (tick, first, last) in [(1, 1, 20), (20, 1, 20), (21, 21, 40), (40, 21, 40), (60, 41, 60), (70, 61, 70)] {
        let mut forged = log.clone();
        forged.frames_mut()[tick - 1].robots[0].contacts ^= 1;
        let read = Log::read_mcap(&written(&forged)).unwrap().log;
        let verified = verify(&read, |_| {}).unwrap();
        let Some(Difference::Second(difference)) = verified.difference else { panic!("no second differs") };
        assert_eq!((difference.first_tick, difference.last_tick, verified.identical), (first, last, first - 1));
        assert_eq!((verified.recorded, Some(verified.digest)), (70, log.digest()));
        let words = format!("second {}, ticks {first} to {last}: the digest is ", u64::div_ceil(last, 20));
        assert!(difference.to_string().starts_with(&words), "{difference}");
    }
    let honest = Log::read_mcap(&written(&log)).unwrap().log;
    type Change = fn(&mut Log);
    let changes: [(&str, u64, Change); 6] = [
        ("tick 0, before", 0, |l| seconds_mut(l).start ^= 1),
        ("tick 0, before", 0, |l| l.recipe.seed.0 ^= 1),
        ("tick 0, before", 0, |l| l.recipe.script.events[1].input = RobotInput::Drive(-61, 10)),
        ("tick 0, before", 0, |l| Arc::make_mut(&mut l.recipe.config).worlds[0].bounds.max.x += 1.0),
        ("second 2, ticks 21 to 40", 20, |l| seconds_mut(l).digests[1] ^= 1 << 63),
        // the upper half of the run's digest is known at its end only
        ("second 4, ticks 61 to 70", 60, |l| {
            seconds_mut(l).whole = l.digest().map(|digest| Digest(digest.0 ^ 1 << 127))
        }),
    ];
    for (words, identical, change) in changes {
        let mut forged = honest.clone();
        change(&mut forged);
        let verified = verify(&forged, |_| {}).unwrap();
        let difference = verified.difference.unwrap_or_else(|| panic!("{words}: nothing differs")).to_string();
        assert!(difference.starts_with(words), "{difference}");
        assert_eq!(verified.identical, identical, "{words}");
    }
}

#[test]
fn an_hour_of_one_world_takes_at_most_six_tenths_of_a_byte_a_frame() {
    const HOUR: u64 = 72_000;
    let config = TourConfig { worlds: vec![World::apartment()], ticks: HOUR, sensor: None };
    let recipe = Recipe::new(config, SEED);
    let mut run = Recorder::of(&recipe).unwrap();
    let mut writer = LogWriter::new(Vec::new(), &recipe, LogKind::Digests, run.frame()).unwrap();
    let before = writer.sealed_bytes();
    while !run.is_complete() {
        writer.tick(run.step()).unwrap();
    }
    let file = writer.finish().unwrap();
    println!("{} bytes of an hour, {before} of them before its first tick", file.len());
    assert!(file.len() * 10 <= 72_000 * 6, "{} bytes", file.len());
    assert_eq!(seconds(&Log::read_mcap(&file).unwrap().log).digests.len(), 3600);
}

#[test]
fn each_kind_of_log_is_read_as_what_it_is() {
    let log = recorded(30);
    let mut full = Vec::new();
    log.write_mcap(&mut full).unwrap();
    let read = Log::read_mcap(&written(&log)).unwrap();
    assert_eq!((read.log.kind(), read.log.ticks(), read.log.frames()), (LogKind::Digests, 30, &[][..]));
    assert!(matches!(LogWriter::resume(Vec::new(), &read), Err(LogError::NoFrames)));
    assert!(matches!(Log::read_mcap(b"no log at all"), Err(LogError::NotALog)));
    assert_eq!(Log::read_mcap(&full).unwrap().log, log);
}

#[test]
fn frames_that_are_not_the_run_s_next_are_not_taken() {
    let log = recorded(30);
    for kind in [LogKind::Frames, LogKind::Digests] {
        let mut writer = LogWriter::new(Vec::new(), &log.recipe, kind, log.initial().unwrap()).unwrap();
        let (sealed, digest) = (writer.sealed_bytes(), writer.digest());
        let mut nan = log.frames()[0].clone();
        nan.robots[0].configuration[0] = f64::NAN;
        let none = Frame { robots: vec![], ..log.frames()[0].clone() };
        assert!(matches!(writer.tick(&log.frames()[1]), Err(LogError::Order { expected: 1, found: 2 })));
        assert!(matches!(writer.tick(&nan), Err(LogError::NotANumber { tick: 1, .. })));
        assert!(matches!(writer.tick(&none), Err(LogError::Robots { tick: 1, .. })));
        assert_eq!((writer.ticks(), writer.sealed_bytes(), writer.digest()), (0, sealed, digest));
        assert!(matches!(writer.end(), Err(LogError::Incomplete { recorded: 0, ticks: 30 })));
    }
}
