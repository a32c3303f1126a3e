//! The file for viewers: records copied from a log, and messages by Foxglove's schemas.

use std::collections::BTreeMap;
use std::io::Write;

use mcap::records::{MessageHeader, Record};
use mcap::write::NoSeek;
use mcap::{Attachment, McapError, WriteOptions, Writer};
use prost::Message;

use super::message::SCHEMA;
use crate::export::ExportError;
use crate::run::{EXPORT_PROFILE, TICK_NANOSECONDS};

/// A file that is being written, in chunks and with an index, so that viewers can go to any time at once.
pub struct ViewerFile<W: Write> {
    writer: Writer<NoSeek<W>>,
    /// The copied schemas' and channels' new ids by their old ones.
    schemas: BTreeMap<u16, u16>,
    channels: BTreeMap<u16, u16>,
    /// The old id of the channel with the digests.
    digests: Option<u16>,
    /// The channels of this file's own messages by topic.
    own: BTreeMap<String, u16>,
}

impl<W: Write> ViewerFile<W> {
    /// Begins the file.
    pub fn begin(out: W) -> Result<Self, ExportError> {
        #[cfg(not(target_family = "wasm"))]
        const COMPRESSION: Option<mcap::Compression> = Some(mcap::Compression::Lz4);
        #[cfg(target_family = "wasm")]
        const COMPRESSION: Option<mcap::Compression> = None;
        let options = WriteOptions::new().compression(COMPRESSION).profile(EXPORT_PROFILE).library("motion-lab");
        let writer = options.disable_seeking(true).create(NoSeek::new(out)).map_err(failed)?;
        Ok(ViewerFile {
            writer,
            schemas: BTreeMap::new(),
            channels: BTreeMap::new(),
            digests: None,
            own: BTreeMap::new(),
        })
    }

    /// Whether this is the header of one of the log's digests.
    pub fn is_digest(&self, header: &MessageHeader) -> bool {
        self.digests == Some(header.channel_id)
    }

    /// Copies a record of the log. Seals, headers and the records at the end are left out: they are about the log's own
    /// bytes.
    pub fn copy(&mut self, record: Record<'_>) -> Result<(), ExportError> {
        let copied = match record {
            Record::Schema { header, data } => self
                .writer
                .add_schema(&header.name, &header.encoding, &data)
                .map(|id| self.schemas.extend([(header.id, id)])),
            Record::Channel(channel) => {
                if channel.topic == "/digest" {
                    self.digests = Some(channel.id);
                }
                let schema = self.schemas.get(&channel.schema_id).copied().unwrap_or(0);
                self.writer
                    .add_channel(schema, &channel.topic, &channel.message_encoding, &channel.metadata)
                    .map(|id| self.channels.extend([(channel.id, id)]))
            }
            Record::Message { header, data } => {
                let channel_id = self.channels.get(&header.channel_id).copied().unwrap_or(0);
                self.writer.write_to_known_channel(&MessageHeader { channel_id, ..header }, &data)
            }
            Record::Attachment { header, data, .. } => self.writer.attach(&Attachment {
                log_time: header.log_time,
                create_time: header.create_time,
                name: header.name,
                media_type: header.media_type,
                data,
            }),
            Record::Metadata(metadata) => self.writer.write_metadata(&metadata),
            _ => Ok(()),
        };
        copied.map_err(failed)
    }

    /// Writes a message of a tick.
    pub fn message(&mut self, topic: &str, schema: &str, tick: u64, message: &impl Message) -> Result<(), ExportError> {
        self.try_message(topic, schema, tick, message).map_err(failed)
    }

    fn try_message(&mut self, topic: &str, schema: &str, tick: u64, message: &impl Message) -> Result<(), McapError> {
        let channel_id = match self.own.get(topic) {
            Some(id) => *id,
            None => {
                let schema = self.writer.add_schema(schema, "protobuf", SCHEMA)?;
                let id = self.writer.add_channel(schema, topic, "protobuf", &BTreeMap::new())?;
                self.own.insert(topic.to_owned(), id);
                id
            }
        };
        let time = tick * TICK_NANOSECONDS;
        let header = MessageHeader { channel_id, sequence: tick as u32, log_time: time, publish_time: time };
        self.writer.write_to_known_channel(&header, &message.encode_to_vec())
    }

    /// Writes the end.
    pub fn finish(mut self) -> Result<(), ExportError> {
        self.writer.finish().map_err(failed)?;
        Ok(self.writer.into_inner().into_inner().flush()?)
    }
}

fn failed(error: McapError) -> ExportError {
    match error {
        McapError::Io(error) => ExportError::Write(error),
        error => ExportError::Records(std::io::Error::other(error)),
    }
}
