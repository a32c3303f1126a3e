//! `LogWriter` writes a log while the run goes on.

use std::io::Write;

use super::encoder::Encoder;
use super::preamble::Preamble;
use super::sealed_output::SealedOutput;
use super::{LogError, ReadLog};
use crate::run::{Digest, Frame, Log, Script};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// Writes a log tick by tick. The output only grows, and after each tick all of it is sealed. A run that is killed thus
/// leaves every finished tick readable.
///
/// Each piece is one `write_all`. After a failed write nothing more is written.
pub struct LogWriter<W: Write> {
    out: SealedOutput<W>,
    encoder: Encoder,
}

impl<W: Write> LogWriter<W> {
    /// Starts a log: writes everything before the first tick.
    ///
    /// # Errors
    /// [`LogError`] if the settings, the script or the initial frame are not valid for a run, or the output fails.
    pub fn new(out: W, seed: Seed, config: &TourConfig, script: &Script, initial: &Frame) -> Result<Self, LogError> {
        let encoder = Encoder::begin(Preamble::new(seed, config, script, initial)?)?;
        let mut writer = LogWriter { out: SealedOutput::new(out), encoder };
        writer.write_piece()?;
        Ok(writer)
    }

    /// Resumes a log that was cut short. `read` is the recovered log; `out` must continue where its
    /// [`sealed bytes`](super::DamagedLog::first_unsealed_offset) end. Writes nothing yet.
    ///
    /// # Errors
    /// [`LogError`] if `read` was changed and is no longer the beginning of a run.
    pub fn resume(out: W, read: &ReadLog) -> Result<Self, LogError> {
        let mut encoder = Encoder::begin(read.preamble())?;
        for frame in &read.log.frames {
            encoder.tick(frame)?;
        }
        Ok(LogWriter { out: SealedOutput::new(out), encoder })
    }

    /// Writes the next tick with its seal. Returns the frame's digest.
    ///
    /// # Errors
    /// [`LogError`] when the frame is not the next tick's, is not of this run's robots, or holds a NaN (nothing is
    /// written then); or when the output fails.
    pub fn tick(&mut self, frame: &Frame) -> Result<Digest, LogError> {
        let digest = self.encoder.tick(frame)?;
        self.write_piece()?;
        Ok(digest)
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
        self.encoder.finish()?;
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

    /// Returns the output without writing an end. The log can be resumed.
    pub fn into_inner(self) -> W {
        self.out.into_inner()
    }

    /// Number of ticks written.
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
    /// [`LogError`] if this is not a whole run (missing frames, a digest that is not its frame's, a NaN), or the output
    /// fails.
    pub fn write_mcap(&self, out: impl Write) -> Result<(), LogError> {
        let mut writer = LogWriter::new(out, self.seed, &self.config, &self.script, &self.initial)?;
        for (i, frame) in self.frames.iter().enumerate() {
            let digest = writer.tick(frame)?;
            if self.digests.get(i) != Some(&digest) {
                return Err(LogError::Digest { tick: frame.tick });
            }
        }
        if self.digests.len() > self.frames.len() {
            return Err(LogError::Digest { tick: self.frames.len() as u64 + 1 });
        }
        writer.finish()?;
        Ok(())
    }
}
