//! Tests of the checked-in schema: it describes what is written, and no float in it can lose its sign.

use std::collections::BTreeMap;

use prost::Message;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{DescriptorProto, FileDescriptorProto, FileDescriptorSet};

use super::*;
use crate::run::mcap::message::*;
use crate::run::{Digest, Event, ObstacleStates, Quantized, RobotInput};

/// The schema of each format, as text and compiled.
const SCHEMAS: [(&str, &[u8]); 3] = [
    (include_str!("../../../../assets/schema/motion_lab.proto"), SCHEMA),
    (include_str!("../../../../assets/schema/motion_lab_2.proto"), SCHEMA_2),
    (include_str!("../../../../assets/schema/motion_lab_3.proto"), SCHEMA_3),
];

fn file_of(compiled: &[u8]) -> FileDescriptorProto {
    let mut set = FileDescriptorSet::decode(compiled).unwrap();
    assert_eq!(set.file.len(), 1, "it imports nothing");
    set.file.remove(0)
}

fn file() -> FileDescriptorProto {
    file_of(SCHEMA)
}

fn descriptor(name: &str) -> DescriptorProto {
    file().message_type.into_iter().find(|m| m.name() == name).expect(name)
}

#[test]
fn no_float_has_implicit_presence() {
    let mut floats = 0;
    for message in file().message_type {
        assert!(message.nested_type.is_empty(), "nested messages would escape this test");
        for field in message.field.iter().filter(|f| matches!(f.r#type(), Type::Double | Type::Float)) {
            floats += 1;
            let kept = field.label() == Label::Repeated || field.proto3_optional();
            assert!(kept, "{}.{} would lose the sign of -0.0", message.name(), field.name());
        }
    }
    assert_eq!(floats, 7, "time, max_range, configuration, extra, target, ranges, values");
}

#[test]
fn the_text_and_the_compiled_schema_are_one() {
    let words = |f: &prost_types::FieldDescriptorProto| {
        let kind = match f.r#type() {
            Type::Double => "double",
            Type::Uint64 => "uint64",
            Type::Uint32 => "uint32",
            Type::Sint32 => "sint32",
            Type::Bool => "bool",
            Type::String => "string",
            Type::Message => f.type_name().rsplit('.').next().unwrap_or_default(),
            other => panic!("a type the schema should not need: {other:?}"),
        };
        let label = match (f.label(), f.proto3_optional()) {
            (Label::Repeated, _) => "repeated ",
            (_, true) => "optional ",
            _ => "",
        };
        format!("{label}{kind} {} = {};", f.name(), f.number())
    };
    for (proto, compiled) in SCHEMAS {
        // each message's lines in the text, comments left out
        let mut text: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut current = String::new();
        for line in proto.lines().map(str::trim).filter(|l| !l.starts_with("//")) {
            if let Some(name) = line.strip_prefix("message ") {
                current = name.split_whitespace().next().unwrap().to_owned();
                text.insert(current.clone(), Vec::new());
            } else if line.contains(" = ") && line != "syntax = \"proto3\";" {
                text.get_mut(&current).unwrap().push(line.to_owned());
            }
        }
        let compiled: BTreeMap<String, Vec<String>> = file_of(compiled)
            .message_type
            .iter()
            .map(|m| (m.name().to_owned(), m.field.iter().map(words).collect()))
            .collect();
        assert_eq!(compiled, text, "compile the text again: see its first lines");
    }
}

/// Walks encoded bytes by the descriptor alone and notes every field met. Fails on a field that the descriptor lacks or
/// that has another wire type.
fn walk(name: &str, mut bytes: &[u8], met: &mut BTreeMap<String, Vec<String>>) {
    let message = descriptor(name);
    while !bytes.is_empty() {
        let key = prost::encoding::decode_varint(&mut bytes).unwrap();
        let (number, wire) = (i32::try_from(key >> 3).unwrap(), key & 7);
        let field = message.field.iter().find(|f| f.number() == number);
        let field = field.unwrap_or_else(|| panic!("{name} has no field {number}"));
        let seen = met.entry(name.to_owned()).or_default();
        if !seen.contains(&field.name().to_owned()) {
            seen.push(field.name().to_owned());
        }
        let repeated = field.label() == Label::Repeated;
        let expected_wire = match field.r#type() {
            Type::Message | Type::String => 2,
            _ if repeated => 2, // packed
            Type::Double => 1,
            _ => 0,
        };
        assert_eq!(wire, expected_wire, "{name}.{}", field.name());
        match wire {
            0 => drop(prost::encoding::decode_varint(&mut bytes).unwrap()),
            1 => bytes = &bytes[8..],
            _ => {
                let length = usize::try_from(prost::encoding::decode_varint(&mut bytes).unwrap()).unwrap();
                let (content, rest) = bytes.split_at(length);
                bytes = rest;
                match field.r#type() {
                    Type::Message => walk(field.type_name().rsplit('.').next().unwrap(), content, met),
                    Type::Double => assert_eq!(length % 8, 0),
                    Type::String => assert!(str::from_utf8(content).is_ok()),
                    _ => {}
                }
            }
        }
    }
}

