//! Logs of either kind. The first byte says what follows: `f` a file, which is sealed anew so that what lies behind its
//! seals is reached; `r` a run, which is recorded: three texts with a line `---` between them, the number of ticks, a
//! world file or nothing, and a script, and then changes of the log's bytes, three bytes each.
//!
//! A wrong reader takes a file that was changed for a whole one, another run for the one that its end seals, or panics
//! in a message that is none.

use super::refusal;
use motion_lab::recording::{Run, verify};
use motion_lab::run::{Log, LogError, LogKind, LogWriter, ReadLog, Recipe, Script};
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::World;
use xxhash_rust::xxh3::xxh3_128;

/// Most ticks that are simulated.
const MAX_TICKS: u64 = 60;

/// Most things of a world whose run is recorded, and most rays of its robots' own sensors.
const MAX_THINGS: usize = 50;
const MAX_OWN_RAYS: u64 = 2000;

/// Length of the mark that a file begins with.
const MAGIC: usize = 8;

/// The opcode of a seal, and the length of its content.
const SEAL: (u8, usize) = (0x80, 32);

/// What stands between the parts of a run.
const BREAK: &[u8] = b"\n---\n";

/// Checks what `data` says: see above.
pub fn check(data: &[u8], kind: LogKind) -> bool {
    match data.split_first() {
        Some((b'f', file)) => {
            read(file);
            read(&resealed(file)).is_some()
        }
        Some((b'r', run)) => recorded(run, kind),
        _ => false,
    }
}

/// A file with every seal made anew: of the tick it says, at its place, over all bytes before it.
fn resealed(file: &[u8]) -> Vec<u8> {
    let (mut sealed, mut at) = (file.to_vec(), MAGIC);
    while let Some((opcode, length)) = record_at(&sealed, at) {
        let content = at + 9;
        if (opcode, length) == SEAL {
            let hash = xxh3_128(&sealed[..at]);
            sealed[content + 8..content + 16].copy_from_slice(&(at as u64).to_le_bytes());
            sealed[content + 16..content + 32].copy_from_slice(&hash.to_le_bytes());
        }
        at = content + length;
    }
    sealed
}

/// The opcode and the length of the record that begins at a place; `None` if it does not end within the file.
fn record_at(file: &[u8], at: usize) -> Option<(u8, usize)> {
    let (&opcode, rest) = file.get(at..)?.split_first()?;
    let (length, rest) = rest.split_first_chunk()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    (length <= rest.len()).then_some((opcode, length))
}

/// Reads a file. What is read is written to the same bytes, or was written by another program, and its run can be
/// simulated again.
fn read(file: &[u8]) -> Option<ReadLog> {
    let read = match Log::read_mcap(file) {
        Ok(read) => read,
        Err(LogError::Damaged(damaged)) => {
            assert!(damaged.first_unsealed_offset <= file.len() as u64, "{damaged}");
            if let Some(read) = damaged.recovered {
                assert_eq!(read.log.ticks(), damaged.sealed_ticks);
                let resumed = LogWriter::resume(Vec::new(), &read);
                assert!(resumed.is_ok() || read.log.kind() == LogKind::Digests, "what is sealed can go on");
            }
            return None;
        }
        Err(error) => {
            refusal::check(&error, "");
            return None;
        }
    };
    assert_eq!(read.log.ticks(), read.log.recipe.config.ticks);
    assert!(read.sealed.is_none() || read.sealed == read.log.digest());
    let mut written = Vec::new();
    read.log.write_mcap(&mut written).expect("what is read can be written");
    assert_eq!(Log::read_mcap(&written).expect("and read").log, read.log);
    if read.log.ticks() <= MAX_TICKS {
        // it may be forged, and a world of another program's robots does not run
        let _ = verify(&read.log, |_| {});
    }
    Some(read)
}

/// Records a run, and reads its log, whole and changed.
fn recorded(data: &[u8], kind: LogKind) -> bool {
    let mut parts = parts_of(data);
    let changes = if parts.len() > 3 { parts.split_off(3).concat() } else { Vec::new() };
    let texts: Option<Vec<&str>> = parts.iter().map(|part| std::str::from_utf8(part).ok()).collect();
    let Some([ticks, world, script]) = texts.as_deref() else { return false };
    let worlds = match World::parse("world.ron", world) {
        Ok(world) if world.obstacles.len() + world.robots.len() <= MAX_THINGS => vec![world],
        _ => vec![World::workbench()],
    };
    let ticks = ticks.trim().parse().unwrap_or(1);
    let sensor = TourConfig::default().sensor.filter(|_| ticks % 2 == 1);
    let config = TourConfig { worlds, ticks: ticks.min(MAX_TICKS), sensor };
    let script = Script::parse("script.ron", script).unwrap_or(Script::empty());
    if script.check_for(&config).is_err() {
        return false;
    }
    let rays: u64 = config.worlds[0].robots.iter().map(motion_lab::worlds::Resident::own_rays).sum();
    if rays > MAX_OWN_RAYS {
        return false;
    }
    let recipe = Recipe::new(config, (BOOK_SEED, script));
    let log = match Run::record_recipe(recipe, kind, |_| {}) {
        Ok(log) => log,
        Err(error) => {
            refusal::check(&error, "");
            return false;
        }
    };
    let mut file = Vec::new();
    if let Err(error) = log.write_mcap(&mut file) {
        refusal::check(&error, "");
        return false;
    }
    let whole = read(&file).expect("what was written is read");
    assert_eq!(whole.log, log, "a log reads back as it was written");
    let verified = verify(&log, |_| {}).expect("what was recorded runs");
    assert_eq!((verified.difference, verified.identical), (None, log.ticks()), "it verifies");
    assert!(resealed(&file) == file, "the seals are those of their bytes");
    damaged(&file, &whole, &changes);
    true
}

/// The parts of a run's text.
fn parts_of(data: &[u8]) -> Vec<&[u8]> {
    let (mut parts, mut rest) = (Vec::new(), data);
    while let Some(end) = rest.windows(BREAK.len()).position(|window| window == BREAK) {
        parts.push(&rest[..end]);
        rest = &rest[end + BREAK.len()..];
    }
    parts.push(rest);
    parts
}

/// Changes the bytes of a log: three bytes say where, and what is added. It is then no whole log, and sealed anew it is
/// refused or says something else.
fn damaged(file: &[u8], whole: &ReadLog, changes: &[u8]) {
    let mut forged = file.to_vec();
    for change in changes.as_chunks::<3>().0 {
        let at = usize::from(u16::from_le_bytes([change[0], change[1]])) * file.len() / 65_536;
        forged[at] = forged[at].wrapping_add(change[2]);
    }
    if forged == file {
        return;
    }
    assert!(Log::read_mcap(&forged).is_err(), "a change without its seal");
    let sealed = resealed(&forged);
    // a change of a seal alone is taken back
    if let Some(other) = read(&sealed).filter(|_| sealed != file) {
        assert_ne!(other, *whole, "a change that nothing shows");
    }
}
