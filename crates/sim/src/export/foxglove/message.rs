//! The viewers' messages: those parts of assets/schema/foxglove.proto that are written.

use crate::run::TICK_NANOSECONDS;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num;
use prost::Message;

/// The compiled schema, which every export carries.
pub const SCHEMA: &[u8] = include_bytes!("../../../assets/schema/foxglove.binpb");

#[derive(Clone, Copy, PartialEq, Message)]
pub struct Timestamp {
    #[prost(int64, tag = "1")]
    pub seconds: i64,
    #[prost(int32, tag = "2")]
    pub nanos: i32,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct Duration {
    #[prost(int64, tag = "1")]
    pub seconds: i64,
    #[prost(int32, tag = "2")]
    pub nanos: i32,
}

/// A vector or a point: both have these fields.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Vector3 {
    #[prost(double, tag = "1")]
    pub x: f64,
    #[prost(double, tag = "2")]
    pub y: f64,
    #[prost(double, tag = "3")]
    pub z: f64,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct Quaternion {
    #[prost(double, tag = "1")]
    pub x: f64,
    #[prost(double, tag = "2")]
    pub y: f64,
    #[prost(double, tag = "3")]
    pub z: f64,
    #[prost(double, tag = "4")]
    pub w: f64,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct Color {
    #[prost(double, tag = "1")]
    pub r: f64,
    #[prost(double, tag = "2")]
    pub g: f64,
    #[prost(double, tag = "3")]
    pub b: f64,
    #[prost(double, tag = "4")]
    pub a: f64,
}

#[derive(Clone, PartialEq, Message)]
pub struct Pose {
    #[prost(message, optional, tag = "1")]
    pub position: Option<Vector3>,
    #[prost(message, optional, tag = "2")]
    pub orientation: Option<Quaternion>,
}

#[derive(Clone, PartialEq, Message)]
pub struct FrameTransforms {
    #[prost(message, repeated, tag = "1")]
    pub transforms: Vec<FrameTransform>,
}

#[derive(Clone, PartialEq, Message)]
pub struct FrameTransform {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub parent_frame_id: String,
    #[prost(string, tag = "3")]
    pub child_frame_id: String,
    #[prost(message, optional, tag = "4")]
    pub translation: Option<Vector3>,
    #[prost(message, optional, tag = "5")]
    pub rotation: Option<Quaternion>,
}

#[derive(Clone, PartialEq, Message)]
pub struct LaserScan {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub frame_id: String,
    #[prost(message, optional, tag = "3")]
    pub pose: Option<Pose>,
    #[prost(double, tag = "4")]
    pub start_angle: f64,
    #[prost(double, tag = "5")]
    pub end_angle: f64,
    #[prost(double, repeated, tag = "6")]
    pub ranges: Vec<f64>,
}

/// How a number of a [`PackedElementField`] is written.
pub mod numeric {
    pub const UINT8: i32 = 1;
    pub const FLOAT32: i32 = 7;
}

#[derive(Clone, PartialEq, Message)]
pub struct PointCloud {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub frame_id: String,
    #[prost(message, optional, tag = "3")]
    pub pose: Option<Pose>,
    #[prost(fixed32, tag = "4")]
    pub point_stride: u32,
    #[prost(message, repeated, tag = "5")]
    pub fields: Vec<PackedElementField>,
    #[prost(bytes = "vec", tag = "6")]
    pub data: Vec<u8>,
}

#[derive(Clone, PartialEq, Message)]
pub struct PackedElementField {
    #[prost(string, tag = "1")]
    pub name: String,
    #[prost(fixed32, tag = "2")]
    pub offset: u32,
    /// An enumeration in the schema.
    #[prost(int32, tag = "3")]
    pub r#type: i32,
}

/// The levels of a [`LogMessage`].
pub mod level {
    pub const INFO: i32 = 2;
    pub const WARNING: i32 = 3;
}

#[derive(Clone, PartialEq, Message)]
pub struct LogMessage {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    /// An enumeration in the schema.
    #[prost(int32, tag = "2")]
    pub level: i32,
    #[prost(string, tag = "3")]
    pub message: String,
    #[prost(string, tag = "4")]
    pub name: String,
}

#[derive(Clone, PartialEq, Message)]
pub struct SceneUpdate {
    #[prost(message, repeated, tag = "1")]
    pub deletions: Vec<SceneEntityDeletion>,
    #[prost(message, repeated, tag = "2")]
    pub entities: Vec<SceneEntity>,
}

/// Deletes the entity with this id.
#[derive(Clone, PartialEq, Message)]
pub struct SceneEntityDeletion {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "3")]
    pub id: String,
}

#[derive(Clone, PartialEq, Message)]
pub struct SceneEntity {
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub frame_id: String,
    #[prost(string, tag = "3")]
    pub id: String,
    #[prost(message, optional, tag = "4")]
    pub lifetime: Option<Duration>,
    #[prost(bool, tag = "5")]
    pub frame_locked: bool,
    #[prost(message, repeated, tag = "11")]
    pub lines: Vec<LinePrimitive>,
    #[prost(message, repeated, tag = "12")]
    pub triangles: Vec<TriangleListPrimitive>,
}

/// The kinds of a [`LinePrimitive`].
pub mod line {
    pub const STRIP: i32 = 0;
    pub const LOOP: i32 = 1;
    pub const LIST: i32 = 2;
}

