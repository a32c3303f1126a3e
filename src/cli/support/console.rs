//! Standard output for data, standard error for messages.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, BufWriter, ErrorKind, IsTerminal, StdoutLock, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use indicatif::ProgressBar;
use serde::Serialize;

use super::gate::stdout_is_taken;
use crate::cli::Failure;

/// Standard output. A reader that has gone away is no error: further output is dropped, and the exit code is that of
/// the command's work.
pub struct Data {
    out: BufWriter<StdoutLock<'static>>,
    closed: bool,
    is_terminal: bool,
}

impl Data {
    /// The standard output of this process.
    pub fn stdout() -> Self {
        let is_terminal = io::stdout().is_terminal();
        Data { out: BufWriter::new(io::stdout().lock()), closed: false, is_terminal }
    }

    /// Writes a line for people, [spelled out](spelled_out) where it would steer a terminal.
    pub fn line(&mut self, line: impl Display) -> Result<(), Failure> {
        self.report(&format!("{}\n", spelled_out(&line.to_string())))
    }

    /// Writes a line of data for other programs, as it is.
    pub fn data_line(&mut self, line: impl Display) -> Result<(), Failure> {
        self.report(&format!("{line}\n"))
    }

    /// Writes lines of what came of the command. Where standard output takes a file, they are notes beside it.
    fn report(&mut self, lines: &str) -> Result<(), Failure> {
        if !stdout_is_taken() {
            return self.text(lines);
        }
        if !is_quiet() {
            let _ = above_bar(|| io::stderr().lock().write_all(lines.as_bytes()));
        }
        Ok(())
    }

    /// Writes a text as it is: whole lines, which on a terminal stand above the bar of [`show_bar`].
    pub fn text(&mut self, text: &str) -> Result<(), Failure> {
        let out = &mut self.out;
        let written = if self.is_terminal {
            above_bar(|| out.write_all(text.as_bytes()).and_then(|()| out.flush()))
        } else {
            out.write_all(text.as_bytes())
        };
        self.after(written)
    }

    /// Writes a value as one line of JSON.
    pub fn json(&mut self, value: &impl Serialize) -> Result<(), Failure> {
        self.data_line(serde_json::to_string(value).map_err(Failure::internal)?)
    }

    /// Writes a file's bytes. A terminal, which would show them as nonsense, gets none.
    pub fn bytes(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        if self.is_terminal && std::str::from_utf8(bytes).is_err() {
            return Err(Failure::usage(
                "this form is not for a terminal",
                "Name a file with -o FILE, or a pipe's end.",
            ));
        }
        let written = self.out.write_all(bytes);
        self.after(written)
    }

    /// Flushes what was written so far.
    pub fn flush(&mut self) -> Result<(), Failure> {
        let written = self.out.flush();
        self.after(written)
    }

    /// Whether standard output is a terminal.
    pub fn is_terminal(&self) -> bool {
        self.is_terminal
    }

    /// Whether the reader has gone away.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Flushes the rest.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.flush()
    }

    /// The failure of something written here. A reader that has gone away is none.
    pub fn after(&mut self, written: io::Result<()>) -> Result<(), Failure> {
        match written {
            Err(_) if self.closed => Ok(()),
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(())
            }
            Err(error) => Err(Failure::Output {
                file: "standard output".into(),
                reason: format!("it can't be written: {error}"),
                next: "Send it elsewhere.".into(),
            }),
            Ok(()) => Ok(()),
        }
    }
}

/// Bytes as they are. A reader that has gone away is the error `BrokenPipe` here; [`after`](Data::after) takes it.
impl Write for Data {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// The bar of the work under way.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Makes this the bar of the work under way, above which lines are written. Returns whether it is: there is one bar at
/// a time, that of the whole work rather than those of its parts.
pub fn show_bar(bar: &ProgressBar) -> bool {
    let mut shown = BAR.lock().unwrap_or_else(PoisonError::into_inner);
    let is_free = shown.is_none();
    shown.get_or_insert_with(|| bar.clone());
    is_free
}

/// Takes the bar away.
pub fn take_bar() {
    if let Some(bar) = BAR.lock().unwrap_or_else(PoisonError::into_inner).take() {
        bar.finish_and_clear();
    }
}

/// Writes above the bar, if there is one.
fn above_bar<T>(write: impl FnOnce() -> T) -> T {
    let bar = BAR.lock().unwrap_or_else(PoisonError::into_inner).clone();
    match bar {
        Some(bar) => bar.suspend(write),
        None => write(),
    }
}

/// Whether notes are left out.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves out all further notes and progress; messages of what is wrong are still written.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether notes and progress are left out.
pub fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Writes a note, which says what was done, as [`say`] does, unless nobody wants to read it.
pub fn note(message: impl Display) {
    if !is_quiet() {
        say(message);
    }
}

/// Writes a message to standard error after the program's name, [spelled out](spelled_out) where it would steer a
/// terminal. A standard error that is closed is no error.
pub fn say(message: impl Display) {
    let _ = above_bar(|| writeln!(io::stderr().lock(), "motion-lab: {}", spelled_out(&message.to_string())));
}

/// The text with every character that could steer a terminal or turn a line round written as its number, as in
/// `\u{1b}`: control characters except line ends, and the marks of direction.
///
/// Names and texts of files may hold such characters.
fn spelled_out(text: &str) -> Cow<'_, str> {
    let steers = |c: char| {
        c != '\n' && c.is_control()
            || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(steers) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if steers(c) { plain.extend(c.escape_unicode()) } else { plain.push(c) }
    }
    Cow::Owned(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_written_as_its_number() {
        assert!(matches!(spelled_out("l'été: \u{3b8} = 1\nand so on"), Cow::Borrowed(_)));
        assert_eq!(spelled_out("a\u{1b}[31mb"), "a\\u{1b}[31mb");
        assert_eq!(
            spelled_out("\u{202e}nor\u{2069}\r\t\u{9b}\u{7f}"),
            "\\u{202e}nor\\u{2069}\\u{d}\\u{9}\\u{9b}\\u{7f}"
        );
    }
}
