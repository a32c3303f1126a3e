//! `Script`, the input of a run: what people and programs did, recorded only when it changes.

use serde::{Deserialize, Serialize};

use super::{Quantized, WorldEvent};
use motion_lab_core::configuration::{Configuration, InputKind};

/// The version of the script format for a script of events alone.
pub const SCRIPT_VERSION: u32 = 1;
/// The version of the script format for a script that changes worlds too.
pub const SCRIPT_VERSION_WITH_CHANGES: u32 = 2;

/// The input script of a run, as RON. Unknown fields and other versions are refused.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// The format's version, [`version_of`](Self::version_of) the changes.
    pub version: u32,
    /// The events in order of their ticks. Events of one tick keep the order of the list.
    pub events: Vec<Event>,
    /// The changes of worlds in order of their ticks. Those of one tick keep the order of the list, and come before the
    /// tick's events.
    #[serde(default)]
    pub changes: Vec<WorldEvent>,
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

/// An input to a robot. The first one takes the robot over from its tour; `Release` returns it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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

impl RobotInput {
    /// Its kind.
    pub const fn kind(&self) -> InputKind {
        match self {
            RobotInput::Drive(..) => InputKind::Drive,
            RobotInput::MoveTo(_) => InputKind::MoveTo,
            RobotInput::Teleport(_) => InputKind::Teleport,
            RobotInput::SetTrailer(_) => InputKind::SetTrailer,
            RobotInput::Release => InputKind::Release,
        }
    }
}

impl Script {
    /// A script without events.
    pub const fn empty() -> Self {
        Script { version: SCRIPT_VERSION, events: Vec::new(), changes: Vec::new() }
    }

    /// A script of these events and changes, in the version that they need. It is not checked: [`check`](Self::check)
    /// does that.
    pub fn new(events: Vec<Event>, changes: Vec<WorldEvent>) -> Self {
        Script { version: Script::version_of(&changes), events, changes }
    }

    /// Whether the script has neither events nor changes.
    pub fn is_empty(&self) -> bool {
        self.events.is_empty() && self.changes.is_empty()
    }

    /// Forgets the events and the changes after `tick`.
    pub fn truncate_after(&mut self, tick: u64) {
        self.events.retain(|e| e.tick <= tick);
        self.changes.retain(|c| c.tick <= tick);
        self.version = Script::version_of(&self.changes);
    }

    /// The version that a script with these changes has: [`SCRIPT_VERSION`] without any.
    pub const fn version_of(changes: &[WorldEvent]) -> u32 {
        if changes.is_empty() { SCRIPT_VERSION } else { SCRIPT_VERSION_WITH_CHANGES }
    }

    /// Creates a script that moves the robot named `robot` through a list of configurations, one a tick from tick 1 on.
    /// It suits robots that take `MoveTo`, such as Reach. Coordinates are rounded to units of 2^-20. `None` if one is
    /// not finite or out of range.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// use motion_lab_sim::run::Script;
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
        Some(Script::new(events, Vec::new()))
    }
}
