//! `Frame`, the state of the whole simulation after a tick, in its one canonical form.

use std::sync::Arc;

use super::field::{FrameField, Value};
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::short_list::ShortList;

mod obstacle_states;

pub(crate) use obstacle_states::ObstacleDifference;
pub use obstacle_states::{ObstacleState, ObstacleStates};

/// The length of a tick in seconds: the simulation runs at 20 Hz. Time is tick * DT, never a sum.
pub const DT: f64 = motion_lab_core::robots::TICK;

/// A time in seconds, the nearest number to it: 48 ticks are 2.4 s. The product of [`DT`] and a number of ticks, which
/// frames and logs hold, may be an ulp off.
pub fn seconds(ticks: u64) -> f64 {
    ticks as f64 / (1.0 / DT)
}

/// The state of one robot after a tick: all that is needed to continue from it.
///
/// No NaN enters it, and -0.0 is stored as +0.0.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotState {
    /// The robot's id: its index in the run's list of robots.
    pub id: u32,
    /// The chart coordinates of the configuration. Their number determines the space.
    pub configuration: Coordinates,
    /// The robot's own state beside its configuration, in the order its kind documents: Rusty's accumulated left and
    /// right wheel turns (radians), its tour's next waypoint.
    pub extra: ShortList<f64, 4>,
    /// The control channels held by manual driving, -128 to 128 of the maximum.
    pub channels: [i16; 2],
    /// The target coordinates of a manual move; empty if there is none.
    pub target: Coordinates,
    /// Whether a person drives, not the tour.
    pub manual: bool,
    /// Whether the last tick's motion met an obstacle, another robot or its own limit. A robot that is held before what
    /// it meets does not touch it.
    pub in_contact: bool,
    /// Contact episodes since tick 0.
    pub contacts: u32,
    /// Number of ticks that the contact flash still lasts.
    pub flash: u32,
    /// Script inputs refused since tick 0 (a teleport onto an obstacle, a trailer where there is no room).
    pub refusals: u32,
}

/// The state of the whole simulation after tick `tick`; frame 0 is the initial state.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The tick.
    pub tick: u64,
    /// The robots' states by ascending id.
    pub robots: Vec<RobotState>,
    /// The scans of the robots' range sensors, by ascending robot id, those of one robot by the bytes of the sensors'
    /// names. A robot without a sensor has none.
    pub scans: Vec<RobotScan>,
    /// The obstacles and doors that are not as they were at the start, by ascending world, then number.
    pub obstacles: ObstacleStates,
}

/// The scan of one range sensor of a robot at the end of a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotScan {
    /// The robot's id.
    pub robot: u32,
    /// The range of each ray, metres; infinity where nothing is in range. Copies of a frame share them.
    pub ranges: Arc<[f64]>,
}

impl RobotScan {
    /// The ranges, to be changed. Copies of the frame keep what they have.
    pub fn ranges_mut(&mut self) -> &mut [f64] {
        Arc::make_mut(&mut self.ranges)
    }
}

impl Frame {
    /// Calls `visit` for every value of the frame in canonical order: the robot it belongs to, its name, the value.
    ///
    /// This one order serves the canonical encoding, the digest and the search for a divergence. A list's length comes
    /// before its items, so the values of two frames correspond up to their first difference.
    pub(super) fn visit(&self, visit: &mut impl FrameVisitor) {
        // destructured by name, so that a field added later cannot be forgotten here
        let Frame { tick, robots, scans, obstacles } = self;
        visit.value(None, FrameField::one("tick"), Value::Count(*tick));
        visit.value(None, FrameField::one("robots.len"), Value::of_len(robots.len()));
        for robot in robots {
            robot.visit(visit);
        }
        visit.value(None, FrameField::one("scans.len"), Value::of_len(scans.len()));
        for RobotScan { robot, ranges } in scans {
            visit.value(Some(*robot), FrameField::one("scan.robot"), Value::Count(u64::from(*robot)));
            visit_list(Some(*robot), "ranges.len", "ranges", ranges, visit);
        }
        visit.count_of_obstacles(obstacles.len());
        for ObstacleState { world, obstacle, present, pose } in obstacles.iter() {
            visit.value(None, FrameField::one("obstacle.world"), Value::Count(u64::from(*world)));
            visit.value(None, FrameField::one("obstacle.number"), Value::Count(u64::from(*obstacle)));
            visit.value(None, FrameField::one("obstacle.present"), Value::Flag(*present));
            let Pose2 { x, y, theta } = *pose;
            visit.floats(None, "obstacle.pose", &[x, y, theta]);
        }
    }

