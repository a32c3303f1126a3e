//! The log's messages: protobuf, as `assets/schema/motion_lab.proto` and, for formats 2 and 3, `motion_lab_2.proto` and
//! `motion_lab_3.proto` describe them.
//!
//! A single float is `optional` and several are `repeated`: plain proto3 floats lose the sign of -0.0.

use std::fmt::Write;

use prost::{Message, Oneof};

use crate::run::{
    DT, Digest, Event, Frame, ObstacleDifference, ObstacleState, ObstacleStates, Quantized, RobotInput, RobotScan,
    RobotState, WorldChange, WorldEvent,
};
use motion_lab_core::geometry::Pose2;

/// The compiled schema of format 1, a serialized `FileDescriptorSet`. It tells other programs how to read the messages.
pub const SCHEMA: &[u8] = include_bytes!("../../../assets/schema/motion_lab.binpb");

/// The compiled schema of format 2.
pub const SCHEMA_2: &[u8] = include_bytes!("../../../assets/schema/motion_lab_2.binpb");

/// The compiled schema of format 3.
pub const SCHEMA_3: &[u8] = include_bytes!("../../../assets/schema/motion_lab_3.binpb");

#[derive(Clone, PartialEq, Message)]
pub struct FrameMessage {
    #[prost(uint64, tag = "1")]
    pub tick: u64,
    #[prost(double, optional, tag = "2")]
    pub time: Option<f64>,
    #[prost(message, repeated, tag = "3")]
    pub robots: Vec<RobotStateMessage>,
    /// Format 2.
    #[prost(message, repeated, tag = "4")]
    pub obstacles: Vec<ObstacleStateMessage>,
}

/// Format 2.
#[derive(Clone, PartialEq, Message)]
pub struct ObstacleStateMessage {
    #[prost(uint32, tag = "1")]
    pub world: u32,
    #[prost(uint32, tag = "2")]
    pub obstacle: u32,
    #[prost(bool, tag = "3")]
    pub present: bool,
    #[prost(double, repeated, tag = "4")]
    pub pose: Vec<f64>,
    /// Format 3.
    #[prost(bool, tag = "5")]
    pub at_start: bool,
}

#[derive(Clone, PartialEq, Message)]
pub struct RobotStateMessage {
    #[prost(uint32, tag = "1")]
    pub id: u32,
    #[prost(double, repeated, tag = "2")]
    pub configuration: Vec<f64>,
    #[prost(double, repeated, tag = "3")]
    pub extra: Vec<f64>,
    #[prost(sint32, repeated, tag = "4")]
    pub channels: Vec<i32>,
    #[prost(double, repeated, tag = "5")]
    pub target: Vec<f64>,
    #[prost(bool, tag = "6")]
    pub manual: bool,
    #[prost(bool, tag = "7")]
    pub in_contact: bool,
    #[prost(uint32, tag = "8")]
    pub contacts: u32,
    #[prost(uint32, tag = "9")]
    pub flash: u32,
    #[prost(uint32, tag = "10")]
    pub refusals: u32,
}

#[derive(Clone, PartialEq, Message)]
pub struct ScanMessage {
    #[prost(uint64, tag = "1")]
    pub tick: u64,
    #[prost(uint32, tag = "2")]
    pub robot: u32,
    #[prost(double, optional, tag = "3")]
    pub max_range: Option<f64>,
    #[prost(double, repeated, tag = "4")]
    pub ranges: Vec<f64>,
}

#[derive(Clone, PartialEq, Message)]
pub struct InputMessage {
    #[prost(uint64, tag = "1")]
    pub tick: u64,
    #[prost(string, tag = "2")]
    pub robot: String,
    #[prost(oneof = "InputKindMessage", tags = "3, 4, 5, 6, 7, 9, 10, 11, 12, 13")]
    pub input: Option<InputKindMessage>,
    /// Format 2: the world that is changed; then there is no robot.
    #[prost(string, tag = "8")]
    pub world: String,
}

