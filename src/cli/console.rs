//! Standard output for data, standard error for messages.

use std::fmt::Display;
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};

use serde::Serialize;

use super::Failure;

/// Standard output. A reader that has gone away is no error: what is written then is dropped, and the command ends with
/// the exit code that its work deserves.
pub struct Data {
    out: BufWriter<StdoutLock<'static>>,
    closed: bool,
}

impl Data {
    /// The standard output of this process.
    pub fn stdout() -> Self {
        Data { out: BufWriter::new(io::stdout().lock()), closed: false }
    }

    /// Writes a line.
    pub fn line(&mut self, line: impl Display) -> Result<(), Failure> {
        let written = writeln!(self.out, "{line}");
        self.after(written)
    }

    /// Writes a text as it is.
    pub fn text(&mut self, text: &str) -> Result<(), Failure> {
        let written = self.out.write_all(text.as_bytes());
        self.after(written)
    }

    /// Writes a value as one line of JSON.
    pub fn json(&mut self, value: &impl Serialize) -> Result<(), Failure> {
        self.line(serde_json::to_string(value).map_err(Failure::internal)?)
    }

    /// Sends on what was written so far.
    pub fn flush(&mut self) -> Result<(), Failure> {
        let written = self.out.flush();
        self.after(written)
    }

    /// Whether the reader has gone away.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Sends on the rest.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.flush()
    }

    fn after(&mut self, written: io::Result<()>) -> Result<(), Failure> {
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

/// Writes a message to standard error, every message under the program's name. Nobody listening is no error.
pub fn say(message: impl Display) {
    let _ = writeln!(io::stderr().lock(), "motion-lab: {message}");
}
