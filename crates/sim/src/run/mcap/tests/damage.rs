//! Tests every cut of the file and every flipped bit.

use super::*;
use crate::run::mcap::record::{SEAL, opcode, record_at};
use crate::run::mcap::record_writer::put_seal;

/// The offsets at which the pieces of a file end: the part before the first tick, then each tick, then the digest.
fn seals(file: &[u8]) -> Vec<usize> {
    let mut ends = Vec::new();
    let mut at = 8;
    while let Some(record) = record_at(file, at).filter(|r| r.opcode != opcode::DATA_END) {
        at = record.end();
        if record.opcode == SEAL {
            ends.push(at);
        }
    }
    ends
}

/// Reads a damaged file and returns the reported kind of damage. The recovered ticks must be the original's, exactly
/// those sealed before byte `first_bad`.
fn check_damaged(file: &[u8], first_bad: usize, original: &Log, seals: &[usize]) -> DamageKind {
    let whole_pieces = seals.iter().filter(|end| **end <= first_bad).count();
    match Log::read_mcap(file) {
        Ok(_) => panic!("accepted although byte {first_bad} is bad"),
        Err(LogError::NotALog) => {
            assert!(first_bad < 8);
            DamageKind::Changed
        }
        Err(LogError::Damaged(damaged)) => {
            let DamagedLog { recovered, sealed_ticks, first_unsealed_offset, kind } = *damaged;
            // the seal of the digest belongs to no tick
            let Some(pieces_after_first) = whole_pieces.min(4).checked_sub(1) else {
                assert!(recovered.is_none() && sealed_ticks == 0 && first_unsealed_offset == 0);
                return kind;
            };
            let ReadLog { log, .. } = recovered.unwrap_or_else(|| panic!("byte {first_bad}: nothing recovered"));
            assert_eq!(log.frames().len(), pieces_after_first, "byte {first_bad}");
            assert_eq!(sealed_ticks, pieces_after_first as u64);
            assert_eq!(first_unsealed_offset, seals[pieces_after_first] as u64);
            assert_eq!(first_divergence(&original.frames()[..pieces_after_first], log.frames()), None);
            assert_eq!(log.recipe, original.recipe);
            kind
        }
        Err(other) => panic!("byte {first_bad}: {other}"),
    }
}

#[test]
fn a_file_cut_anywhere_gives_its_sealed_beginning() {
    let log = fixture::log();
    let file = written(&log);
    let seals = seals(&file);
    assert_eq!(seals.len(), 5, "the part before the first tick, three ticks, and the run's digest");
    let mut checked = Vec::new();
    Log::read_mcap_with(&file, |bytes| checked.push(bytes as usize)).unwrap();
    assert_eq!(checked, seals[1..4], "a reader is watched from tick to tick");
    for cut in 0..file.len() {
        assert_eq!(check_damaged(&file[..cut], cut, &log, &seals), DamageKind::Cut, "cut at {cut}");
    }
}

#[test]
fn no_bit_can_flip_unseen() {
    let log = fixture::log();
    let file = written(&log);
    let seals = seals(&file);
    let flip = |odd: usize| {
        let mut file = file.clone();
        for at in (odd..file.len()).step_by(2) {
            for bit in 0..8 {
                file[at] ^= 1 << bit;
                check_damaged(&file, at, &log, &seals);
                file[at] ^= 1 << bit;
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| flip(1));
        flip(0);
    });
    assert!(Log::read_mcap(&file).is_ok());
}

#[test]
fn nothing_can_be_appended_or_put_in_unseen() {
    let log = fixture::log();
    let file = written(&log);
    let seals = seals(&file);
    for tail in [&b"\0"[..], b"\n", &file[file.len() - 8..], &file] {
        check_damaged(&[&file[..], tail].concat(), file.len(), &log, &seals);
    }
    // a record of an unknown kind, which other readers would skip, between two pieces; and a whole tick twice
    let skipped = [&[0x81, 1, 0, 0, 0, 0, 0, 0, 0, 7][..]];
    let twice = [&file[seals[0]..seals[1]]];
    for inserted in [skipped, twice] {
        let bad = [&file[..seals[1]], inserted[0], &file[seals[1]..]].concat();
        check_damaged(&bad, seals[1], &log, &seals);
    }
    let without_a_tick = [&file[..seals[1]], &file[seals[2]..]].concat();
    check_damaged(&without_a_tick, seals[1], &log, &seals);
    let without_the_digest = [&file[..seals[3]], &file[seals[4]..]].concat();
    check_damaged(&without_the_digest, seals[3], &log, &seals);
    let twice_the_digest = [&file[..seals[4]], &file[seals[3]..]].concat();
    check_damaged(&twice_the_digest, seals[4], &log, &seals);
    let without_the_end = [&file[..seals[2]], &file[seals[3]..]].concat();
    check_damaged(&without_the_end, seals[2], &log, &seals);
}

