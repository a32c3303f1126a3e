//! `DigestEncoder` makes the bytes of a digest log, piece by piece.

use xxhash_rust::xxh3::Xxh3;

use super::digest_log::DIGEST_TICKS;
use super::preamble::Preamble;
use super::record::{DIGESTS, RUN_DIGEST};
use super::record_writer::RecordWriter;
use super::{DigestLog, LogError};
use crate::run::{Digest, RunDigest};

/// Largest number of digests in a record: those of a minute.
pub const MOST_DIGESTS: usize = 60;

/// Makes the bytes of a digest log in pieces that end in a seal: the part before the first tick, then each minute, then
/// the end. The same run gives the same bytes.
pub struct DigestEncoder {
    preamble: Preamble,
    records: RecordWriter,
    /// The hash of all bytes of the pieces so far.
    hash: Xxh3,
    length: u64,
    ticks: u64,
    /// The digests that no piece holds yet.
    waiting: Vec<u64>,
    piece: Vec<u8>,
    content: Vec<u8>,
}

impl DigestEncoder {
    /// Starts a log: makes the piece before the first tick, with the digest there and its seal.
    pub fn begin(preamble: Preamble, start: u64) -> Result<Self, LogError> {
        let mut encoder = DigestEncoder {
            preamble,
            records: RecordWriter::begin()?,
            hash: Xxh3::new(),
            length: 0,
            ticks: 0,
            waiting: vec![start],
            piece: Vec::new(),
            content: Vec::new(),
        };
        encoder.preamble.put(&mut encoder.records)?;
        encoder.pack()?;
        Ok(encoder)
    }

    /// Goes on to the next tick, after which the run has the digest `run`. Returns whether a piece is made.
    pub fn tick(&mut self, run: &RunDigest) -> Result<bool, LogError> {
        self.ticks += 1;
        let is_last = self.ticks == self.preamble.config.ticks;
        if !is_last && !self.ticks.is_multiple_of(DIGEST_TICKS) {
            return Ok(false);
        }
        self.waiting.push(DigestLog::kept(run.digest()));
        if !is_last && self.waiting.len() < MOST_DIGESTS {
            return Ok(false);
        }
        self.pack()?;
        Ok(true)
    }

    /// Makes the piece of these digests, the last of which is that after `tick`.
    pub fn put(&mut self, digests: &[u64], tick: u64) -> Result<(), LogError> {
        self.waiting.extend_from_slice(digests);
        self.ticks = tick;
        self.pack()
    }

    /// Makes the piece of what waits, at a tick at which the run stops early. Returns whether there is anything.
    pub fn stop(&mut self, run: Digest) -> Result<bool, LogError> {
        if !self.ticks.is_multiple_of(DIGEST_TICKS) && self.ticks < self.preamble.config.ticks {
            self.waiting.push(DigestLog::kept(run));
        }
        let is_any = !self.waiting.is_empty();
        if is_any {
            self.pack()?;
        }
        Ok(is_any)
    }

    /// Makes the piece after the last tick: the run's digest with a seal, data end, summary, footer.
    pub fn finish(&mut self, digest: Digest) -> Result<(), LogError> {
        let (recorded, ticks) = (self.ticks, self.preamble.config.ticks);
        if recorded != ticks {
            return Err(LogError::Incomplete { recorded, ticks });
        }
        self.piece.clear();
        self.records.private(RUN_DIGEST, &digest.0.to_le_bytes())?;
        self.seal()?;
        self.records.finish()?;
        let sealed = self.piece.len();
        self.records.move_to(&mut self.piece);
        self.length += (self.piece.len() - sealed) as u64;
        Ok(())
    }

    /// The current piece.
    pub fn piece(&self) -> &[u8] {
        &self.piece
    }

    /// Number of bytes of all pieces so far, including the current one.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Number of ticks so far.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    pub fn preamble(&self) -> &Preamble {
        &self.preamble
    }

    /// Makes the record of the digests that wait, after the tick of the last, with its seal.
    fn pack(&mut self) -> Result<(), LogError> {
        self.piece.clear();
        self.content.clear();
        self.content.extend(std::iter::once(self.ticks).chain(self.waiting.drain(..)).flat_map(u64::to_le_bytes));
        self.records.private(DIGESTS, &self.content)?;
        self.seal()
    }

    /// Ends what was written with a seal, as in a log with frames.
    fn seal(&mut self) -> Result<(), LogError> {
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece);
        let sealed = self.piece.len();
        let (offset, hash) = (self.length + sealed as u64, self.hash.digest128());
        self.records.seal(self.ticks, offset, hash, &mut self.content)?;
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece[sealed..]);
        self.length += self.piece.len() as u64;
        Ok(())
    }
}
