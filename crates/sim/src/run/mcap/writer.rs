//! `LogWriter` writes a log while the run goes on.

use std::io::Write;

use super::encoder::{Encoder, MAX_DIGESTS};
use super::preamble::Preamble;
use super::sealed_output::SealedOutput;
use super::{LogError, ReadLog};
use crate::run::log::DIGEST_TICKS;
use crate::run::{Digest, Frame, Log, LogKind, Recipe, Recorded, RunDigest};

/// Writes a log tick by tick. The output only grows, and all of it is sealed: with frames after each tick, with digests
/// once in 1200 ticks. A run that is killed thus leaves what was sealed readable.
///
/// Each piece is one `write_all`. After a failed write nothing more is written.
///
/// ```
/// use motion_lab_sim::recording::{Recorder, verify};
/// use motion_lab_sim::run::{Log, LogKind, LogWriter, Recipe};
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
///
/// let recipe = Recipe::new(TourConfig { ticks: 50, ..TourConfig::default() }, BOOK_SEED);
/// let mut run = Recorder::of(&recipe)?;
/// // about 11 bytes a second instead of the frames
/// let mut writer = LogWriter::new(Vec::new(), &recipe, LogKind::Digests, run.frame())?;
/// while !run.is_complete() {
///     writer.tick(run.step())?;
/// }
/// let digest = writer.digest();
/// let read = Log::read_mcap(&writer.finish()?)?;
/// assert_eq!(read.log.digest(), Some(digest));
/// assert_eq!(verify(&read.log, |_| {})?.identical, 50);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct LogWriter<W: Write> {
    out: SealedOutput<W>,
    encoder: Encoder,
    run: RunDigest,
}

impl<W: Write> LogWriter<W> {
    /// Starts a log of this kind: writes everything before the first tick.
    ///
    /// # Errors
    /// [`LogError`] if the settings, the script or the initial frame are not valid for a run, or the output fails.
    pub fn new(out: W, recipe: &Recipe, kind: LogKind, initial: &Frame) -> Result<Self, LogError> {
        let run = RunDigest::new(recipe, initial);
        let encoder = Encoder::begin(Preamble::new(recipe, kind, initial)?, run.lower_half())?;
        let mut writer = LogWriter { out: SealedOutput::new(out), encoder, run };
        writer.write_piece()?;
        Ok(writer)
    }

    /// Resumes a log with frames that was cut short. `read` is the recovered log; `out` must continue where its
    /// [`sealed bytes`](super::DamagedLog::first_unsealed_offset) end. Writes nothing yet.
    ///
    /// # Errors
    /// [`LogError::NoFrames`] for a log of digests; any other [`LogError`] if `read` was changed and is no longer the
    /// beginning of a run.
    pub fn resume(out: W, read: &ReadLog) -> Result<Self, LogError> {
        let initial = read.log.initial().ok_or(LogError::NoFrames)?;
        let mut run = RunDigest::new(&read.log.recipe, initial);
        let mut encoder = Encoder::begin(Preamble::of_read(read), run.lower_half())?;
        for frame in read.log.frames() {
            encoder.tick(frame, &mut run)?;
        }
        Ok(LogWriter { out: SealedOutput::new(out), encoder, run })
    }

    /// Takes the next tick, and writes and seals what is due with it.
    ///
    /// # Errors
    /// [`LogError`] when the frame is not the next tick's, is not of this run's robots, or holds a NaN (nothing is
    /// written then); or when the output fails.
    pub fn tick(&mut self, frame: &Frame) -> Result<(), LogError> {
        if self.encoder.tick(frame, &mut self.run)? { self.write_piece() } else { Ok(()) }
    }

    /// Writes what is not written yet of a run that stops early, and flushes the output. Nothing may follow.
    ///
    /// # Errors
    /// [`LogError`] when the output fails.
    pub fn stop(&mut self) -> Result<(), LogError> {
        if self.encoder.stop(&self.run)? {
            self.write_piece()?;
        }
        Ok(self.out.flush()?)
    }

    /// Writes the end, flushes the output and returns it.
    ///
    /// # Errors
    /// [`LogError::Incomplete`] before the last configured tick; any other [`LogError`] if the output fails.
    pub fn finish(mut self) -> Result<W, LogError> {
        self.end()?;
        Ok(self.out.into_inner())
    }

    /// Writes the end and flushes the output, as [`finish`](Self::finish) does, but keeps the output if that fails.
    /// What was sealed before stays sealed.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn end(&mut self) -> Result<(), LogError> {
        self.encoder.finish(Some(self.run.digest()))?;
        self.write_piece()?;
        Ok(self.out.flush()?)
    }

    /// Flushes the output, so that a buffer holds nothing back.
    ///
    /// # Errors
    /// [`LogError::Io`] when the output fails.
    pub fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.out.flush()?)
    }

    /// Returns the output without writing an end. A log with frames can be resumed.
    pub fn into_inner(self) -> W {
        self.out.into_inner()
    }

    /// The digest of the run so far.
    pub fn digest(&self) -> Digest {
        self.run.digest()
    }

    /// Number of ticks taken.
    pub fn ticks(&self) -> u64 {
        self.encoder.ticks()
    }

    /// Number of bytes written, all of them sealed.
    pub fn sealed_bytes(&self) -> u64 {
        self.encoder.length()
    }

    fn write_piece(&mut self) -> Result<(), LogError> {
        Ok(self.out.put(self.encoder.piece())?)
    }
}

impl Log {
    /// Writes the log as MCAP. The same log gives the same bytes.
    ///
    /// # Errors
    /// [`LogError`] if this is not a whole run (missing frames or digests, a NaN), or the output fails.
    pub fn write_mcap(&self, out: impl Write) -> Result<(), LogError> {
        let digests = match &self.recorded {
            Recorded::Frames { initial, frames } => {
                let mut writer = LogWriter::new(out, &self.recipe, LogKind::Frames, initial)?;
                frames.iter().try_for_each(|frame| writer.tick(frame))?;
                writer.finish()?;
                return Ok(());
            }
            Recorded::Digests(digests) => digests,
        };
        let (recorded, ticks) = (digests.ticks, self.recipe.config.ticks);
        let whole = digests.whole.ok_or(LogError::Incomplete { recorded, ticks })?;
        let mut out = SealedOutput::new(out);
        let mut encoder = Encoder::begin(Preamble::of_digests(&self.recipe)?, digests.start)?;
        out.put(encoder.piece())?;
        for (minute, digests) in (1..).zip(digests.digests.chunks(MAX_DIGESTS)) {
            encoder.put_digests(digests, std::cmp::min(minute * MAX_DIGESTS as u64 * DIGEST_TICKS, ticks))?;
            out.put(encoder.piece())?;
        }
        encoder.finish(Some(whole))?;
        out.put(encoder.piece())?;
        Ok(out.flush()?)
    }
}
