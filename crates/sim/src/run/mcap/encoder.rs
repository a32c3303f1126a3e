//! `Encoder` makes the bytes of a log, piece by piece.

use super::LogError;
use super::frame_messages::FrameMessages;
use super::preamble::Preamble;
use super::record::{DIGESTS, RUN_DIGEST};
use super::sealer::Sealer;
use crate::run::log::DIGEST_TICKS;
use crate::run::{Digest, Frame, LogKind, ObstacleStates, RunDigest};

/// Largest number of digests in a record: those of a minute.
pub const MAX_DIGESTS: usize = 60;

/// Makes the bytes of a log in pieces that end in a seal: the part before the first tick; then, with frames, each tick,
/// and without, each minute; then the end. The same run gives the same bytes. A writer writes them, and a reader
/// compares a file with them.
pub struct Encoder {
    preamble: Preamble,
    sealer: Sealer,
    /// Number of ticks so far.
    ticks: u64,
    messages: FrameMessages,
    /// The digests that no piece holds yet; none in a log with frames.
    waiting: Vec<u64>,
}

impl Encoder {
    /// Starts a log: makes the piece before the first tick, with its seal. `start` is the lower half of the run's
    /// digest there, which a log of digests holds.
    pub fn begin(preamble: Preamble, start: u64) -> Result<Self, LogError> {
        let mut encoder = Encoder {
            messages: FrameMessages::new(&preamble),
            preamble,
            sealer: Sealer::begin()?,
            ticks: 0,
            waiting: Vec::new(),
        };
        let records = encoder.sealer.next();
        encoder.preamble.put(records)?;
        match &encoder.preamble.initial {
            Some(initial) => {
                records.channels(encoder.preamble.format)?;
                encoder.messages.put(records, initial)?;
                encoder.sealer.seal(0)?;
            }
            None => {
                encoder.waiting.push(start);
                encoder.pack()?;
            }
        }
        Ok(encoder)
    }

    /// Goes on by a tick, which is added to the run's digest; returns whether a piece is made.
    ///
    /// # Errors
    /// [`LogError`] for a frame that can't be this run's next; nothing is changed then.
    pub fn tick(&mut self, frame: &Frame, run: &mut RunDigest) -> Result<bool, LogError> {
        self.preamble.check_frame(frame, self.ticks + 1)?;
        run.tick(frame);
        if self.preamble.kind() == LogKind::Frames {
            let records = self.sealer.next();
            self.messages.put_inputs(records, &self.preamble.recipe.script, frame.tick)?;
            self.messages.put(records, frame)?;
            self.sealer.seal(frame.tick)?;
            self.ticks += 1;
            return Ok(true);
        }
        self.ticks += 1;
        let is_last = self.ticks == self.preamble.recipe.config.ticks;
        if !is_last && !self.ticks.is_multiple_of(DIGEST_TICKS) {
            return Ok(false);
        }
        self.waiting.push(run.lower_half());
        if !is_last && self.waiting.len() < MAX_DIGESTS {
            return Ok(false);
        }
        self.pack()?;
        Ok(true)
    }

    /// Makes the piece of these digests, the last of which is that after `tick`.
    pub fn put_digests(&mut self, digests: &[u64], tick: u64) -> Result<(), LogError> {
        self.waiting.extend_from_slice(digests);
        self.ticks = tick;
        self.pack()
    }

    /// Packs the digests not yet written when a run stops early. False if there are none.
    pub fn stop(&mut self, run: &RunDigest) -> Result<bool, LogError> {
        let is_between = !self.ticks.is_multiple_of(DIGEST_TICKS) && self.ticks < self.preamble.recipe.config.ticks;
        if self.preamble.kind() == LogKind::Digests && is_between {
            self.waiting.push(run.lower_half());
        }
        let is_any = !self.waiting.is_empty();
        if is_any {
            self.pack()?;
        }
        Ok(is_any)
    }

    /// Makes the piece after the last tick: the run's digest, with a seal, and the end of the file. `None` makes the
    /// end that logs with frames had before they sealed a digest.
    pub fn finish(&mut self, run: Option<Digest>) -> Result<(), LogError> {
        let (recorded, ticks) = (self.ticks, self.preamble.recipe.config.ticks);
        if recorded != ticks {
            return Err(LogError::Incomplete { recorded, ticks });
        }
        let records = self.sealer.next();
        if let Some(run) = run {
            records.private(RUN_DIGEST, &run.0.to_le_bytes())?;
            self.sealer.seal(ticks)?;
        }
        self.sealer.finish()
    }

    /// The current piece.
    pub fn piece(&self) -> &[u8] {
        self.sealer.piece()
    }

    /// Number of bytes of all pieces so far, including the current one.
    pub fn length(&self) -> u64 {
        self.sealer.length()
    }

    /// Number of ticks so far.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    pub fn preamble(&self) -> &Preamble {
        &self.preamble
    }

    /// The obstacles of the last tick's frame; none in a log of digests.
    pub fn obstacles(&self) -> &ObstacleStates {
        self.messages.obstacles()
    }

    /// Makes the record of the digests that wait, after the tick of the last, with its seal.
    fn pack(&mut self) -> Result<(), LogError> {
        let words = std::iter::once(self.ticks).chain(self.waiting.drain(..));
        let content: Vec<u8> = words.flat_map(u64::to_le_bytes).collect();
        self.sealer.next().private(DIGESTS, &content)?;
        self.sealer.seal(self.ticks)
    }
}
