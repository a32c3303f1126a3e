//! The messages of a log by protobuf's wire format and the field numbers of assets/schema/motion_lab.proto. Our own
//! decoder is not used, because it could share a mistake with the encoder.

use std::collections::BTreeMap;
use std::fs;

use motion_lab::run::{Log, RobotInput};

use crate::cli::runs::columns::{driven, frames, write};

/// A message by its field numbers: numbers of any width as 64 bits, everything else as bytes.
pub struct Wire(Vec<(u64, Field)>);

enum Field {
    Number(u64),
    Bytes(Vec<u8>),
}

fn varint(bytes: &mut &[u8]) -> u64 {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (first, rest) = bytes.split_first().unwrap();
        *bytes = rest;
        value |= u64::from(first & 0x7f) << shift;
        if first & 0x80 == 0 {
            return value;
        }
    }
    panic!("a number of more than 64 bits");
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> &'a [u8] {
    let (head, rest) = bytes.split_at(count);
    *bytes = rest;
    head
}

/// A signed number in sint32's encoding: 0, -1, 1, -2, ...
fn signed(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

impl Wire {
    pub fn read(mut bytes: &[u8]) -> Wire {
        let mut fields = Vec::new();
        while !bytes.is_empty() {
            let key = varint(&mut bytes);
            let field = match key & 7 {
                0 => Field::Number(varint(&mut bytes)),
                1 => Field::Number(u64::from_le_bytes(take(&mut bytes, 8).try_into().unwrap())),
                5 => Field::Number(u32::from_le_bytes(take(&mut bytes, 4).try_into().unwrap()).into()),
                2 => {
                    let count = varint(&mut bytes) as usize;
                    Field::Bytes(take(&mut bytes, count).to_vec())
                }
                other => panic!("wire type {other}"),
            };
            fields.push((key >> 3, field));
        }
        Wire(fields)
    }

    /// The numbers of the fields present, each once.
    pub fn fields(&self) -> Vec<u64> {
        let mut numbers: Vec<u64> = self.0.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    fn all(&self, number: u64) -> impl Iterator<Item = &[u8]> {
        let of_number = self.0.iter().filter(move |(n, _)| *n == number);
        of_number.map(|(n, field)| match field {
            Field::Bytes(bytes) => &bytes[..],
            Field::Number(_) => panic!("field {n} is a number"),
        })
    }

    /// A number; 0 where it is left out.
    pub fn number(&self, number: u64) -> u64 {
        self.0.iter().rfind(|(n, _)| *n == number).map_or(0, |(n, field)| match field {
            Field::Number(x) => *x,
            Field::Bytes(_) => panic!("field {n} is no number"),
        })
    }

    pub fn double(&self, number: u64) -> f64 {
        f64::from_bits(self.number(number))
    }

    pub fn text(&self, number: u64) -> String {
        self.all(number).last().map_or(String::new(), |bytes| String::from_utf8(bytes.to_vec()).unwrap())
    }

    pub fn messages(&self, number: u64) -> Vec<Wire> {
        self.all(number).map(Wire::read).collect()
    }

    /// A message; an empty one where it is left out.
    pub fn message(&self, number: u64) -> Wire {
        self.messages(number).pop().unwrap_or(Wire(Vec::new()))
    }

    /// Bytes; none where they are left out.
    pub fn bytes(&self, number: u64) -> &[u8] {
        self.all(number).last().unwrap_or(&[])
    }

    /// A packed list of doubles.
    pub fn doubles(&self, number: u64) -> Vec<f64> {
        let bytes = self.all(number).collect::<Vec<_>>().concat();
        bytes.chunks(8).map(|x| f64::from_le_bytes(x.try_into().unwrap())).collect()
    }

    /// A packed list of fixed32.
    pub fn fixed32s(&self, number: u64) -> Vec<u32> {
        let bytes = self.all(number).collect::<Vec<_>>().concat();
        bytes.chunks(4).map(|x| u32::from_le_bytes(x.try_into().unwrap())).collect()
    }

    /// A packed list of sint32.
    fn sints(&self, number: u64) -> Vec<i64> {
        let bytes = self.all(number).collect::<Vec<_>>().concat();
        let (mut rest, mut list) = (&bytes[..], Vec::new());
        while !rest.is_empty() {
            list.push(signed(varint(&mut rest)));
        }
        list
    }
}

/// The messages of an MCAP file by topic, each with its tick, from the message's times: a tick is 50 ms.
pub fn messages(bytes: &[u8]) -> BTreeMap<String, Vec<(u64, Wire)>> {
    let mut topics: BTreeMap<String, Vec<(u64, Wire)>> = BTreeMap::new();
    for message in mcap::MessageStream::new(bytes).unwrap() {
        let message = message.unwrap();
        let tick = u64::from(message.sequence);
        assert_eq!((message.log_time, message.publish_time), (tick * 50_000_000, tick * 50_000_000));
        topics.entry(message.channel.topic.clone()).or_default().push((tick, Wire::read(&message.data)));
    }
    topics
}

#[track_caller]
fn same_bits(found: &[f64], expected: &[f64]) {
    let bits = |list: &[f64]| list.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(found), bits(expected), "{found:?}, not {expected:?}");
}

/// The driven run with one frame of distinct numbers and a scan with every sort of range.
fn planted() -> Log {
    let folder = tempfile::tempdir().unwrap();
    let (_, mut log) = driven(folder.path());
    let robot = &mut log.frames_mut()[6].robots[1];
    robot.channels = [-7, 100];
    (robot.contacts, robot.flash, robot.refusals) = (31, 41, 59);
    (robot.manual, robot.in_contact) = (true, false);
    robot.target = [0.25, -0.0].into_iter().collect();
    robot.extra = [1.0 / 3.0].into_iter().collect();
    let next = &mut log.frames_mut()[7];
    (next.robots[1].manual, next.robots[1].in_contact) = (false, true);
    next.scans[0].ranges = [0.0, f64::INFINITY, 5e-324, 1.0 / 7.0].into();
    log
}

#[test]
fn every_field_of_every_message_of_a_log_is_the_one_that_the_schema_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let log = planted();
    let topics = messages(&fs::read(write(folder.path(), &log)).unwrap());
    assert_eq!(topics.keys().collect::<Vec<_>>(), ["/digest", "/frame", "/input", "/scan"]);
    let by_tick = topics["/frame"].iter().zip(&topics["/scan"]).zip(&topics["/digest"]);
    assert_eq!([topics["/frame"].len(), topics["/scan"].len(), topics["/digest"].len()], [321; 3]);
    for (frame, (((tick, message), (_, scan)), (_, digest))) in frames(&log).zip(by_tick) {
        assert_eq!(*tick, frame.tick);
        assert_eq!([message.number(1), scan.number(1), digest.number(1)], [frame.tick; 3]);
        assert!((message.double(2) - frame.tick as f64 / 20.0).abs() < 1e-12, "{}", message.double(2));
        let robots = message.messages(3);
        assert_eq!(robots.len(), frame.robots.len());
        for (robot, state) in robots.iter().zip(&frame.robots) {
            same_bits(&robot.doubles(2), &state.configuration);
            same_bits(&robot.doubles(3), &state.extra);
            same_bits(&robot.doubles(5), &state.target);
            assert_eq!(robot.sints(4), state.channels.map(i64::from));
            let counts = [state.id, state.contacts, state.flash, state.refusals].map(u64::from);
            assert_eq!([1, 8, 9, 10].map(|field| robot.number(field)), counts, "tick {tick}");
            assert_eq!([6, 7].map(|field| robot.number(field) == 1), [state.manual, state.in_contact], "tick {tick}");
            assert!(robot.fields().iter().all(|field| (1..=10).contains(field)), "{:?}", robot.fields());
        }
        assert_eq!((scan.number(2), scan.double(3)), (0, 1.9));
        same_bits(&scan.doubles(4), &frame.scans[0].ranges);
        assert_eq!(digest.text(2), frame.digest().to_string());
    }
    // an input is written at the tick before whose step it applies
    let events: Vec<_> = log.recipe.script.events.iter().filter(|event| event.tick <= 320).collect();
    assert_eq!(topics["/input"].len(), events.len());
    for ((tick, message), event) in topics["/input"].iter().zip(events) {
        assert_eq!((*tick, message.number(1), message.text(2)), (event.tick, event.tick, event.robot.clone()));
        let coordinates = |field| message.message(field).doubles(1);
        let kind = message.fields()[2];
        match &event.input {
            RobotInput::Drive(first, second) => {
                let drive = message.message(3);
                assert_eq!(
                    (kind, [1, 2].map(|field| signed(drive.number(field)))),
                    (3, [*first, *second].map(i64::from))
                );
            }
            RobotInput::MoveTo(q) | RobotInput::Teleport(q) => {
                let expected = if matches!(event.input, RobotInput::MoveTo(_)) { 4 } else { 5 };
                assert_eq!(kind, expected);
                same_bits(&coordinates(kind), &q.iter().map(|c| c.0 as f64 / 1_048_576.0).collect::<Vec<_>>());
            }
            RobotInput::SetTrailer(on) => assert_eq!((kind, message.number(6)), (6, u64::from(*on))),
            RobotInput::Release => assert_eq!((kind, message.message(7).fields().len()), (7, 0)),
        }
    }
}
