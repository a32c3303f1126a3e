//! `SealedOutput`, where a log's writer puts its pieces.

use std::io::{self, Write};

/// An output that takes whole pieces, each in one `write_all`. After a failed write it takes no more.
pub struct SealedOutput<W> {
    out: W,
    failed: bool,
}

impl<W: Write> SealedOutput<W> {
    /// Takes `out` as it stands; what it already holds stays.
    pub fn new(out: W) -> Self {
        SealedOutput { out, failed: false }
    }

    /// Writes a piece whole.
    ///
    /// # Errors
    /// What the output returns, or, after a failed write, that an earlier one failed: the output may then hold half a
    /// piece, and another after it could not be read.
    pub fn put(&mut self, piece: &[u8]) -> io::Result<()> {
        if self.failed {
            return Err(io::Error::other("an earlier write failed"));
        }
        self.failed = true;
        self.out.write_all(piece)?;
        self.failed = false;
        Ok(())
    }

    /// Flushes the output.
    ///
    /// # Errors
    /// What the output returns.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    /// Returns the output.
    pub fn into_inner(self) -> W {
        self.out
    }
}