    /// Appends the canonical encoding to `out`: a sequence of 64-bit words, each little-endian.
    ///
    /// | words | what |
    /// |---|---|
    /// | 1 | the tick |
    /// | 1 | the number of robots, then for each: |
    /// | 1 | its id |
    /// | 1 + n | the number of its configuration's coordinates, and these |
    /// | 1 + n | the number of its extra values, and these |
    /// | 2 | its two control channels, two's complement |
    /// | 1 + n | the number of its target's coordinates, and these |
    /// | 2 | manual, in contact: 0 or 1 |
    /// | 3 | contact episodes, ticks of flash, refusals |
    /// | 1 | the number of scans, then for each: |
    /// | 1 | its robot's id |
    /// | 1 + n | the number of its ranges, and these |
    /// | 0 or 1 | nothing where all obstacles are as at the start; else 2^63 plus how many are not, then for each: |
    /// | 2 | its world and its number |
    /// | 1 | present: 0 or 1 |
    /// | 3 | its motion: x, y, theta |
    ///
    /// An `f64` is encoded as its bits. Frames that differ in a bit have different encodings. A sequence of encodings
    /// can be read in one way only: a tick is below 2^63, so the word after the scans says which of the two it is.
    pub fn encode(&self, out: &mut Vec<u8>) {
        self.visit(&mut FrameWords(out));
    }

    /// Calls `take` with the canonical encoding, piece by piece, so that a large frame's is never in memory as a whole.
    pub(super) fn encode_in_pieces(&self, room: &mut Vec<u8>, take: impl FnMut(&[u8])) {
        room.resize(PIECE, 0);
        let mut pieces = WordBatches { room: room.as_chunks_mut().0, count: 0, take };
        self.visit(&mut pieces);
        pieces.pass_on();
    }

    /// The number of bytes that the canonical encoding takes.
    pub(super) fn encoded_length(&self) -> usize {
        let Frame { robots, scans, obstacles, .. } = self;
        let changed = if obstacles.is_empty() { 0 } else { 1 + 6 * obstacles.len() };
        let lists = |r: &RobotState| r.configuration.len() + r.extra.len() + r.target.len();
        let words = robots.iter().map(|r| 11 + lists(r)).sum::<usize>();
        8 * (3 + changed + words + scans.iter().map(|s| 2 + s.ranges.len()).sum::<usize>())
    }

    /// The first NaN in canonical order: its robot and the field's name.
    pub fn first_nan(&self) -> Option<(u32, String)> {
        let mut first = FirstNan(None);
        self.visit(&mut first);
        first.0
    }
}

impl RobotState {
    fn visit(&self, visit: &mut impl FrameVisitor) {
        let RobotState { id, configuration, extra, channels, target, manual, in_contact, contacts, flash, refusals } =
            self;
        let robot = Some(*id);
        visit.value(robot, FrameField::one("id"), Value::Count(u64::from(*id)));
        visit_list(robot, "configuration.len", "configuration", configuration, visit);
        visit_list(robot, "extra.len", "extra", extra, visit);
        for (i, channel) in channels.iter().enumerate() {
            visit.value(robot, FrameField::item("channels", i), Value::Integer(i64::from(*channel)));
        }
        visit_list(robot, "target.len", "target", target, visit);
        visit.value(robot, FrameField::one("manual"), Value::Flag(*manual));
        visit.value(robot, FrameField::one("in_contact"), Value::Flag(*in_contact));
        visit.value(robot, FrameField::one("contacts"), Value::Count(u64::from(*contacts)));
        visit.value(robot, FrameField::one("flash"), Value::Count(u64::from(*flash)));
        visit.value(robot, FrameField::one("refusals"), Value::Count(u64::from(*refusals)));
    }
}

fn visit_list(
    robot: Option<u32>,
    len_name: &'static str,
    name: &'static str,
    list: &[f64],
    visit: &mut impl FrameVisitor,
) {
    visit.value(robot, FrameField::one(len_name), Value::of_len(list.len()));
    visit.floats(robot, name, list);
}