#[test]
fn what_is_written_is_what_the_schema_says() {
    let mut frame = fixture::frame(7);
    // every field away from its default, which proto3 leaves out
    for (i, robot) in (1..).zip(&mut frame.robots) {
        robot.id = i;
        robot.extra.push(1.0);
        robot.channels = [1, -1];
        robot.target.push(1.0);
        (robot.manual, robot.in_contact) = (true, true);
        (robot.contacts, robot.flash, robot.refusals) = (1, 2, 3);
    }
    let mut met = BTreeMap::new();
    let mut frame_message = FrameMessage::default();
    frame_message.take(&frame, None);
    frame.scans[0].robot = 1;
    let mut scan_message = ScanMessage::default();
    scan_message.take(7, Some(4.0), &frame.scans[0]);
    let mut digest_message = DigestMessage::default();
    digest_message.take(7, Digest(1));
    walk("Frame", &frame_message.encode_to_vec(), &mut met);
    walk("Scan", &scan_message.encode_to_vec(), &mut met);
    walk("Digest", &digest_message.encode_to_vec(), &mut met);
    let quantized = || vec![Quantized(1 << 19)];
    let inputs = [
        RobotInput::Drive(1, -1),
        RobotInput::MoveTo(quantized()),
        RobotInput::Teleport(quantized()),
        RobotInput::SetTrailer(false),
        RobotInput::Release,
    ];
    // the names, which the bytes don't have, from the Rust types' own printing
    let mut printed = format!("{frame_message:?} {scan_message:?} {digest_message:?}");
    for input in inputs {
        let message = InputMessage::of(&Event { tick: 7, robot: "Car".into(), input });
        walk("Input", &message.encode_to_vec(), &mut met);
        printed.push_str(&format!("{message:?}").replace("DriveMessage", "drive: "));
    }
    for (variant, field) in
        [("MoveTo", "move_to"), ("Teleport", "teleport"), ("SetTrailer", "set_trailer"), ("Release", "release")]
    {
        assert!(printed.contains(variant));
        printed.push_str(&format!(" {field}: "));
    }
    for message in file().message_type {
        for field in &message.field {
            let seen = met.get(message.name()).is_some_and(|seen| seen.iter().any(|s| s == field.name()));
            assert!(seen, "{}.{} is in the schema but was never written", message.name(), field.name());
            assert!(printed.contains(&format!("{}: ", field.name())), "{}.{}", message.name(), field.name());
        }
    }
}

#[test]
fn every_number_survives_a_message_bit_for_bit() {
    let numbers =
        [-0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY, 4.9e-324, -4.9e-324, f64::MIN_POSITIVE, f64::MAX, 1.0 / 3.0];
    let mut frame = fixture::frame(1);
    frame.robots[0].extra = numbers.into_iter().collect();
    frame.scans.clear();
    let mut message = FrameMessage::default();
    message.take(&frame, None);
    let bytes = message.encode_to_vec();
    let back = FrameMessage::decode(&bytes[..]).unwrap().into_frame(None, &ObstacleStates::new()).unwrap();
    assert_eq!(first_divergence(&[frame], &[back]), None);
    for x in numbers {
        let scan = ScanMessage { tick: 0, robot: 0, max_range: Some(x), ranges: vec![x] };
        let back = ScanMessage::decode(&scan.encode_to_vec()[..]).unwrap();
        assert_eq!(back.max_range.map(f64::to_bits), Some(x.to_bits()), "{x:?}");
        assert_eq!(back.ranges[0].to_bits(), x.to_bits(), "{x:?}");
    }
}
