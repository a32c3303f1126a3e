//! `Film`, a subject over a span of a recorded run's ticks.

use bevy::app::App;

use super::moving::Moving;
use super::{CaptureError, CaptureSpan, Captured, Subject};
use crate::recording::Run;
use crate::run::Log;

/// A subject over a span of a recorded run's ticks: the pictures of a GIF.
#[derive(Clone, Copy, Debug)]
pub struct Film<'a> {
    log: &'a Log,
    subject: &'a Subject,
    span: CaptureSpan,
}

impl<'a> Film<'a> {
    /// The film of a subject over a span of the log's ticks.
    ///
    /// # Errors
    /// [`CaptureError::NoTick`] names the tick that the log does not have.
    pub fn try_new(log: &'a Log, subject: &'a Subject, span: CaptureSpan) -> Result<Self, CaptureError> {
        Ok(Film { log, subject, span: span.within(log.frames().len() as u64)? })
    }

    /// Its ticks.
    pub fn span(&self) -> CaptureSpan {
        self.span
    }

    /// Calls `take` with the capture of each tick that has a picture, for a sheet of this width, pixels. `add` adds the
    /// kinds of robots that a program has.
    ///
    /// # Errors
    /// [`CaptureError`] names what the run does not have; or what `take` returns, at once.
    pub fn pictures(
        &self,
        width_px: f64,
        add: impl FnOnce(&mut App),
        take: impl FnMut(Captured) -> Result<(), CaptureError>,
    ) -> Result<(), CaptureError> {
        self.each(Moving::new(self.log, self.subject.clone(), width_px)?, true, add, take)
    }

    /// As [`pictures`](Self::pictures), with words and sizes alone: sheets of the same height, quick to make.
    ///
    /// # Errors
    /// As [`pictures`](Self::pictures).
    pub fn layouts(
        &self,
        width_px: f64,
        add: impl FnOnce(&mut App),
        take: impl FnMut(Captured) -> Result<(), CaptureError>,
    ) -> Result<(), CaptureError> {
        self.each(Moving::new(self.log, self.subject.unnamed(), width_px)?, false, add, take)
    }

    fn each(
        &self,
        mut moving: Moving,
        drawn: bool,
        add: impl FnOnce(&mut App),
        mut take: impl FnMut(Captured) -> Result<(), CaptureError>,
    ) -> Result<(), CaptureError> {
        Run::show_with_robots(self.log, add, |run| {
            let tick = run.frame().tick;
            if tick > self.span.to {
                return Ok(());
            }
            moving.see(run)?;
            if !self.span.has(tick) {
                return Ok(());
            }
            let mut captured = moving.captured(run, drawn)?;
            captured.notes.push(self.span.note());
            take(captured)
        })
    }
}