/// A visitor of the values of a frame.
pub(super) trait FrameVisitor {
    fn value(&mut self, robot: Option<u32>, field: FrameField, value: Value);

    /// The number of obstacles that are not as at the start.
    fn count_of_obstacles(&mut self, count: usize) {
        self.value(None, FrameField::one("obstacles.len"), Value::of_len(count));
    }

    /// The items of a list.
    fn floats(&mut self, robot: Option<u32>, name: &'static str, list: &[f64]) {
        for (i, x) in list.iter().enumerate() {
            self.value(robot, FrameField::item(name, i), Value::Float(*x));
        }
    }
}

impl<F: FnMut(Option<u32>, FrameField, Value)> FrameVisitor for F {
    fn value(&mut self, robot: Option<u32>, field: FrameField, value: Value) {
        self(robot, field, value);
    }
}

/// What the number of obstacles that are not as at the start is marked with.
const CHANGED: u64 = 1 << 63;

/// The first NaN of a robot.
struct FirstNan(Option<(u32, String)>);

impl FrameVisitor for FirstNan {
    fn value(&mut self, robot: Option<u32>, field: FrameField, value: Value) {
        if let (None, Some(robot), Value::Float(x)) = (&self.0, robot, value)
            && x.is_nan()
        {
            self.0 = Some((robot, field.to_string()));
        }
    }

    fn floats(&mut self, robot: Option<u32>, name: &'static str, list: &[f64]) {
        // the whole list at once, because nearly none holds a NaN
        if list.iter().fold(false, |any, x| any | x.is_nan()) {
            (0..).zip(list).for_each(|(i, x)| self.value(robot, FrameField::item(name, i), Value::Float(*x)));
        }
    }
}

/// Appends the values as words. Lists are appended in one go, because scans are most of a frame.
struct FrameWords<'a>(&'a mut Vec<u8>);

impl FrameVisitor for FrameWords<'_> {
    fn value(&mut self, _robot: Option<u32>, _field: FrameField, value: Value) {
        self.0.extend_from_slice(&value.bits().to_le_bytes());
    }

    fn count_of_obstacles(&mut self, count: usize) {
        if count > 0 {
            self.0.extend_from_slice(&(CHANGED | count as u64).to_le_bytes());
        }
    }

    fn floats(&mut self, _robot: Option<u32>, _name: &'static str, list: &[f64]) {
        let before = self.0.len();
        self.0.resize(before + 8 * list.len(), 0);
        for (word, x) in self.0[before..].as_chunks_mut().0.iter_mut().zip(list) {
            *word = x.to_bits().to_le_bytes();
        }
    }
}

/// The bytes of a piece, whole words.
const PIECE: usize = 8192;

/// Collects the values as words, and passes them on when the room is full.
struct WordBatches<'a, F> {
    room: &'a mut [[u8; 8]],
    /// The number of words in `room`.
    count: usize,
    take: F,
}

impl<F: FnMut(&[u8])> WordBatches<'_, F> {
    fn pass_on(&mut self) {
        (self.take)(self.room[..self.count].as_flattened());
        self.count = 0;
    }

    fn word(&mut self, word: u64) {
        if self.count == self.room.len() {
            self.pass_on();
        }
        self.room[self.count] = word.to_le_bytes();
        self.count += 1;
    }
}

impl<F: FnMut(&[u8])> FrameVisitor for WordBatches<'_, F> {
    fn value(&mut self, _robot: Option<u32>, _field: FrameField, value: Value) {
        self.word(value.bits());
    }

    fn count_of_obstacles(&mut self, count: usize) {
        if count > 0 {
            self.word(CHANGED | count as u64);
        }
    }

    fn floats(&mut self, _robot: Option<u32>, _name: &'static str, mut list: &[f64]) {
        while !list.is_empty() {
            if self.count == self.room.len() {
                self.pass_on();
            }
            let free = &mut self.room[self.count..];
            let (now, rest) = list.split_at(list.len().min(free.len()));
            for (word, x) in free.iter_mut().zip(now) {
                *word = x.to_bits().to_le_bytes();
            }
            self.count += now.len();
            list = rest;
        }
    }
}

#[cfg(test)]
mod tests;
