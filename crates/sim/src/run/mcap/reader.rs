//! The reader of logs, which checks that the file is whole.

use prost::Message;
use xxhash_rust::xxh3::xxh3_128;

use super::encoder::{Encoder, MAX_DIGESTS};
use super::message::{FrameMessage, ScanMessage};
use super::page::log_bytes;
use super::preamble::Preamble;
use super::record::{Cursor, DIGESTS, MAGIC, RUN_DIGEST, Record, SEAL, message, opcode, record_at};
use super::record_writer::put_seal;
use super::{
    DamageKind, DamagedLog, EXPORT_PROFILE, FORMAT_VERSION, FORMAT_VERSION_WITH_MANY_CHANGES, LogError, OtherRun,
    ReadLog, channel,
};
use crate::run::log::DIGEST_TICKS;
use crate::run::{Digest, Frame, Log, ObstacleStates, Recorded, RunDigest, SecondDigests};

impl Log {
    /// Reads a log from the bytes of an MCAP file, or of a page that *Save as page* of the lab wrote.
    ///
    /// The reader encodes what it has read again, and accepts the file only if every byte agrees: each piece, its seal
    /// with the hash of everything before it, and the end with its summary and footer. A file that was cut, changed in
    /// any bit or appended to is therefore never `Ok`, nor is one whose end seals the digest of another run. Whoever
    /// can seal a file again can write the digest anew: compare it with one that you have from elsewhere.
    ///
    /// # Errors
    /// [`LogError::Damaged`] with everything that is sealed; [`LogError::OtherRun`] for a whole file whose seed,
    /// settings, worlds, script or frames are not those of the digest that its end seals; [`LogError::NotALog`],
    /// [`LogError::Export`], [`LogError::Page`],
    /// [`LogError::Version`]; if the part before the first tick is sealed but not valid, [`LogError::Content`],
    /// [`LogError::Config`], [`LogError::Script`] or [`LogError::Foreign`].
    pub fn read_mcap(file: &[u8]) -> Result<ReadLog, LogError> {
        Self::read_mcap_with(file, |_| {})
    }

    /// [`read_mcap`](Self::read_mcap), which calls `on_piece` after each piece with the number of bytes checked so far.
    ///
    /// # Errors
    /// As [`read_mcap`](Self::read_mcap).
    pub fn read_mcap_with(file: &[u8], mut on_piece: impl FnMut(u64)) -> Result<ReadLog, LogError> {
        let file = &*log_bytes(file)?;
        let records = first_piece(file)?.map_err(|kind| damaged(None, 0, likely(file, kind)))?;
        let preamble = Preamble::read(&records, frame_of(&records, FORMAT_VERSION, &ObstacleStates::new()))?;
        let recipe = preamble.recipe.clone();
        let (start, recorded) = match &preamble.initial {
            Some(initial) => (0, Recorded::Frames { initial: initial.clone(), frames: Vec::new() }),
            None => {
                let digests = records.iter().find(|r| r.opcode == DIGESTS);
                let start = digests.and_then(|r| words(r.content)?.get(1).copied());
                let start = start.ok_or(LogError::Foreign { offset: 0 })?;
                (start, Recorded::Digests(SecondDigests { start, digests: Vec::new(), ticks: 0, whole: None }))
            }
        };
        let (program, world_texts, format) = (preamble.program.clone(), preamble.world_texts.clone(), preamble.format);
        let mut read = ReadLog { log: Log { recipe, recorded }, program, sealed: None, world_texts, format };
        let mut encoder = Encoder::begin(preamble, start)?;
        if !file.starts_with(encoder.piece()) {
            let offset = file.iter().zip(encoder.piece()).take_while(|(a, b)| a == b).count();
            return Err(LogError::Foreign { offset: offset as u64 });
        }
        let mut at = encoder.piece().len();
        let mut run = read.log.initial().map(|initial| RunDigest::new(&read.log.recipe, initial));
        while encoder.ticks() < encoder.preamble().recipe.config.ticks {
            let piece = match (&mut read.log.recorded, &mut run) {
                (Recorded::Frames { frames, .. }, Some(run)) => {
                    next_tick(file, at, &mut encoder, run).map(|frame| frames.push(frame))
                }
                (Recorded::Digests(digests), _) => next_minute(file, at, &mut encoder).map(|minute| {
                    digests.digests.extend(minute);
                    digests.ticks = encoder.ticks();
                }),
                // frames come with the initial one
                (Recorded::Frames { .. }, None) => Err(DamageKind::Changed),
            };
            match piece {
                Ok(()) => {
                    at += encoder.piece().len();
                    on_piece(at as u64);
                }
                Err(kind) => return Err(damaged(Some(read), at, likely(file, kind))),
            }
        }
        match end(file, at, &mut encoder, &read.log.recorded)? {
            Ok(sealed) => with_digest(ReadLog { sealed, ..read }, run.as_ref()),
            Err(kind) => Err(damaged(Some(read), at, likely(file, kind))),
        }
    }
}

