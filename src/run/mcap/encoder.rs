//! `Encoder` makes the bytes of a log, piece by piece.

use std::collections::BTreeMap;

use prost::Message;
use xxhash_rust::xxh3::Xxh3;

use super::message::{DigestMessage, FrameMessage, InputMessage, SCHEMA, ScanMessage};
use super::preamble::{Indexed, Preamble};
use super::record::{MAGIC, SEAL, opcode, put_map, put_record, put_str, put_u16, put_u32, put_u64};
use super::{CHANNELS, LogError, TICK_NANOSECONDS, channel};
use crate::run::{Digest, Frame};

/// Makes the bytes of a log in pieces that end in a seal: the part before the first tick, then each tick, then the end.
/// The same run gives the same bytes. A writer writes them, and a reader compares a file with them.
#[derive(Clone)]
pub struct Encoder {
    preamble: Preamble,
    /// The hash of all bytes of the pieces so far.
    hash: Xxh3,
    crc: crc32fast::Hasher,
    length: u64,
    next_tick: u64,
    next_event: usize,
    message_counts: [u64; CHANNELS.len()],
    index: Vec<Indexed>,
    piece: Vec<u8>,
    room: Room,
}

/// Buffers that are filled again for every tick. Once they have grown, a tick allocates nothing.
#[derive(Clone, Default)]
struct Room {
    frame: FrameMessage,
    scan: ScanMessage,
    digest: DigestMessage,
    encoding: Vec<u8>,
}

impl Encoder {
    /// Starts a log: makes the piece before the first tick, with its seal.
    pub fn begin(preamble: Preamble) -> Self {
        let mut encoder = Encoder {
            preamble,
            hash: Xxh3::new(),
            crc: crc32fast::Hasher::new(),
            length: 0,
            next_tick: 1,
            next_event: 0,
            message_counts: [0; CHANNELS.len()],
            index: Vec::new(),
            piece: MAGIC.to_vec(),
            room: Room::default(),
        };
        put_record(&mut encoder.piece, opcode::HEADER, |out| {
            put_str(out, super::PROFILE);
            put_str(out, super::PROFILE);
        });
        encoder.index = encoder.preamble.put(&mut encoder.piece);
        put_schemas(&mut encoder.piece);
        put_channels(&mut encoder.piece);
        let initial = encoder.preamble.initial.clone();
        encoder.put_frame(&initial, initial.digest());
        encoder.seal(0);
        encoder
    }