#[derive(Clone, PartialEq, Oneof)]
pub enum InputKindMessage {
    #[prost(message, tag = "3")]
    Drive(DriveMessage),
    #[prost(message, tag = "4")]
    MoveTo(CoordinatesMessage),
    #[prost(message, tag = "5")]
    Teleport(CoordinatesMessage),
    #[prost(bool, tag = "6")]
    SetTrailer(bool),
    #[prost(message, tag = "7")]
    Release(ReleaseMessage),
    /// Format 2, as the others below.
    #[prost(string, tag = "9")]
    Close(String),
    #[prost(string, tag = "10")]
    Open(String),
    #[prost(string, tag = "11")]
    Remove(String),
    #[prost(message, tag = "12")]
    Move(MoveMessage),
    #[prost(message, tag = "13")]
    Add(AddMessage),
}

#[derive(Clone, PartialEq, Message)]
pub struct MoveMessage {
    #[prost(string, tag = "1")]
    pub name: String,
    #[prost(double, repeated, tag = "2")]
    pub to: Vec<f64>,
}

#[derive(Clone, PartialEq, Message)]
pub struct AddMessage {
    #[prost(string, tag = "1")]
    pub name: String,
    #[prost(double, repeated, tag = "2")]
    pub points: Vec<f64>,
    #[prost(double, optional, tag = "3")]
    pub radius: Option<f64>,
}

#[derive(Clone, PartialEq, Message)]
pub struct DriveMessage {
    #[prost(sint32, tag = "1")]
    pub first: i32,
    #[prost(sint32, tag = "2")]
    pub second: i32,
}

#[derive(Clone, PartialEq, Message)]
pub struct CoordinatesMessage {
    #[prost(double, repeated, tag = "1")]
    pub values: Vec<f64>,
}

#[derive(Clone, PartialEq, Message)]
pub struct ReleaseMessage {}

#[derive(Clone, PartialEq, Message)]
pub struct DigestMessage {
    #[prost(uint64, tag = "1")]
    pub tick: u64,
    #[prost(string, tag = "2")]
    pub xxh3_128: String,
}

impl FrameMessage {
    /// Overwrites this message with that of a frame, reusing its buffers: with all of its obstacles, or with those that
    /// are not as in the frame before, whose obstacles are `before`.
    pub fn take(&mut self, frame: &Frame, before: Option<&ObstacleStates>) {
        self.tick = frame.tick;
        // ticks stay below 2^53, so the product is rounded once
        self.time = Some(frame.tick as f64 * DT);
        self.robots.resize_with(frame.robots.len(), RobotStateMessage::default);
        for (message, robot) in self.robots.iter_mut().zip(&frame.robots) {
            message.take(robot);
        }
        self.obstacles.clear();
        match before {
            Some(before) => {
                self.obstacles.extend(frame.obstacles.since(before).iter().map(ObstacleStateMessage::since))
            }
            None => self.obstacles.extend(frame.obstacles.iter().map(ObstacleStateMessage::of)),
        }
    }

    /// The frame, without its scans; `None` unless there are two control channels that fit 16 bits and each obstacle's
    /// pose has three numbers. `before` is what [`take`](Self::take) had; what is the same in `shared`, the obstacles
    /// of the frame before, is shared.
    pub fn into_frame(self, before: Option<&ObstacleStates>, shared: &ObstacleStates) -> Option<Frame> {
        let robot = |r: RobotStateMessage| {
            let [first, second] = r.channels[..] else { return None };
            Some(RobotState {
                id: r.id,
                configuration: r.configuration.into(),
                extra: r.extra.into(),
                channels: [i16::try_from(first).ok()?, i16::try_from(second).ok()?],
                target: r.target.into(),
                manual: r.manual,
                in_contact: r.in_contact,
                contacts: r.contacts,
                flash: r.flash,
                refusals: r.refusals,
            })
        };
        let robots = self.robots.into_iter().map(robot).collect::<Option<Vec<_>>>()?;
        let obstacles = match before {
            Some(before) => {
                let mut now = before.clone();
                for obstacle in &self.obstacles {
                    now.change(obstacle.difference()?);
                }
                now
            }
            None => {
                let listed = self.obstacles.iter().map(ObstacleStateMessage::state);
                listed.collect::<Option<ObstacleStates>>()?.sharing(shared)
            }
        };
        Some(Frame { tick: self.tick, robots, scans: Vec::new(), obstacles })
    }
}

