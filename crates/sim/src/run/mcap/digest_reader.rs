//! Reads a digest log and checks that it is whole.

use super::digest_encoder::{DigestEncoder, MOST_DIGESTS};
use super::digest_log::DIGEST_TICKS;
use super::preamble::{LogKind, Preamble};
use super::reader::{compare, first_piece, piece};
use super::record::{DIGESTS, RUN_DIGEST, Record};
use super::{DamageKind, DamagedDigestLog, DigestLog, LogError, ReadDigestLog};
use crate::run::Digest;

impl DigestLog {
    /// Reads a digest log from the bytes of an MCAP file.
    ///
    /// As [`Log::read_mcap`](crate::run::Log::read_mcap) it encodes what it has read again, and accepts the file only
    /// if every byte agrees.
    ///
    /// # Errors
    /// [`LogError::DamagedDigests`] with everything that is sealed; [`LogError::HasFrames`] for a log with frames;
    /// otherwise as [`Log::read_mcap`](crate::run::Log::read_mcap).
    pub fn read_mcap(file: &[u8]) -> Result<ReadDigestLog, LogError> {
        let records = first_piece(file)?.map_err(|kind| damaged(None, 0, kind))?;
        let preamble = Preamble::read(&records, LogKind::Digests, None)?;
        let start = records.iter().find(|r| r.opcode == DIGESTS).and_then(|r| words(r.content)?.get(1).copied());
        let start = start.ok_or(LogError::Foreign { offset: 0 })?;
        let (seed, config, script) = (preamble.seed, preamble.config.clone(), preamble.script.clone());
        let program = preamble.program.clone();
        let log = DigestLog { seed, config, script, start, digests: Vec::new(), ticks: 0, digest: None };
        let mut read = ReadDigestLog { log, program };
        let mut encoder = DigestEncoder::begin(preamble, start)?;
        if !file.starts_with(encoder.piece()) {
            let offset = file.iter().zip(encoder.piece()).take_while(|(a, b)| a == b).count();
            return Err(LogError::Foreign { offset: offset as u64 });
        }
        let mut at = encoder.piece().len();
        while encoder.ticks() < encoder.preamble().config.ticks {
            match next_piece(file, at, &mut encoder) {
                Ok(digests) => {
                    read.log.digests.extend(digests);
                    read.log.ticks = encoder.ticks();
                    at += encoder.piece().len();
                }
                Err(kind) => return Err(damaged(Some(read), at, kind)),
            }
        }
        match end(file, at, &mut encoder, &read.log)? {
            Ok(digest) => {
                read.log.digest = Some(digest);
                Ok(read)
            }
            Err(kind) => Err(damaged(Some(read), at, kind)),
        }
    }
}

fn damaged(recovered: Option<ReadDigestLog>, sealed_bytes: usize, kind: DamageKind) -> LogError {
    let sealed_ticks = recovered.as_ref().map_or(0, |r| r.log.ticks);
    let first_unsealed_offset = sealed_bytes as u64;
    LogError::DamagedDigests(Box::new(DamagedDigestLog { recovered, sealed_ticks, first_unsealed_offset, kind }))
}

/// The 64-bit words of a record; `None` for one that is not whole words.
fn words(content: &[u8]) -> Option<Vec<u64>> {
    let (words, rest) = content.as_chunks::<8>();
    rest.is_empty().then(|| words.iter().map(|word| u64::from_le_bytes(*word)).collect())
}

/// Reads the next piece's digests. The bytes at `at` must be exactly their encoding.
fn next_piece(file: &[u8], at: usize, encoder: &mut DigestEncoder) -> Result<Vec<u64>, DamageKind> {
    // what a run that stopped early has written last is followed by nothing
    let is_stopped = !encoder.ticks().is_multiple_of(DIGEST_TICKS * MOST_DIGESTS as u64);
    if is_stopped && at < file.len() {
        return Err(DamageKind::Changed);
    }
    let records = piece(file, at)?;
    let [Record { opcode: DIGESTS, content, .. }, _] = records[..] else { return Err(DamageKind::Changed) };
    let words = words(content).ok_or(DamageKind::Changed)?;
    let Some((&tick, digests)) = words.split_first() else { return Err(DamageKind::Changed) };
    let (before, ticks) = (encoder.ticks(), encoder.preamble().config.ticks);
    let fits = tick > before
        && tick <= ticks
        && (tick - before).div_ceil(DIGEST_TICKS) == digests.len() as u64
        && digests.len() <= MOST_DIGESTS;
    if !fits {
        return Err(DamageKind::Changed);
    }
    encoder.put(digests, tick).map_err(|_| DamageKind::Changed)?;
    compare(file, at, encoder.piece())?;
    Ok(digests.to_vec())
}

/// Reads the whole run's digest, and checks the end of the file.
fn end(
    file: &[u8],
    at: usize,
    encoder: &mut DigestEncoder,
    log: &DigestLog,
) -> Result<Result<Digest, DamageKind>, LogError> {
    let records = match piece(file, at) {
        Ok(records) => records,
        Err(kind) => return Ok(Err(kind)),
    };
    let [Record { opcode: RUN_DIGEST, content, .. }, _] = records[..] else { return Ok(Err(DamageKind::Changed)) };
    let Ok(bytes) = content.try_into() else { return Ok(Err(DamageKind::Changed)) };
    let digest = Digest(u128::from_le_bytes(bytes));
    if log.after(log.ticks) != Some(digest.0 as u64) {
        return Ok(Err(DamageKind::Changed));
    }
    encoder.finish(digest)?;
    Ok(match compare(file, at, encoder.piece()) {
        Ok(()) if file.len() == at + encoder.piece().len() => Ok(digest),
        Ok(()) => Err(DamageKind::Changed),
        Err(kind) => Err(kind),
    })
}
