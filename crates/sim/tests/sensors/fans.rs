//! Fans of rays in the files for both viewers: where each ray points is worked out from the words of the format, and
//! the messages are read by protobuf's wire format and the field numbers of Foxglove's schema.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use motion_lab_core::num::{cos, sin};
use motion_lab_core::prelude::*;
use motion_lab_sim::export::{write_foxglove, write_rerun};
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Log, RobotInput, Script};

use super::own_sensors::config;

/// A sensor of the car: its name, its rays, its field of view, and where it is mounted.
type MountedFan = (&'static str, u32, f64, [f64; 3]);

/// From a single ray to a full turn, of odd and even numbers of rays.
const FANS: [MountedFan; 7] = [
    ("a hair", 5, 0.001, [0.5, 0.0, 0.0]),
    ("half", 181, 3.0, [3.3, 0.0, 0.0]),
    ("less than a turn", 8, 6.25, [0.0, 1.0, -2.0]),
    ("one", 1, 1.0, [0.0, -1.0, 0.5]),
    ("right", 4, 1.5, [1.0, -1.0, -1.5]),
    ("turn", 9, TAU, [0.0, 1.0, 3.0]),
    ("two", 2, 2.5, [-1.0, 0.0, 3.0]),
];

/// The bearing of ray `k`: over a full turn in equal parts of it from the heading on, otherwise from half the field of
/// view on the right to half of it on the left; a single ray is straight ahead.
fn bearing((_, rays, view, _): MountedFan, k: usize) -> f64 {
    if view == TAU {
        return TAU * k as f64 / f64::from(rays);
    }
    if rays == 1 { 0.0 } else { -0.5 * view + view * k as f64 / f64::from(rays - 1) }
}

/// Where a fan of the car stands in its world, and the way it looks.
fn mounted(q: &[f64], (.., [x, y, theta]): MountedFan) -> ([f64; 2], f64) {
    let (s, c) = (sin(q[2]), cos(q[2]));
    ([q[0] + c * x - s * y, q[1] + s * x + c * y], q[2] + theta)
}

/// The run of a car that turns among walls, with all the fans.
fn driven() -> Log {
    let sensor = |(name, rays, view, [x, y, theta]): &MountedFan| {
        format!(
            "(name: \"{name}\", rays: {rays}, range: 4, field_of_view: {view:?}, \
             mount: (x: {x}, y: {y}, theta: {theta}))"
        )
    };
    let sensors: Vec<String> = FANS.iter().map(sensor).collect();
    let robots = format!(
        "(name: \"rover\", kind: \"rusty\", start: [-3, -3, 1]), \
         (name: \"car\", kind: \"hitch\", start: [-2.5, 0.5, 0.2], sensors: [{}])",
        sensors.join(", ")
    );
    let drive = |tick, robot: &str, v, phi| Event { tick, robot: robot.into(), input: RobotInput::Drive(v, phi) };
    let events = vec![drive(1, "rover", 40, 30), drive(1, "car", 90, 100)];
    Run::record(config(&robots, 12), (Seed(5), Script { events, ..Script::empty() })).unwrap()
}

/// The fields of a message: each one's number, with its bytes or its number of 64 bits.
fn fields(mut bytes: &[u8]) -> Vec<(u64, Vec<u8>)> {
    let varint = |bytes: &mut &[u8]| {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = bytes[0];
            *bytes = &bytes[1..];
            value |= u64::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    };
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let key = varint(&mut bytes);
        let length = match key & 7 {
            0 => {
                all.push((key >> 3, varint(&mut bytes).to_le_bytes().to_vec()));
                continue;
            }
            1 => 8,
            5 => 4,
            _ => varint(&mut bytes) as usize,
        };
        all.push((key >> 3, bytes[..length].to_vec()));
        bytes = &bytes[length..];
    }
    all
}

/// The bytes of a field; none where it is left out, as zeros are.
fn field(message: &[u8], number: u64) -> Vec<u8> {
    fields(message).into_iter().filter(|(n, _)| *n == number).flat_map(|(_, bytes)| bytes).collect()
}

fn doubles(message: &[u8], number: u64) -> Vec<f64> {
    field(message, number).chunks(8).map(|x| f64::from_le_bytes(x.try_into().unwrap())).collect()
}