/// The log with the digest that its end seals.
///
/// # Errors
/// [`LogError::OtherRun`] for a log with frames of another digest.
fn with_digest(mut read: ReadLog, run: Option<&RunDigest>) -> Result<ReadLog, LogError> {
    if let Recorded::Digests(digests) = &mut read.log.recorded {
        digests.whole = read.sealed;
    }
    match (read.sealed, run.map(RunDigest::digest)) {
        (Some(sealed), Some(held)) if sealed != held => {
            Err(LogError::OtherRun(Box::new(OtherRun { read, sealed, held })))
        }
        _ => Ok(read),
    }
}

/// The records of the piece before the first tick. Its seal is checked before anything it covers is read, so that
/// damage is never reported as invalid content.
///
/// # Errors
/// [`LogError::NotALog`] and [`LogError::Export`]; within, what probably happened to a damaged piece.
fn first_piece(file: &[u8]) -> Result<Result<Vec<Record<'_>>, DamageKind>, LogError> {
    if !file.starts_with(MAGIC) {
        return if MAGIC.starts_with(file) { Ok(Err(DamageKind::Cut)) } else { Err(LogError::NotALog) };
    }
    if is_export(file) {
        return Err(LogError::Export);
    }
    let sealed = |records: Vec<_>| if is_sealed(file, &records, 0) { Ok(records) } else { Err(DamageKind::Changed) };
    Ok(piece(file, MAGIC.len()).and_then(sealed))
}

/// Whether the header marks the file as an export for viewers.
fn is_export(file: &[u8]) -> bool {
    record_at(file, MAGIC.len())
        .is_some_and(|r| r.opcode == opcode::HEADER && Cursor(r.content).str() == Some(EXPORT_PROFILE))
}

/// What probably happened: a file with an end was not cut off, wherever a record's length leads.
fn likely(file: &[u8], kind: DamageKind) -> DamageKind {
    if file.len() > MAGIC.len() && file.ends_with(MAGIC) { DamageKind::Changed } else { kind }
}

fn damaged(recovered: Option<ReadLog>, sealed_bytes: usize, kind: DamageKind) -> LogError {
    let sealed_ticks = recovered.as_ref().map_or(0, |r| r.log.ticks());
    let first_unsealed_offset = sealed_bytes as u64;
    LogError::Damaged(Box::new(DamagedLog { recovered, sealed_ticks, first_unsealed_offset, kind }))
}

/// Reads the next tick's frame. The bytes at `at` must be exactly the encoding of that frame.
fn next_tick(file: &[u8], at: usize, encoder: &mut Encoder, run: &mut RunDigest) -> Result<Frame, DamageKind> {
    let records = piece(file, at)?;
    let frame = frame_of(&records, encoder.preamble().format, encoder.obstacles()).ok_or(DamageKind::Changed)?;
    encoder.tick(&frame, run).map_err(|_| DamageKind::Changed)?;
    compare(file, at, encoder.piece())?;
    Ok(frame)
}

/// Reads the next minute's digests. The bytes at `at` must be exactly their encoding.
fn next_minute(file: &[u8], at: usize, encoder: &mut Encoder) -> Result<Vec<u64>, DamageKind> {
    // what a run that stopped early has written last is followed by nothing
    let is_stopped = !encoder.ticks().is_multiple_of(DIGEST_TICKS * MAX_DIGESTS as u64);
    if is_stopped && at < file.len() {
        return Err(DamageKind::Changed);
    }
    let records = piece(file, at)?;
    let [Record { opcode: DIGESTS, content, .. }, _] = records[..] else { return Err(DamageKind::Changed) };
    let words = words(content).ok_or(DamageKind::Changed)?;
    let Some((&tick, digests)) = words.split_first() else { return Err(DamageKind::Changed) };
    let (before, ticks) = (encoder.ticks(), encoder.preamble().recipe.config.ticks);
    let fits = tick > before
        && tick <= ticks
        && (tick - before).div_ceil(DIGEST_TICKS) == digests.len() as u64
        && digests.len() <= MAX_DIGESTS;
    if !fits {
        return Err(DamageKind::Changed);
    }
    encoder.put_digests(digests, tick).map_err(|_| DamageKind::Changed)?;
    compare(file, at, encoder.piece())?;
    Ok(digests.to_vec())
}