#[derive(Clone, PartialEq, Message)]
pub struct LinePrimitive {
    /// An enumeration in the schema.
    #[prost(int32, tag = "1")]
    pub r#type: i32,
    #[prost(message, optional, tag = "2")]
    pub pose: Option<Pose>,
    #[prost(double, tag = "3")]
    pub thickness: f64,
    #[prost(bool, tag = "4")]
    pub scale_invariant: bool,
    #[prost(message, repeated, tag = "5")]
    pub points: Vec<Vector3>,
    #[prost(message, optional, tag = "6")]
    pub color: Option<Color>,
}

#[derive(Clone, PartialEq, Message)]
pub struct TriangleListPrimitive {
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    #[prost(message, repeated, tag = "2")]
    pub points: Vec<Vector3>,
    #[prost(message, optional, tag = "3")]
    pub color: Option<Color>,
    /// Three for each triangle.
    #[prost(fixed32, repeated, tag = "5")]
    pub indices: Vec<u32>,
}

impl Timestamp {
    /// The time of a tick, from zero.
    pub fn of_tick(tick: u64) -> Self {
        const SECOND: u64 = 1_000_000_000;
        let (seconds, nanos) = (tick * TICK_NANOSECONDS / SECOND, tick * TICK_NANOSECONDS % SECOND);
        Timestamp { seconds: seconds as i64, nanos: nanos as i32 }
    }
}

impl Vector3 {
    /// A point of the plane, raised by `z` metres.
    pub fn of(p: Point2, z: f64) -> Self {
        Vector3 { x: p.x, y: p.y, z }
    }
}

impl Quaternion {
    /// The turn about the z axis by `theta` radians.
    pub fn of_turn(theta: f64) -> Self {
        let (s, c) = num::sin_cos(0.5 * theta);
        Quaternion { x: 0.0, y: 0.0, z: s, w: c }
    }
}

impl Pose {
    /// A pose of the plane.
    pub fn of(pose: &Pose2) -> Self {
        let position = Some(Vector3::of(pose.position(), 0.0));
        Pose { position, orientation: Some(Quaternion::of_turn(pose.theta)) }
    }

    /// The frame itself, raised by `z` metres.
    pub fn raised(z: f64) -> Self {
        Pose { position: Some(Vector3 { x: 0.0, y: 0.0, z }), orientation: Some(Quaternion::of_turn(0.0)) }
    }
}

impl FrameTransform {
    /// Where the frame `child` lies in the frame `parent` after a tick.
    pub fn of(tick: u64, parent: String, child: String, pose: &Pose2) -> Self {
        FrameTransform {
            timestamp: Some(Timestamp::of_tick(tick)),
            parent_frame_id: parent,
            child_frame_id: child,
            translation: Some(Vector3::of(pose.position(), 0.0)),
            rotation: Some(Quaternion::of_turn(pose.theta)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use prost_types::field_descriptor_proto::{Label, Type};
    use prost_types::{FieldDescriptorProto, FileDescriptorSet};

    use super::*;

    const PROTO: &str = include_str!("../../../assets/schema/foxglove.proto");

    /// A field as the text has it.
    fn words(field: &FieldDescriptorProto) -> String {
        let kind = match field.r#type() {
            Type::Double => "double",
            Type::Bool => "bool",
            Type::String => "string",
            Type::Bytes => "bytes",
            Type::Fixed32 => "fixed32",
            Type::Message | Type::Enum => match field.type_name().strip_prefix(".google.") {
                Some(_) => field.type_name().trim_start_matches('.'),
                None => field.type_name().rsplit('.').next().unwrap(),
            },
            other => panic!("a type the schema should not need: {other:?}"),
        };
        let label = if field.label() == Label::Repeated { "repeated " } else { "" };
        format!("{label}{kind} {} = {};", field.name(), field.number())
    }

    #[test]
    fn the_text_and_the_compiled_schema_are_one() {
        let mut text: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        let mut current = "";
        for line in PROTO.lines().map(str::trim) {
            if let Some(name) = line.strip_prefix("message ") {
                current = name.trim_end_matches(" {");
                text.insert(current, Vec::new());
            } else if line.contains(" = ") && line.split(' ').count() > 3 {
                text.get_mut(current).unwrap().push(line);
            }
        }
        let set = FileDescriptorSet::decode(SCHEMA).unwrap();
        let file = set.file.iter().find(|f| f.name() == "foxglove.proto").unwrap();
        assert_eq!(set.file.len(), 3, "with the two files it imports");
        assert_eq!(file.message_type.len(), text.len());
        for message in &file.message_type {
            let compiled: Vec<String> = message.field.iter().map(words).collect();
            assert_eq!(compiled, text[message.name()], "{}: compile the text again", message.name());
        }
    }

    #[test]
    fn a_tick_is_a_twentieth_of_a_second_and_a_turn_is_half_an_angle() {
        assert_eq!(Timestamp::of_tick(0), Timestamp { seconds: 0, nanos: 0 });
        assert_eq!(Timestamp::of_tick(59), Timestamp { seconds: 2, nanos: 950_000_000 });
        let half = Quaternion::of_turn(std::f64::consts::PI);
        assert!((half.z - 1.0).abs() < 1e-15 && half.w.abs() < 1e-15, "half a turn is all z");
    }
}
