//! Tests that the crate `mcap`, which shares no code with our reader and writer, reads the files we write.

use std::io::Cursor;

use mcap::read::LinearReader;
use mcap::records::Record;
use mcap::{MessageStream, Summary};
use prost::Message;

use super::*;
use crate::run::LogKind;
use crate::run::mcap::message::{FrameMessage, InputMessage};

#[test]
fn another_reader_finds_every_message_at_its_time() {
    let log = fixture::log();
    let file = written(&log);
    let mut counts = std::collections::BTreeMap::new();
    let mut frames = Vec::new();
    let mut inputs = Vec::new();
    for message in MessageStream::new(&file).unwrap() {
        let message = message.unwrap();
        let schema = message.channel.schema.clone().unwrap();
        assert_eq!((schema.encoding.as_str(), message.channel.message_encoding.as_str()), ("protobuf", "protobuf"));
        assert_eq!(message.log_time, u64::from(message.sequence) * 50_000_000);
        *counts.entry((message.channel.topic.clone(), schema.name.clone())).or_insert(0) += 1;
        match message.channel.topic.as_str() {
            "/frame" => frames.push(FrameMessage::decode(&message.data[..]).unwrap()),
            "/input" => inputs.push((message.log_time, InputMessage::decode(&message.data[..]).unwrap())),
            _ => {}
        }
    }
    let counted = |topic: &str, name: &str| counts[&(topic.to_owned(), name.to_owned())];
    assert_eq!(counted("/frame", "motion_lab.Frame"), 4);
    assert_eq!(counted("/scan", "motion_lab.Scan"), 4);
    assert_eq!(counted("/digest", "motion_lab.Digest"), 4);
    assert_eq!(counted("/input", "motion_lab.Input"), 3);
    assert_eq!(counts.len(), 4);
    assert_eq!(frames[3].robots[0].configuration, log.frames()[2].robots[0].configuration.to_vec());
    assert_eq!(inputs[2], (150_000_000, InputMessage::of(&log.recipe.script.events[2])));
}

#[test]
fn another_reader_finds_summary_attachments_and_metadata_where_it_says() {
    let log = fixture::log();
    let file = written(&log);
    let summary = Summary::read(&file).unwrap().expect("a summary");
    let stats = summary.stats.unwrap();
    assert_eq!((stats.message_count, stats.message_start_time, stats.message_end_time), (15, 0, 150_000_000));
    assert_eq!((stats.attachment_count, stats.metadata_count, stats.chunk_count), (3, 1, 0));
    assert_eq!((stats.schema_count, stats.channel_count), (4, 4));
    assert_eq!(stats.channel_message_counts, [(1, 3), (2, 4), (3, 4), (4, 4)].into());
    assert_eq!((summary.schemas.len(), summary.channels.len()), (4, 4));
    let mut texts = std::collections::BTreeMap::new();
    for index in &summary.attachment_indexes {
        let attachment = mcap::read::attachment(&file, index).unwrap(); // checks its checksum
        texts.insert(attachment.name, String::from_utf8(attachment.data.into_owned()).unwrap());
    }
    assert_eq!(texts.keys().collect::<Vec<_>>(), ["config.ron", "script.ron", "worlds/0.ron"]);
    assert_eq!(texts["script.ron"], log.recipe.script.to_ron());
    assert_eq!(texts["worlds/0.ron"], log.recipe.config.worlds[0].to_ron());
    let metadata = mcap::read::metadata(&file, &summary.metadata_indexes[0]).unwrap();
    assert_eq!(metadata.metadata["seed"], "18446744073709551614");
    assert_eq!(metadata.metadata["worlds/0.ron"], format!("{:032x}", log.recipe.config.worlds[0].content_hash()));
}

#[test]
fn the_checksums_for_other_readers_are_right() {
    let file = written(&fixture::log());
    let mut offset_of_end = None;
    let mut footer = None;
    for record in LinearReader::new(&file).unwrap() {
        match record.unwrap() {
            Record::DataEnd(end) => offset_of_end = Some(end.data_section_crc),
            Record::Footer(f) => footer = Some(f),
            _ => {}
        }
    }
    // the data end record has 13 bytes and the summary follows it
    let footer = footer.unwrap();
    let summary_start = usize::try_from(footer.summary_start).unwrap();
    assert_eq!(offset_of_end, Some(crc32fast::hash(&file[..summary_start - 13])));
    let before_crc = file.len() - 8 - 4;
    assert_eq!(footer.summary_crc, crc32fast::hash(&file[summary_start..before_crc]));
    // and the crate's incremental summary reader finds the summary
    let mut reader = mcap::sans_io::SummaryReader::new();
    let mut cursor = Cursor::new(&file);
    while let Some(event) = reader.next_event() {
        use std::io::{Read, Seek};
        match event.unwrap() {
            mcap::sans_io::SummaryReadEvent::ReadRequest(n) => {
                let read = cursor.read(reader.insert(n)).unwrap();
                reader.notify_read(read);
            }
            mcap::sans_io::SummaryReadEvent::SeekRequest(to) => {
                let at = cursor.seek(to).unwrap();
                reader.notify_seeked(at);
            }
        }
    }
    assert!(reader.finish().is_some());
}

#[test]
fn a_run_cut_short_can_still_be_read_by_others() {
    let log = fixture::log();
    let mut writer = LogWriter::new(Vec::new(), &log.recipe, LogKind::Frames, log.initial().unwrap()).unwrap();
    writer.tick(&log.frames()[0]).unwrap();
    let file = writer.into_inner();
    let messages: Vec<_> = MessageStream::new_with_options(&file, mcap::read::Options::IgnoreEndMagic.into())
        .unwrap()
        .map_while(Result::ok)
        .collect();
    assert_eq!(messages.len(), 3 + 5);
}

#[test]
fn the_summary_is_found_group_by_group() {
    let file = written(&fixture::log());
    let mut groups = Vec::new();
    let mut footer = None;
    for record in LinearReader::new(&file).unwrap() {
        match record.unwrap() {
            Record::SummaryOffset(group) => groups.push((group.group_start, group.group_length, group.group_opcode)),
            Record::Footer(found) => footer = Some(found),
            _ => {}
        }
    }
    let footer = footer.unwrap();
    assert_eq!(groups.len(), 5, "schemas, channels, statistics, and the indexes of attachments and metadata");
    // each begins with a record of its own kind, where the one before it ended
    let mut at = footer.summary_start;
    for (start, length, opcode) in groups {
        assert_eq!((start, file[start as usize]), (at, opcode));
        at += length;
    }
    assert_eq!(at, footer.summary_offset_start);
}
