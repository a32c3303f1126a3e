//! `RecordWriter` writes MCAP records to memory, by the crate `mcap`, without chunks.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::{Arc, Mutex, PoisonError};

use mcap::records::MessageHeader;
use mcap::write::NoSeek;
use mcap::{WriteOptions, Writer};
use prost::Message;

use super::channel::{CHANNELS, MEDIA_TYPE, PROFILE};
use super::message::{SCHEMA, SCHEMA_2, SCHEMA_3};
use super::record::SEAL;
use super::{FORMAT_VERSION_WITH_CHANGES, FORMAT_VERSION_WITH_MANY_CHANGES, LogError, TICK_NANOSECONDS};

/// The bytes that records were written to and that no piece has taken yet.
#[derive(Clone, Default)]
struct PendingBytes(Arc<Mutex<Vec<u8>>>);

impl PendingBytes {
    /// Moves the bytes to the end of `piece`, to an empty one without copying them.
    fn move_to(&self, piece: &mut Vec<u8>) {
        let mut bytes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if piece.is_empty() {
            std::mem::swap(piece, &mut bytes);
        } else {
            piece.extend_from_slice(&bytes);
        }
        bytes.clear();
    }
}

impl Write for PendingBytes {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Writes records one after the other.
pub struct RecordWriter {
    to: Writer<NoSeek<PendingBytes>>,
    written: PendingBytes,
}

/// The failure of writing to memory, which an allocation alone could cause.
fn failed(error: mcap::McapError) -> LogError {
    LogError::Io(std::io::Error::other(error))
}

impl RecordWriter {
    /// Starts a file, with its magic bytes and its header.
    pub fn begin() -> Result<Self, LogError> {
        let written = PendingBytes::default();
        let options = WriteOptions::new().use_chunks(false).compression(None).disable_seeking(true);
        let to = options.profile(PROFILE).library(PROFILE).create(NoSeek::new(written.clone())).map_err(failed)?;
        Ok(RecordWriter { to, written })
    }

    /// Writes a metadata record.
    pub fn metadata(&mut self, name: &str, metadata: BTreeMap<String, String>) -> Result<(), LogError> {
        self.to.write_metadata(&mcap::records::Metadata { name: name.to_owned(), metadata }).map_err(failed)
    }

    /// Writes a text as an attachment. Its times are 0, because no clock is read.
    pub fn attachment(&mut self, name: String, text: &str) -> Result<(), LogError> {
        let (media_type, data) = (MEDIA_TYPE.to_owned(), text.as_bytes().into());
        self.to.attach(&mcap::Attachment { log_time: 0, create_time: 0, name, media_type, data }).map_err(failed)
    }

    /// Writes the schemas, with their compiled form, and the channels of all messages of a version of the format.
    pub fn channels(&mut self, format: &str) -> Result<(), LogError> {
        let compiled = match format {
            FORMAT_VERSION_WITH_CHANGES => SCHEMA_2,
            FORMAT_VERSION_WITH_MANY_CHANGES => SCHEMA_3,
            _ => SCHEMA,
        };
        for (id, (_, schema)) in (1..).zip(CHANNELS) {
            self.to.add_schema_with_id(id, schema, "protobuf", compiled).map_err(failed)?;
        }
        for (id, (topic, _)) in (1..).zip(CHANNELS) {
            self.to.add_channel_with_id(id, id, topic, "protobuf", &BTreeMap::new()).map_err(failed)?;
        }
        Ok(())
    }

    /// Writes a message at the time of its tick; `content` is room for its bytes.
    pub fn message(
        &mut self,
        channel: u16,
        tick: u64,
        message: &impl Message,
        content: &mut Vec<u8>,
    ) -> Result<(), LogError> {
        content.clear();
        // writing to a vector never fails
        let _ = message.encode(content);
        let time = tick * TICK_NANOSECONDS;
        // the sequence number may wrap
        let header = MessageHeader { channel_id: channel, sequence: tick as u32, log_time: time, publish_time: time };
        self.to.write_to_known_channel(&header, content).map_err(failed)
    }

    /// Writes a seal; `content` is room for its bytes.
    pub fn seal(&mut self, tick: u64, offset: u64, hash: u128, content: &mut Vec<u8>) -> Result<(), LogError> {
        content.clear();
        put_seal(content, tick, offset, hash);
        self.to.write_private_record(SEAL, content, Default::default()).map_err(failed)
    }

    /// Writes a private record, which other readers skip.
    pub fn private(&mut self, opcode: u8, content: &[u8]) -> Result<(), LogError> {
        self.to.write_private_record(opcode, content, Default::default()).map_err(failed)
    }

    /// Writes the end of the data, the summary and the footer.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.to.finish().map(|_| ()).map_err(failed)
    }

    /// Moves the bytes written since the last call to the end of `piece`.
    pub fn move_to(&self, piece: &mut Vec<u8>) {
        self.written.move_to(piece);
    }
}

/// The content of a seal.
pub fn put_seal(out: &mut Vec<u8>, tick: u64, offset: u64, hash: u128) {
    out.extend_from_slice(&tick.to_le_bytes());
    out.extend_from_slice(&offset.to_le_bytes());
    out.extend_from_slice(&hash.to_le_bytes());
}
