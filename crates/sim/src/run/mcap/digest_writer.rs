//! `DigestLogWriter` writes a digest log while the run goes on.

use std::io::Write;

use super::digest_encoder::DigestEncoder;
use super::preamble::Preamble;
use super::sealed_output::SealedOutput;
use super::{DigestLog, LogError};
use crate::run::{Digest, Frame, RunDigest, Script};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// Writes a digest log: about 11 bytes a second of a run instead of its frames. Once a minute of the run its output
/// grows, and all of it is sealed.
///
/// ```
/// use motion_lab_sim::recording::{Recorder, verify_digests};
/// use motion_lab_sim::run::{DigestLog, DigestLogWriter, RunDigest, Script};
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
///
/// let (config, script) = (TourConfig { ticks: 50, ..TourConfig::default() }, Script::empty());
/// let mut run = Recorder::new(config.clone(), BOOK_SEED)?;
/// let mut digest = RunDigest::new(BOOK_SEED, &config, &script, run.frame());
/// let mut writer = DigestLogWriter::new(Vec::new(), BOOK_SEED, &config, &script, &digest)?;
/// while !run.is_complete() {
///     let frame = run.step();
///     digest.tick(frame);
///     writer.tick(frame, &digest)?;
/// }
/// let read = DigestLog::read_mcap(&writer.finish(digest.digest())?)?;
/// assert_eq!(read.log.digest, Some(digest.digest()));
/// assert_eq!(verify_digests(&read.log, |_| {})?.identical, 50);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct DigestLogWriter<W: Write> {
    out: SealedOutput<W>,
    encoder: DigestEncoder,
}

impl<W: Write> DigestLogWriter<W> {
    /// Starts a log: writes everything before the first tick. `run` is the run's digest before tick 1.
    ///
    /// # Errors
    /// [`LogError`] if the settings or the script are not valid for a run, or the output fails.
    pub fn new(out: W, seed: Seed, config: &TourConfig, script: &Script, run: &RunDigest) -> Result<Self, LogError> {
        let encoder = DigestEncoder::begin(Preamble::of_digests(seed, config, script)?, DigestLog::kept(run.digest()))?;
        let mut writer = DigestLogWriter { out: SealedOutput::new(out), encoder };
        writer.write_piece()?;
        Ok(writer)
    }

    /// Takes the next tick's frame; `run` is the run's digest with it. Writes once in 1200 ticks, and after the last.
    ///
    /// # Errors
    /// [`LogError`] when the frame is not the next tick's, is not of this run's robots, or holds a NaN (nothing is
    /// written then); or when the output fails.
    pub fn tick(&mut self, frame: &Frame, run: &RunDigest) -> Result<(), LogError> {
        self.encoder.preamble().check_frame(frame, self.encoder.ticks() + 1)?;
        if self.encoder.tick(run)? { self.write_piece() } else { Ok(()) }
    }

    /// Writes what is not written yet of a run that stops early; `run` is its digest so far. Nothing may follow.
    ///
    /// # Errors
    /// [`LogError`] when the output fails.
    pub fn stop(&mut self, run: Digest) -> Result<(), LogError> {
        if self.encoder.stop(run)? {
            self.write_piece()?;
        }
        Ok(self.out.flush()?)
    }

    /// Writes the end, flushes the output and returns it. `run` is the whole run's digest.
    ///
    /// # Errors
    /// [`LogError::Incomplete`] before the last configured tick; any other [`LogError`] if the output fails.
    pub fn finish(mut self, run: Digest) -> Result<W, LogError> {
        self.end(run)?;
        Ok(self.out.into_inner())
    }

    /// As [`finish`](Self::finish), but keeps the output if that fails. What was sealed before stays sealed.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn end(&mut self, run: Digest) -> Result<(), LogError> {
        self.encoder.finish(run)?;
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

    /// Returns the output without writing an end.
    pub fn into_inner(self) -> W {
        self.out.into_inner()
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