/// The file with its first piece changed by `change` and sealed again, as a program that knows the seal could do.
fn forged(file: &[u8], change: impl Fn(&mut Vec<u8>)) -> Vec<u8> {
    let seal_at = seals(file)[0] - 41; // opcode, length, 32 bytes
    let mut forged = file[..seal_at].to_vec();
    change(&mut forged);
    let (offset, hash) = (forged.len() as u64, xxhash_rust::xxh3::xxh3_128(&forged));
    forged.push(SEAL);
    forged.extend_from_slice(&32_u64.to_le_bytes());
    put_seal(&mut forged, 0, offset, hash);
    forged.extend_from_slice(&file[seal_at + 41..]);
    forged
}

fn replace(bytes: &mut [u8], from: &str, to: &str) {
    assert_eq!(from.len(), to.len());
    let at = bytes.windows(from.len()).position(|w| w == from.as_bytes()).expect(from);
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
}

#[test]
fn a_beginning_that_is_sealed_but_senseless_is_refused_by_name() {
    let file = written(&fixture::log());
    let refused = |from: &str, to: &str| {
        Log::read_mcap(&forged(&file, |bytes| replace(bytes, from, to))).expect_err(to).to_string()
    };
    assert!(Log::read_mcap(&forged(&file, |_| {})).is_ok(), "the forger makes good seals");
    assert!(refused("format\x01\0\0\x001", "format\x01\0\0\x004").contains("format version \"4\""));
    let other = refused("format\x01\0\0\x001", "format\x01\0\0\x002");
    assert!(other.starts_with("the log was not written by motion-lab"), "format 2 without a change: {other}");
    assert!(refused("ticks: 3", "ticks: x").starts_with("config.ron in the log: "));
    assert!(refused("n_rays: 3", "n_rays: 0").starts_with("the configuration: 0 rays"));
    assert!(refused("tick: 3", "tick: 0").starts_with("the script: script.ron:6: events[2]: "));
    assert!(refused("robot: \"Arm\"", "robot: \"Axe\"").starts_with("the script: events[1]: there is no robot"));
    assert!(refused("\"Car\"", "\"Cat\"").contains("content hash"), "a world that is not the one run in");
    assert!(refused("worlds/0", "worlds/1").contains("worlds/0.ron"), "in the metadata");
    assert!(refused("18446744073709551614", "18446744073709551616").starts_with("seed in the log"));
    assert!(refused("0.05", "0.06").contains("not written by motion-lab"));
    assert!(refused("chacha8", "chacha9").contains("not written by motion-lab"));
    assert!(refused("/digest", "/digset").contains("not written by motion-lab"));
    // a run of another seed is another run; the ticks that follow are not sealed for it
    let other = forged(&file, |bytes| replace(bytes, "18446744073709551614", "18446744073709551613"));
    let Err(LogError::Damaged(damaged)) = Log::read_mcap(&other) else { panic!("the ticks of another run") };
    assert_eq!((damaged.sealed_ticks, damaged.kind), (0, DamageKind::Changed));
}

#[test]
fn hostile_lengths_are_refused_quickly() {
    let file = written(&fixture::log());
    // every eight bytes that end in four zeros, all lengths among them, become the greatest number in turn
    for at in 8..file.len() - 8 {
        if file[at + 4..at + 8] == [0; 4] {
            let mut bad = file.clone();
            bad[at..at + 8].fill(0xff);
            assert!(Log::read_mcap(&bad).is_err(), "byte {at}");
        }
    }
    // and with valid seals, so that the code behind the seal meets these numbers
    let first = seals(&file)[0] - 41;
    for at in 8..first - 8 {
        let bad = forged(&file, |bytes| bytes[at..at + 8].fill(0xff));
        assert!(Log::read_mcap(&bad).is_err(), "byte {at}");
    }
    for text in [&b""[..], b"\x89", b"\x89MCAP0\r\n", b"hello, world", &[0; 64]] {
        assert!(Log::read_mcap(text).is_err());
    }
}
