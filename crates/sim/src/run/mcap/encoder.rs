//! `Encoder` makes the bytes of a log, piece by piece.

use xxhash_rust::xxh3::Xxh3;

use super::message::{DigestMessage, FrameMessage, InputMessage, SCHEMA, SCHEMA_2, ScanMessage};
use super::preamble::Preamble;
use super::record_writer::RecordWriter;
use super::{FORMAT_VERSION, LogError, channel};
use crate::run::{Digest, Frame};

/// Makes the bytes of a log in pieces that end in a seal: the part before the first tick, then each tick, then the end.
/// The same run gives the same bytes. A writer writes them, and a reader compares a file with them.
///
/// The records are those of the crate `mcap`, without chunks; a seal is a private record.
pub struct Encoder {
    preamble: Preamble,
    records: RecordWriter,
    /// The hash of all bytes of the pieces so far.
    hash: Xxh3,
    length: u64,
    next_tick: u64,
    next_event: usize,
    next_change: usize,
    piece: Vec<u8>,
    room: Room,
    /// The greatest range of each scan of the initial frame, as far as the configuration says.
    max_ranges: Vec<Option<f64>>,
}

/// Buffers that are filled again for every tick. Once they have grown, a tick allocates nothing.
#[derive(Default)]
struct Room {
    frame: FrameMessage,
    scan: ScanMessage,
    digest: DigestMessage,
    encoding: Vec<u8>,
    content: Vec<u8>,
}

impl Encoder {
    /// Starts a log: makes the piece before the first tick, with its seal.
    pub fn begin(preamble: Preamble) -> Result<Self, LogError> {
        let mut encoder = Encoder {
            preamble,
            records: RecordWriter::begin()?,
            hash: Xxh3::new(),
            length: 0,
            next_tick: 1,
            next_event: 0,
            next_change: 0,
            piece: Vec::new(),
            room: Room::default(),
            max_ranges: Vec::new(),
        };
        encoder.max_ranges = encoder.preamble.max_ranges();
        encoder.preamble.put(&mut encoder.records)?;
        let schema = if encoder.preamble.format() == FORMAT_VERSION { SCHEMA } else { SCHEMA_2 };
        encoder.records.channels(schema)?;
        let initial = encoder.preamble.initial.clone();
        encoder.put_frame(&initial, initial.digest())?;
        encoder.seal(0)?;
        Ok(encoder)
    }

    /// Makes the piece of a tick, with its seal. Returns the frame's digest.
    pub fn tick(&mut self, frame: &Frame) -> Result<Digest, LogError> {
        self.preamble.check_frame(frame, self.next_tick)?;
        self.piece.clear();
        while let Some(change) = self.preamble.script.changes.get(self.next_change).filter(|c| c.tick <= frame.tick) {
            let input = InputMessage::of_change(change);
            self.records.message(channel::INPUT, frame.tick, &input, &mut self.room.content)?;
            self.next_change += 1;
        }
        while let Some(event) = self.preamble.script.events.get(self.next_event).filter(|e| e.tick <= frame.tick) {
            let input = InputMessage::of(event);
            self.records.message(channel::INPUT, frame.tick, &input, &mut self.room.content)?;
            self.next_event += 1;
        }
        let digest = frame.digest_in(&mut self.room.encoding);
        self.put_frame(frame, digest)?;
        self.seal(frame.tick)?;
        self.next_tick += 1;
        Ok(digest)
    }

    /// Makes the piece after the last tick: data end, summary, footer.
    pub fn finish(&mut self) -> Result<(), LogError> {
        let (recorded, ticks) = (self.ticks(), self.preamble.config.ticks);
        if recorded != ticks {
            return Err(LogError::Incomplete { recorded, ticks });
        }
        self.piece.clear();
        self.records.finish()?;
        self.records.move_to(&mut self.piece);
        self.length += self.piece.len() as u64;
        Ok(())
    }

    /// The current piece.
    pub fn piece(&self) -> &[u8] {
        &self.piece
    }

    /// Number of bytes of all pieces so far, including the current one.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Number of ticks so far.
    pub fn ticks(&self) -> u64 {
        self.next_tick - 1
    }

    pub fn preamble(&self) -> &Preamble {
        &self.preamble
    }

    fn put_frame(&mut self, frame: &Frame, digest: Digest) -> Result<(), LogError> {
        let (records, tick) = (&mut self.records, frame.tick);
        let Room { frame: of_frame, scan: of_scan, digest: of_digest, content, .. } = &mut self.room;
        of_frame.take(frame);
        records.message(channel::FRAME, tick, of_frame, content)?;
        let given = self.preamble.config.sensor.map(|s| s.max_range);
        for (i, scan) in frame.scans.iter().enumerate() {
            of_scan.take(tick, self.max_ranges.get(i).copied().unwrap_or(given), scan);
            records.message(channel::SCAN, tick, of_scan, content)?;
        }
        of_digest.take(tick, digest);
        records.message(channel::DIGEST, tick, of_digest, content)
    }

    /// Ends the piece with a seal: the tick, where the seal begins, and the xxh3-128 of every byte before it.
    fn seal(&mut self, tick: u64) -> Result<(), LogError> {
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece);
        let sealed = self.piece.len();
        let (offset, hash) = (self.length + sealed as u64, self.hash.digest128());
        self.records.seal(tick, offset, hash, &mut self.room.content)?;
        self.records.move_to(&mut self.piece);
        self.hash.update(&self.piece[sealed..]);
        self.length += self.piece.len() as u64;
        Ok(())
    }
}