/// Checks the end of the file. Returns the run's digest that it seals, which a log of digests always has.
fn end(
    file: &[u8],
    at: usize,
    encoder: &mut Encoder,
    recorded: &Recorded,
) -> Result<Result<Option<Digest>, DamageKind>, LogError> {
    let is_without = record_at(file, at).is_some_and(|record| record.opcode == opcode::DATA_END);
    let sealed = match recorded {
        Recorded::Frames { .. } if is_without => Ok(None),
        Recorded::Frames { .. } => run_digest(file, at).map(Some),
        Recorded::Digests(digests) => run_digest(file, at).and_then(|whole| {
            let is_last = digests.after(digests.ticks) == Some(whole.0 as u64);
            if is_last { Ok(Some(whole)) } else { Err(DamageKind::Changed) }
        }),
    };
    let sealed = match sealed {
        Ok(sealed) => sealed,
        Err(kind) => return Ok(Err(kind)),
    };
    encoder.finish(sealed)?;
    Ok(compare(file, at, encoder.piece())
        .and_then(|()| if file.len() == at + encoder.piece().len() { Ok(sealed) } else { Err(DamageKind::Changed) }))
}

/// The digest of the whole run in the last piece of a log.
fn run_digest(file: &[u8], at: usize) -> Result<Digest, DamageKind> {
    let records = piece(file, at)?;
    let [Record { opcode: RUN_DIGEST, content, .. }, _] = records[..] else { return Err(DamageKind::Changed) };
    let bytes = content.try_into().map_err(|_| DamageKind::Changed)?;
    Ok(Digest(u128::from_le_bytes(bytes)))
}

/// The 64-bit words of a record; `None` for one that is not whole words.
fn words(content: &[u8]) -> Option<Vec<u64>> {
    let (words, rest) = content.as_chunks::<8>();
    rest.is_empty().then(|| words.iter().map(|word| u64::from_le_bytes(*word)).collect())
}

/// Checks that the file continues at `at` with `expected`.
fn compare(file: &[u8], at: usize, expected: &[u8]) -> Result<(), DamageKind> {
    let rest = file.get(at..).unwrap_or_default();
    if rest.starts_with(expected) {
        Ok(())
    } else if expected.starts_with(rest) {
        Err(DamageKind::Cut)
    } else {
        Err(DamageKind::Changed)
    }
}

/// The records from `start` up to and including the next seal.
fn piece(file: &[u8], start: usize) -> Result<Vec<Record<'_>>, DamageKind> {
    let mut records = Vec::new();
    let mut at = start;
    loop {
        let record = record_at(file, at).ok_or(DamageKind::Cut)?;
        at = record.end();
        records.push(record);
        match record.opcode {
            SEAL => return Ok(records),
            opcode::DATA_END => return Err(DamageKind::Changed),
            _ => {}
        }
    }
}

/// Whether the last of `records` is the seal of everything before it.
fn is_sealed(file: &[u8], records: &[Record<'_>], tick: u64) -> bool {
    records.last().is_some_and(|seal| {
        let mut expected = Vec::new();
        put_seal(&mut expected, tick, seal.offset as u64, xxh3_128(&file[..seal.offset]));
        seal.content == expected
    })
}

/// Decodes the frame in a piece's messages; `None` if there is none or it cannot be decoded. `before` are the obstacles
/// of the frame before.
fn frame_of(records: &[Record<'_>], format: &str, before: &ObstacleStates) -> Option<Frame> {
    let differs_from = (format == FORMAT_VERSION_WITH_MANY_CHANGES).then_some(before);
    let mut frame = None;
    let mut scans = Vec::new();
    for record in records.iter().filter(|r| r.opcode == opcode::MESSAGE) {
        let (channel, data) = message(record.content)?;
        match channel {
            channel::FRAME => frame = Some(FrameMessage::decode(data).ok()?.into_frame(differs_from, before)?),
            channel::SCAN => scans.push(ScanMessage::decode(data).ok()?.into_scan()),
            _ => {} // inputs and digests follow from the rest
        }
    }
    frame.map(|frame| Frame { scans, ..frame })
}