impl ObstacleStateMessage {
    fn of(o: &ObstacleState) -> Self {
        let pose = vec![o.pose.x, o.pose.y, o.pose.theta];
        ObstacleStateMessage { world: o.world, obstacle: o.obstacle, present: o.present, pose, at_start: false }
    }

    fn since(difference: &ObstacleDifference) -> Self {
        let (world, obstacle) = difference.key;
        let at_start = || ObstacleStateMessage { world, obstacle, at_start: true, ..ObstacleStateMessage::default() };
        difference.after.as_ref().map_or_else(at_start, ObstacleStateMessage::of)
    }

    fn state(&self) -> Option<ObstacleState> {
        let [x, y, theta] = self.pose[..] else { return None };
        let pose = Pose2 { x, y, theta };
        Some(ObstacleState { world: self.world, obstacle: self.obstacle, present: self.present, pose })
    }

    fn difference(&self) -> Option<ObstacleDifference> {
        let after = if self.at_start { None } else { Some(self.state()?) };
        Some(ObstacleDifference { key: (self.world, self.obstacle), after })
    }
}

impl RobotStateMessage {
    fn take(&mut self, r: &RobotState) {
        let RobotState { id, configuration, extra, channels, target, manual, in_contact, contacts, flash, refusals } =
            r;
        (self.id, self.manual, self.in_contact) = (*id, *manual, *in_contact);
        (self.contacts, self.flash, self.refusals) = (*contacts, *flash, *refusals);
        let lists =
            [(&mut self.configuration, &configuration[..]), (&mut self.extra, extra), (&mut self.target, target)];
        for (list, values) in lists {
            list.clear();
            list.extend_from_slice(values);
        }
        self.channels.clear();
        self.channels.extend(channels.map(i32::from));
    }
}

impl ScanMessage {
    /// Overwrites this message with that of a scan, reusing its buffers.
    pub fn take(&mut self, tick: u64, max_range: Option<f64>, scan: &RobotScan) {
        (self.tick, self.robot, self.max_range) = (tick, scan.robot, max_range);
        self.ranges.clear();
        self.ranges.extend_from_slice(&scan.ranges);
    }

    pub fn into_scan(self) -> RobotScan {
        RobotScan { robot: self.robot, ranges: self.ranges.into() }
    }
}

impl InputMessage {
    pub fn of(event: &Event) -> Self {
        let coordinates = |q: &[Quantized]| CoordinatesMessage { values: q.iter().map(|c| c.value()).collect() };
        let input = match &event.input {
            RobotInput::Drive(first, second) => {
                InputKindMessage::Drive(DriveMessage { first: i32::from(*first), second: i32::from(*second) })
            }
            RobotInput::MoveTo(q) => InputKindMessage::MoveTo(coordinates(q)),
            RobotInput::Teleport(q) => InputKindMessage::Teleport(coordinates(q)),
            RobotInput::SetTrailer(on) => InputKindMessage::SetTrailer(*on),
            RobotInput::Release => InputKindMessage::Release(ReleaseMessage {}),
        };
        InputMessage { tick: event.tick, robot: event.robot.clone(), world: String::new(), input: Some(input) }
    }

    pub fn of_change(event: &WorldEvent) -> Self {
        let WorldEvent { tick, world, change } = event;
        let input = match change.clone() {
            WorldChange::Close(name) => InputKindMessage::Close(name),
            WorldChange::Open(name) => InputKindMessage::Open(name),
            WorldChange::Remove(name) => InputKindMessage::Remove(name),
            WorldChange::Move { name, to: (x, y, theta) } => {
                InputKindMessage::Move(MoveMessage { name, to: vec![x.value(), y.value(), theta.value()] })
            }
            WorldChange::Add { name, points, radius } => {
                let points = points.iter().flat_map(|(x, y)| [x.value(), y.value()]).collect();
                InputKindMessage::Add(AddMessage { name, points, radius: Some(radius.value()) })
            }
        };
        InputMessage { tick: *tick, robot: String::new(), world: world.clone(), input: Some(input) }
    }
}

impl DigestMessage {
    /// Overwrites this message with that of a digest, reusing its buffers.
    pub fn take(&mut self, tick: u64, digest: Digest) {
        self.tick = tick;
        self.xxh3_128.clear();
        // writing to a String never fails
        let _ = write!(self.xxh3_128, "{digest}");
    }
}
