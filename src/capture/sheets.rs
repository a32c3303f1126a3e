//! The captures of a run over a span of ticks.

use bevy::app::App;

use super::moving::Moving;
use super::{CaptureError, Captured, Paper, Span, Subject};
use crate::recording::Run;
use crate::run::Log;

/// Calls `take` with the capture of each tick of the span that has a picture. Without `drawn` they have only words and
/// sizes. `add` adds the kinds of robots that a program has.
pub(super) fn each_tick(
    moving: &mut Moving,
    span: Span,
    drawn: bool,
    add: impl FnOnce(&mut App),
    mut take: impl FnMut(Captured) -> Result<(), CaptureError>,
) -> Result<(), CaptureError> {
    Run::show_with_robots(moving.log, add, |run| {
        let tick = run.frame().tick;
        if tick > span.to {
            return Ok(());
        }
        moving.see(run)?;
        if span.has(tick) { take(moving.captured(run, drawn)?) } else { Ok(()) }
    })
}

/// Calls `take` with the sheet of each picture of a GIF over a span of ticks, as SVG with its notes. `add` adds the
/// kinds of robots that a program has.
///
/// # Errors
/// [`CaptureError`] names what the run does not have.
pub fn sheets_with_robots(
    log: &Log,
    subject: &Subject,
    span: Span,
    paper: &Paper,
    add: impl FnOnce(&mut App),
    mut take: impl FnMut(String),
) -> Result<(), CaptureError> {
    let span = span.within(log.frames.len() as u64)?;
    each_tick(&mut Moving::new(log, subject.clone(), paper.width_px())?, span, true, add, |mut captured| {
        captured.notes.push(span.note());
        take(captured.svg(paper));
        Ok(())
    })
}
