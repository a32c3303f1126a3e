//! How far a command has come, on standard error where that is a terminal.

use std::io::{self, Write};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console::is_quiet;

/// How far a command has come: a bar with the rate and the time left, which disappears when the work has ended. Nothing
/// is written where standard error is no terminal, or with `--quiet`.
pub struct Progress(ProgressBar);

impl Progress {
    /// The beginning of `count` pieces of work called `what`: ticks, pictures, seeds.
    pub fn of(count: u64, what: &str) -> Self {
        let template = format!("{{bar:40}} {{pos}} of {{len}} {what}, {{per_sec}}, {{eta}} left");
        Self::begin(ProgressBar::with_draw_target(Some(count), target()), &template)
    }

    /// The beginning of `count` runs, `done` of which were made before and do not count for the rate.
    pub fn of_runs(count: u64, done: u64) -> Self {
        let template = "{bar:40} {pos} of {len} runs, {per_sec}, {eta} left{msg}";
        let progress = Self::begin(ProgressBar::with_draw_target(Some(count), target()), template);
        progress.0.set_position(done);
        progress.0.reset_eta();
        progress
    }

    /// So many runs have failed.
    pub fn failed(&self, runs: u64) {
        self.0.set_message(format!(", {runs} failed"));
    }

    /// The progress of work that nobody watches.
    pub fn none() -> Self {
        Progress(ProgressBar::hidden())
    }

    /// The beginning of work whose amount nobody knows, in words.
    pub fn unknown(what: &str) -> Self {
        let bar =
            Self::begin(ProgressBar::with_draw_target(None, target()), &format!("{{spinner}} {what}, {{elapsed}}"));
        bar.0.enable_steady_tick(Duration::from_millis(200));
        bar
    }

    fn begin(bar: ProgressBar, template: &str) -> Self {
        Progress(match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }

    /// So many pieces are done.
    pub fn at(&self, done: u64) {
        self.0.set_position(done);
    }

    /// One more piece is done.
    pub fn step(&self) {
        self.0.inc(1);
    }
}

/// An output that counts the lines written to it.
pub struct Counted<'a, W>(pub &'a mut W, pub &'a Progress);

impl<W: Write> Write for Counted<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.0.write(bytes)?;
        self.1.0.inc(bytes[..taken].iter().filter(|&&b| b == b'\n').count() as u64);
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Standard error, which shows nothing where it is no terminal.
fn target() -> ProgressDrawTarget {
    if is_quiet() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() }
}
