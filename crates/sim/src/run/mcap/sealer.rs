//! `Sealer` makes the pieces of a log, each of which ends in a seal.

use xxhash_rust::xxh3::Xxh3;

use super::LogError;
use super::record_writer::RecordWriter;

/// The pieces of a log: their bytes, and the hash and the number of all bytes so far.
pub struct Sealer {
    records: RecordWriter,
    hash: Xxh3,
    length: u64,
    piece: Vec<u8>,
    content: Vec<u8>,
}

impl Sealer {
    /// Begins a file.
    pub fn begin() -> Result<Self, LogError> {
        let (hash, piece, content) = (Xxh3::new(), Vec::new(), Vec::new());
        Ok(Sealer { records: RecordWriter::begin()?, hash, length: 0, piece, content })
    }

    /// Begins the next piece. Its records are written to the writer that this returns.
    pub fn next(&mut self) -> &mut RecordWriter {
        self.piece.clear();
        &mut self.records
    }

    /// Ends the piece with a seal: the tick, where the seal begins, and the xxh3-128 of every byte before it.
    pub fn seal(&mut self, tick: u64) -> Result<(), LogError> {
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece);
        let sealed = self.piece.len();
        let (offset, hash) = (self.length + sealed as u64, self.hash.digest128());
        self.records.seal(tick, offset, hash, &mut self.content)?;
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece[sealed..]);
        self.length += self.piece.len() as u64;
        Ok(())
    }

    /// Appends the end of the file to the piece: data end, summary, footer.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.records.finish()?;
        let before = self.piece.len();
        self.records.move_to(&mut self.piece);
        self.length += (self.piece.len() - before) as u64;
        Ok(())
    }

    /// The current piece.
    pub fn piece(&self) -> &[u8] {
        &self.piece
    }

    /// Number of bytes of all pieces so far, with the current one.
    pub fn length(&self) -> u64 {
        self.length
    }
}