fn double(message: &[u8], number: u64) -> f64 {
    doubles(message, number).first().copied().unwrap_or(0.0)
}

fn text(message: &[u8], number: u64) -> String {
    String::from_utf8(field(message, number)).unwrap()
}

/// The messages of the car's sensors by their names, in the order of ticks.
fn of_sensors(file: &[u8]) -> BTreeMap<String, Vec<Vec<u8>>> {
    let mut found: BTreeMap<String, Vec<Vec<u8>>> = BTreeMap::new();
    for message in mcap::MessageStream::new(file).unwrap() {
        let message = message.unwrap();
        if let Some(name) = message.channel.topic.strip_prefix("/viewer/scan/car/") {
            let messages = found.entry(name.to_owned()).or_default();
            assert_eq!(message.sequence as usize, messages.len(), "a message a tick");
            messages.push(message.data.to_vec());
        }
    }
    assert_eq!(found.keys().map(String::as_str).collect::<Vec<_>>(), FANS.map(|(name, ..)| name));
    found
}

#[test]
fn every_fan_in_foxglove_s_file_begins_at_its_right_border_and_ends_at_its_left_one() {
    let log = driven();
    let mut file = Vec::new();
    write_foxglove(&log, &mut file, |_| {}).unwrap();
    for (number, (fan, messages)) in FANS.into_iter().zip(of_sensors(&file).into_values()).enumerate() {
        assert_eq!(messages.len(), 13);
        for (message, frame) in messages.iter().zip(std::iter::once(log.initial().unwrap()).chain(log.frames())) {
            let [first, last] = [0, fan.1 as usize - 1].map(|k| bearing(fan, k));
            let found = [double(message, 4), double(message, 5)];
            assert!((found[0] - first).abs() < 1e-12 && (found[1] - last).abs() < 1e-12, "{fan:?}: {found:?}");
            // the angles between the rays follow from their number
            assert_eq!(doubles(message, 6), *frame.scans[number].ranges, "{fan:?}");
            assert_eq!(text(message, 2), "world/room");
            let pose = field(message, 3);
            let (place, turn) = (field(&pose, 1), field(&pose, 2));
            let (from, heading) = mounted(&frame.robots[1].configuration, fan);
            let (s, c) = (sin(0.5 * heading), cos(0.5 * heading));
            let off = [double(&place, 1) - from[0], double(&place, 2) - from[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{fan:?}: {off:?}");
            let (z, w) = (double(&turn, 3), double(&turn, 4));
            assert!(((z * s + w * c).abs() - 1.0).abs() < 1e-12, "{fan:?} is turned by {z} {w}");
        }
    }
}

#[test]
fn every_hit_of_a_fan_in_rerun_s_file_is_where_its_ray_ends() {
    let log = driven();
    let mut file = Vec::new();
    write_rerun(&log, &mut file, |_| {}).unwrap();
    let (mut hits, mut misses) = (0, 0);
    for (number, (fan, messages)) in FANS.into_iter().zip(of_sensors(&file).into_values()).enumerate() {
        assert_eq!(messages.len(), 13);
        for (message, frame) in messages.iter().zip(std::iter::once(log.initial().unwrap()).chain(log.frames())) {
            assert_eq!(text(message, 2), "world/room");
            let points: Vec<[f64; 2]> = field(message, 6)
                .chunks(16)
                .map(|point| [0, 4].map(|i| f64::from(f32::from_le_bytes(point[i..i + 4].try_into().unwrap()))))
                .collect();
            let (from, heading) = mounted(&frame.robots[1].configuration, fan);
            let ends = frame.scans[number].ranges.iter().enumerate().filter(|(_, range)| range.is_finite());
            let expected: Vec<[f64; 2]> = ends
                .map(|(k, range)| {
                    let toward = heading + bearing(fan, k);
                    [from[0] + range * cos(toward), from[1] + range * sin(toward)]
                })
                .collect();
            assert_eq!(points.len(), expected.len(), "{fan:?}");
            for (found, expected) in points.iter().zip(&expected) {
                assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-5), "{fan:?}: {found:?}, not {expected:?}");
            }
            (hits, misses) = (hits + expected.len(), misses + fan.1 as usize - expected.len());
        }
    }
    assert!(hits > 500 && misses > 500, "{hits} hits, {misses} misses");
}
