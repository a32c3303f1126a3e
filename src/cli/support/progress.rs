//! How far a command has come, on standard error where that is a terminal.

use std::fmt;
use std::io::{self, Write};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::console::{is_quiet, show_bar, take_bar};

/// How far a command has come: a bar with the rate and the time left, and the counts in a line of their own, so that
/// both lines fit a terminal of 40 columns. They disappear when the work has ended. Nothing
/// is written where standard error is no terminal, or with `--quiet`, or where the bar of a larger work is there.
pub struct CommandProgress {
    bar: ProgressBar,
    is_shown: bool,
}

impl CommandProgress {
    /// The beginning of `count` pieces of work called `what`: ticks, pictures, seeds.
    pub fn of(count: u64, what: &str) -> Self {
        let template = format!("{{wide_bar}} {{rate}}, {{eta}} left\n{{pos}} of {{len}} {what}");
        Self::begin(ProgressBar::with_draw_target(Some(count), target()), &template)
    }

    /// The beginning of reading `count` bytes.
    pub fn of_bytes(count: u64) -> Self {
        let template = "{wide_bar} {bytes_per_sec}, {eta} left\n{bytes} of {total_bytes}";
        Self::begin(ProgressBar::with_draw_target(Some(count), target()), template)
    }

    /// The beginning of pieces of work whose number nobody knows, called `what`.
    pub fn uncounted(what: &str) -> Self {
        let template = format!("{{spinner}} {{pos}} {what}, {{rate}}, {{elapsed}}");
        Self::begin(ProgressBar::with_draw_target(None, target()), &template)
    }

    /// The beginning of `count` runs, `done` of which were made before and do not count for the rate.
    pub fn of_runs(count: u64, done: u64) -> Self {
        let template = "{wide_bar} {rate}, {eta} left\n{pos} of {len} runs{msg}";
        let progress = Self::begin(ProgressBar::with_draw_target(Some(count), target()), template);
        progress.bar.set_position(done);
        progress.bar.reset_eta();
        progress
    }

    /// This number of runs has failed.
    pub fn failed(&self, runs: u64) {
        self.bar.set_message(format!(", {runs} failed"));
    }

    /// The progress of work that nobody watches.
    pub fn none() -> Self {
        CommandProgress { bar: ProgressBar::hidden(), is_shown: false }
    }

    fn begin(bar: ProgressBar, template: &str) -> Self {
        let rate = |state: &ProgressState, out: &mut dyn fmt::Write| {
            let rate = state.per_sec();
            // writing into a string can't fail
            let _ = if rate < 10.0 { write!(out, "{rate:.1}/s") } else { write!(out, "{rate:.0}/s") };
        };
        let bar = match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style.with_key("rate", rate)),
            Err(_) => bar,
        };
        if show_bar(&bar) { CommandProgress { bar, is_shown: true } } else { CommandProgress::none() }
    }

    /// This number of pieces is done.
    pub fn at(&self, done: u64) {
        self.bar.set_position(done);
    }

    /// There are this many pieces in all, as far as is known now.
    pub fn expect(&self, count: u64) {
        self.bar.set_length(count);
    }

    /// One more piece is done.
    pub fn step(&self) {
        self.add(1);
    }

    /// `pieces` more are done.
    pub fn add(&self, pieces: u64) {
        self.bar.inc(pieces);
    }
}

/// An input that counts the bytes read from it.
pub struct Read<'a, R>(pub R, pub &'a CommandProgress);

impl<R: io::Read> io::Read for Read<'_, R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.0.read(bytes)?;
        self.1.add(read as u64);
        Ok(read)
    }
}

/// An output that counts the lines written to it.
pub struct CountedWriter<'a, W>(pub &'a mut W, pub &'a CommandProgress);

impl<W: Write> Write for CountedWriter<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.0.write(bytes)?;
        self.1.add(bytes[..taken].iter().filter(|&&b| b == b'\n').count() as u64);
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Drop for CommandProgress {
    fn drop(&mut self) {
        if self.is_shown {
            take_bar();
        }
    }
}

/// Standard error, which shows nothing where it is no terminal.
fn target() -> ProgressDrawTarget {
    if is_quiet() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() }
}
