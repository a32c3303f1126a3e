//! Tests of the run's digest in the end of a log with frames.

use super::*;
use crate::run::mcap::encoder::Encoder;
use crate::run::mcap::preamble::Preamble;
use crate::run::{Digest, RunDigest};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Mark, Place};

/// The file of a log whose end seals `digest`, whatever the log's own is: what somebody makes who can seal a file.
fn sealing(log: &Log, digest: Option<Digest>) -> Vec<u8> {
    let initial = log.initial().unwrap();
    let mut run = RunDigest::new(&log.recipe, initial);
    let preamble = Preamble::new(&log.recipe, LogKind::Frames, initial).unwrap();
    let mut encoder = Encoder::begin(preamble, run.lower_half()).unwrap();
    let mut file = encoder.piece().to_vec();
    for frame in log.frames() {
        assert!(encoder.tick(frame, &mut run).unwrap());
        file.extend_from_slice(encoder.piece());
    }
    encoder.finish(digest).unwrap();
    file.extend_from_slice(encoder.piece());
    file
}

fn mark() -> Mark {
    Mark { name: "m".into(), points: vec![Point2::new(0.0, 0.0), Point2::new(1.0, 0.0)] }
}

fn place() -> Place {
    Place { name: "p".into(), pose: Pose2::new(0.0, 0.0, 0.5) }
}

#[test]
fn what_no_frame_tells_is_refused_by_the_digest_that_the_end_seals() {
    let honest = fixture::log();
    let digest = honest.digest().unwrap();
    assert_eq!(sealing(&honest, Some(digest)), written(&honest), "the end is that of any log");
    assert_eq!(Log::read_mcap(&written(&honest)).unwrap().sealed, Some(digest));
    type Change = fn(&mut Log);
    let changes: [(&str, Change); 8] = [
        ("the run's range", |l| config_of(l).sensor = Some(RangeSensor { n_rays: 3, max_range: 3.5 })),
        ("the bounds", |l| config_of(l).worlds[0].bounds.max.x += 1.0),
        ("the world's name", |l| config_of(l).worlds[0].name = "Garden".into()),
        ("a mark", |l| config_of(l).worlds[0].marks.push(mark())),
        ("a place", |l| config_of(l).worlds[0].places.push(place())),
        ("the seed", |l| l.recipe.seed.0 ^= 1),
        ("ticks shortened", |l| {
            config_of(l).ticks -= 1;
            l.recipe.script.events.pop();
            frames_of(l).1.pop();
        }),
        ("a frame", |l| frames_of(l).1[2].robots[0].contacts += 1),
    ];
    for (what, change) in changes {
        let mut forged = honest.clone();
        change(&mut forged);
        let Err(LogError::OtherRun(other)) = Log::read_mcap(&sealing(&forged, Some(digest))) else { panic!("{what}") };
        let words = other.to_string();
        let OtherRun { read, sealed, held, .. } = *other;
        assert_eq!((sealed, Some(held), read.sealed), (digest, forged.digest(), Some(digest)), "{what}");
        assert_same(&read.log, &forged);
        assert!(words.contains(&digest.to_string()) && words.contains(&held.to_string()), "{what}: {words}");
        // whoever writes the digest anew, too, is found only by who knows the honest one
        assert_ne!(Log::read_mcap(&written(&forged)).unwrap().sealed, Some(digest), "{what}");
    }
}

#[test]
fn a_log_of_before_seals_no_digest_and_is_read_as_ever() {
    let log = fixture::log();
    let (file, older) = (written(&log), sealing(&log, None));
    // a digest record of 16 bytes and a seal of 32, each after an opcode and a length
    assert_eq!(file.len() - older.len(), 9 + 16 + 9 + 32);
    let read = Log::read_mcap(&older).unwrap();
    assert_eq!(read.sealed, None);
    assert_same(&read.log, &log);
    for cut in 0..older.len() {
        assert!(matches!(Log::read_mcap(&older[..cut]), Err(LogError::Damaged(_))), "cut at {cut}");
    }
}

#[test]
fn a_digest_that_is_changed_and_not_sealed_is_damage() {
    let log = fixture::log();
    let file = written(&log);
    let digest = log.digest().unwrap().0.to_le_bytes();
    let at = file.windows(16).rposition(|bytes| bytes == digest).unwrap();
    let mut changed = file.clone();
    changed[at] ^= 1;
    let Err(LogError::Damaged(damaged)) = Log::read_mcap(&changed) else { panic!("accepted") };
    assert_eq!((damaged.kind, damaged.sealed_ticks), (DamageKind::Changed, 3));
    assert_eq!(damaged.recovered.unwrap().sealed, None);
}
