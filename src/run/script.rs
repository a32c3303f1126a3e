//! `Script`, the input of a run: what people and programs did, recorded only when it changes.

use serde::{Deserialize, Serialize};

use crate::configuration::Configuration;

/// The version of the script format that this program writes and reads.
pub const SCRIPT_VERSION: u32 = 1;

/// The input script of a run, as RON. Unknown fields and other versions are refused.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// The format's version, [`SCRIPT_VERSION`].
    pub version: u32,
    /// The events in order of their ticks. Events of one tick keep the order of the list.
    pub events: Vec<Event>,
}

/// One input to one robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// The tick before whose step the input applies, from 1.
    pub tick: u64,
    /// The name of the robot.
    pub robot: String,
    /// The input.
    pub input: RobotInput,
}

/// A captured coordinate, metres or radians in units of 2^-20: `Quantized(1 << 20)` is 1. The rounding keeps pixels out
/// of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Quantized(pub i64);

impl Quantized {
    /// Units per metre or radian.
    pub const UNITS: f64 = 1_048_576.0;

    /// The nearest quantized value (ties to even); `None` unless finite and below 9.1e15 units in size, a little above
    /// 2^33.
    pub fn try_new(value: f64) -> Option<Self> {
        let scaled = (value * Self::UNITS).round_ties_even();
        (scaled.abs() < 9.1e15).then_some(Quantized(scaled as i64))
    }

    /// The value in metres or radians; exact up to 2^53 units.
    pub fn value(self) -> f64 {
        self.0 as f64 / Self::UNITS
    }
}

/// An input to a robot. The first one takes the robot over from its tour; `Release` returns it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum RobotInput {
    /// Hold these control channels, from -128 to 128, the maximum. Rusty: speed, turn rate. Hitch: speed,
    /// steering angle. Reach has no drive channels and refuses it.
    Drive(i16, i16),
    /// Go to these chart coordinates by the end of the tick. Reach: its joint angles.
    MoveTo(Vec<Quantized>),
    /// Be put at these chart coordinates, unless the footprint there would overlap or touch anything.
    Teleport(Vec<Quantized>),
    /// Attach the trailer straight behind the car (psi = theta), unless it would overlap or touch anything, or detach
    /// it.
    SetTrailer(bool),
    /// Back to the tour.
    Release,
}

impl Script {
    /// A script without events.
    pub const fn empty() -> Self {
        Script { version: SCRIPT_VERSION, events: Vec::new() }
    }

    /// Creates a script that moves the robot named `robot` through a list of configurations, one a tick from tick 1 on.
    /// It suits robots that take `MoveTo`, such as Reach. Coordinates are rounded to units of 2^-20. `None` if one is
    /// not finite or out of range.
    ///
    /// ```
    /// use motion_lab::prelude::*;
    /// use motion_lab::run::Script;
    /// let script = Script::of_moves("Reach", [T2::new(0.5, 0.0), T2::new(0.5, 0.25)]).unwrap();
    /// assert_eq!((script.events.len(), script.events[1].tick), (2, 2));
    /// assert!(Script::of_moves("Reach", [Tn([f64::NAN, 0.0])]).is_none());
    /// ```
    pub fn of_moves<C: Configuration>(robot: &str, way: impl IntoIterator<Item = C>) -> Option<Self> {
        let event = |(tick, q): (u64, C)| {
            let target = q.coordinates().iter().map(|x| Quantized::try_new(*x)).collect::<Option<_>>()?;
            Some(Event { tick, robot: robot.to_owned(), input: RobotInput::MoveTo(target) })
        };
        let events = (1_u64..).zip(way).map(event).collect::<Option<_>>()?;
        Some(Script { version: SCRIPT_VERSION, events })
    }
}