    /// Makes the piece of a tick, with its seal. Returns the frame's digest.
    pub fn tick(&mut self, frame: &Frame) -> Result<Digest, LogError> {
        self.preamble.check_frame(frame, self.next_tick)?;
        self.piece.clear();
        while let Some(event) = self.preamble.script.events.get(self.next_event).filter(|e| e.tick <= frame.tick) {
            let input = InputMessage::of(event);
            put_message(&mut self.piece, &mut self.message_counts, channel::INPUT, frame.tick, &input);
            self.next_event += 1;
        }
        let digest = frame.digest_in(&mut self.room.encoding);
        self.put_frame(frame, digest);
        self.seal(frame.tick);
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
        let crc = self.crc.clone().finalize();
        put_record(&mut self.piece, opcode::DATA_END, |out| put_u32(out, crc));
        self.put_summary();
        self.piece.extend_from_slice(MAGIC);
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

    fn put_frame(&mut self, frame: &Frame, digest: Digest) {
        let (out, counts, tick) = (&mut self.piece, &mut self.message_counts, frame.tick);
        let room = &mut self.room;
        room.frame.take(frame);
        put_message(out, counts, channel::FRAME, tick, &room.frame);
        let max_range = self.preamble.config.sensor.map(|s| s.max_range);
        for scan in &frame.scans {
            room.scan.take(tick, max_range, scan);
            put_message(out, counts, channel::SCAN, tick, &room.scan);
        }
        room.digest.take(tick, digest);
        put_message(out, counts, channel::DIGEST, tick, &room.digest);
    }

    /// Ends the piece with a seal: the tick, where the seal begins, and the xxh3-128 of every byte before it.
    fn seal(&mut self, tick: u64) {
        self.hash.update(&self.piece);
        let sealed = self.piece.len();
        let (offset, hash) = (self.length + sealed as u64, self.hash.digest128());
        put_record(&mut self.piece, SEAL, |out| put_seal(out, tick, offset, hash));
        self.hash.update(&self.piece[sealed..]);
        self.crc.update(&self.piece);
        self.length += self.piece.len() as u64;
    }

    fn put_summary(&mut self) {
        let start = self.length as usize;
        let end_of_data = self.piece.len();
        let out = &mut self.piece;
        let mut groups: Vec<(u8, usize, usize)> = Vec::new();
        let mut group = |out: &mut Vec<u8>, opcode: u8, put: &dyn Fn(&mut Vec<u8>)| {
            let begin = out.len();
            put(out);
            groups.push((opcode, start + begin, out.len() - begin));
        };
        group(out, opcode::SCHEMA, &put_schemas);
        group(out, opcode::CHANNEL, &put_channels);
        let last_time = (self.next_tick - 1) * TICK_NANOSECONDS;
        group(out, opcode::STATISTICS, &|out| put_statistics(out, &self.message_counts, &self.index, last_time));
        for (of, indexed_by) in
            [(opcode::ATTACHMENT, opcode::ATTACHMENT_INDEX), (opcode::METADATA, opcode::METADATA_INDEX)]
        {
            group(out, indexed_by, &|out| {
                self.index.iter().filter(|i| i.opcode == of).for_each(|i| put_index(out, indexed_by, i));
            });
        }
        let offsets_start = start + out.len();
        for (of, begin, length) in groups {
            put_record(out, opcode::SUMMARY_OFFSET, |out| {
                out.push(of);
                put_u64(out, begin as u64);
                put_u64(out, length as u64);
            });
        }
        put_record(out, opcode::FOOTER, |out| {
            put_u64(out, (start + end_of_data) as u64);
            put_u64(out, offsets_start as u64);
            // the checksum covers the footer's opcode and length, whose final value is known though not yet written
            let crc = footer_crc(&out[end_of_data..]);
            put_u32(out, crc);
        });
    }
}

/// The content of a seal.
pub fn put_seal(out: &mut Vec<u8>, tick: u64, offset: u64, hash: u128) {
    put_u64(out, tick);
    put_u64(out, offset);
    out.extend_from_slice(&hash.to_le_bytes());
}

/// The checksum of the summary up to itself. `summary` ends in an unfinished footer: opcode, a length of 0 that stands
/// for the one to come (20), and the two offsets.
fn footer_crc(summary: &[u8]) -> u32 {
    let length_at = summary.len() - 24;
    let mut crc = crc32fast::Hasher::new();
    crc.update(&summary[..length_at]);
    crc.update(&20_u64.to_le_bytes());
    crc.update(&summary[length_at + 8..]);
    crc.finalize()
}

fn put_message(out: &mut Vec<u8>, counts: &mut [u64; CHANNELS.len()], channel: u16, tick: u64, message: &impl Message) {
    put_record(out, opcode::MESSAGE, |out| {
        put_u16(out, channel);
        put_u32(out, tick as u32); // the sequence number; it may wrap
        put_u64(out, tick * TICK_NANOSECONDS); // log time
        put_u64(out, tick * TICK_NANOSECONDS); // publish time
        // writing to a vector never fails
        let _ = message.encode(out);
    });
    counts[usize::from(channel) - 1] += 1;
}

fn put_schemas(out: &mut Vec<u8>) {
    for (id, (_, schema)) in (1..).zip(CHANNELS) {
        put_record(out, opcode::SCHEMA, |out| {
            put_u16(out, id);
            put_str(out, schema);
            put_str(out, "protobuf");
            put_u32(out, SCHEMA.len() as u32);
            out.extend_from_slice(SCHEMA);
        });
    }
}

fn put_channels(out: &mut Vec<u8>) {
    for (id, (topic, _)) in (1..).zip(CHANNELS) {
        put_record(out, opcode::CHANNEL, |out| {
            put_u16(out, id);
            put_u16(out, id); // the schema's id
            put_str(out, topic);
            put_str(out, "protobuf");
            put_map(out, &BTreeMap::new());
        });
    }
}

fn put_statistics(out: &mut Vec<u8>, counts: &[u64; CHANNELS.len()], index: &[Indexed], last_time: u64) {
    let how_many = |opcode| index.iter().filter(|i| i.opcode == opcode).count() as u32;
    put_record(out, opcode::STATISTICS, |out| {
        put_u64(out, counts.iter().sum());
        put_u16(out, CHANNELS.len() as u16); // schemas
        put_u32(out, CHANNELS.len() as u32);
        put_u32(out, how_many(opcode::ATTACHMENT));
        put_u32(out, how_many(opcode::METADATA));
        put_u32(out, 0); // chunks
        put_u64(out, 0); // the first message's time
        put_u64(out, last_time);
        let counted: Vec<(u16, u64)> = (1..).zip(*counts).filter(|(_, count)| *count > 0).collect();
        put_u32(out, counted.len() as u32 * 10);
        for (channel, count) in counted {
            put_u16(out, channel);
            put_u64(out, count);
        }
    });
}

fn put_index(out: &mut Vec<u8>, opcode: u8, indexed: &Indexed) {
    put_record(out, opcode, |out| {
        put_u64(out, indexed.offset);
        put_u64(out, indexed.length);
        if opcode == opcode::ATTACHMENT_INDEX {
            put_u64(out, 0); // log time
            put_u64(out, 0); // creation time
            put_u64(out, indexed.data_size);
        }
        put_str(out, &indexed.name);
        if opcode == opcode::ATTACHMENT_INDEX {
            put_str(out, super::MEDIA_TYPE);
        }
    });
}
