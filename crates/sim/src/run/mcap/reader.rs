//! Reads a log and checks that it is whole.

use prost::Message;
use xxhash_rust::xxh3::xxh3_128;

use super::encoder::Encoder;
use super::message::{FrameMessage, ScanMessage};
use super::preamble::{LogKind, Preamble};
use super::record::{Cursor, MAGIC, Record, SEAL, message, opcode, record_at};
use super::record_writer::put_seal;
use super::{DamageKind, DamagedLog, EXPORT_PROFILE, LogError, ReadLog, channel};
use crate::run::{Frame, Log};

impl Log {
    /// Reads a log from the bytes of an MCAP file.
    ///
    /// The reader encodes what it has read again, and accepts the file only if every byte agrees: each piece, its seal
    /// with the hash of everything before it, and the end with its summary and footer. A file that was cut, changed in
    /// any bit or appended to is therefore never `Ok`.
    ///
    /// # Errors
    /// [`LogError::Damaged`] with everything that is sealed; [`LogError::NotALog`], [`LogError::Export`],
    /// [`LogError::NoFrames`] for a digest log, [`LogError::Version`]; if the part before the first tick is sealed but
    /// not valid, [`LogError::Content`], [`LogError::Config`], [`LogError::Script`] or [`LogError::Foreign`].
    pub fn read_mcap(file: &[u8]) -> Result<ReadLog, LogError> {
        Self::read_mcap_with(file, |_| {})
    }

    /// [`read_mcap`](Self::read_mcap), which calls `on_tick` after each tick with the number of bytes checked so far.
    ///
    /// # Errors
    /// As [`read_mcap`](Self::read_mcap).
    pub fn read_mcap_with(file: &[u8], mut on_tick: impl FnMut(u64)) -> Result<ReadLog, LogError> {
        let records = first_piece(file)?.map_err(|kind| damaged(None, 0, kind))?;
        let preamble = Preamble::read(&records, LogKind::Frames, frame_of(&records))?;
        let mut read = ReadLog {
            program: preamble.program.clone(),
            world_texts: preamble.world_texts.clone(),
            log: Log {
                seed: preamble.seed,
                config: preamble.config.clone(),
                script: preamble.script.clone(),
                initial: preamble.initial.clone(),
                frames: Vec::new(),
                digests: Vec::new(),
            },
        };
        let mut encoder = Encoder::begin(preamble)?;
        if !file.starts_with(encoder.piece()) {
            let offset = file.iter().zip(encoder.piece()).take_while(|(a, b)| a == b).count();
            return Err(LogError::Foreign { offset: offset as u64 });
        }
        let mut at = encoder.piece().len();
        while encoder.ticks() < encoder.preamble().config.ticks {
            match next_tick(file, at, &mut encoder) {
                Ok((frame, digest)) => {
                    read.log.frames.push(frame);
                    read.log.digests.push(digest);
                    at += encoder.piece().len();
                    on_tick(at as u64);
                }
                Err(kind) => return Err(damaged(Some(read), at, kind)),
            }
        }
        encoder.finish()?;
        match compare(file, at, encoder.piece()) {
            Ok(()) if file.len() == at + encoder.piece().len() => Ok(read),
            Ok(()) => Err(damaged(Some(read), at, DamageKind::Changed)),
            Err(kind) => Err(damaged(Some(read), at, kind)),
        }
    }
}

/// The records of the piece before the first tick. Its seal is checked before anything it covers is read, so that
/// damage is never reported as invalid content.
///
/// # Errors
/// [`LogError::NotALog`] and [`LogError::Export`]; within, what probably happened to a damaged piece.
pub fn first_piece(file: &[u8]) -> Result<Result<Vec<Record<'_>>, DamageKind>, LogError> {
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

fn damaged(recovered: Option<ReadLog>, sealed_bytes: usize, kind: DamageKind) -> LogError {
    let sealed_ticks = recovered.as_ref().map_or(0, |r| r.log.frames.len() as u64);
    LogError::Damaged(Box::new(DamagedLog {
        recovered,
        sealed_ticks,
        first_unsealed_offset: sealed_bytes as u64,
        kind,
    }))
}

/// Reads the next tick's frame. The bytes at `at` must be exactly the encoding of that frame.
fn next_tick(file: &[u8], at: usize, encoder: &mut Encoder) -> Result<(Frame, crate::run::Digest), DamageKind> {
    let frame = frame_of(&piece(file, at)?).ok_or(DamageKind::Changed)?;
    let digest = encoder.tick(&frame).map_err(|_| DamageKind::Changed)?;
    compare(file, at, encoder.piece())?;
    Ok((frame, digest))
}

/// Checks that the file continues at `at` with `expected`.
pub fn compare(file: &[u8], at: usize, expected: &[u8]) -> Result<(), DamageKind> {
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
pub fn piece(file: &[u8], start: usize) -> Result<Vec<Record<'_>>, DamageKind> {
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

/// Decodes the frame in a piece's messages; `None` if there is none or it cannot be decoded.
fn frame_of(records: &[Record<'_>]) -> Option<Frame> {
    let mut frame = None;
    let mut scans = Vec::new();
    for record in records.iter().filter(|r| r.opcode == opcode::MESSAGE) {
        let (channel, data) = message(record.content)?;
        match channel {
            channel::FRAME => frame = Some(FrameMessage::decode(data).ok()?.into_frame()?),
            channel::SCAN => scans.push(ScanMessage::decode(data).ok()?.into_scan()),
            _ => {} // inputs and digests follow from the rest
        }
    }
    frame.map(|frame| Frame { scans, ..frame })
}
