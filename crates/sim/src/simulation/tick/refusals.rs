//! `Refusals`, the inputs of its script that a run refused: how many, and the first one with its reason.

use bevy::prelude::Resource;

use crate::run::ScriptError;
use crate::simulation::{ChangeRefused, InputRefusal};
use motion_lab_core::configuration::InputKind;

/// An input that a robot refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("tick {tick}: robot {robot:?} refused {input}: {reason}")]
#[non_exhaustive]
pub struct RefusedInput {
    /// The tick of the input.
    pub tick: u64,
    /// The robot.
    pub robot: String,
    /// The kind of input.
    pub input: InputKind,
    /// The reason.
    pub reason: InputRefusal,
}

/// An input that was refused, to a robot or to a world.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RefusedEvent {
    /// An input to a robot.
    #[error(transparent)]
    Input(RefusedInput),
    /// A change of a world.
    #[error(transparent)]
    Change(ChangeRefused),
    /// An input that no script could hold: to an unknown robot, or with a channel out of range. It is none of the
    /// script's.
    #[error("{}", .0.problem)]
    Command(Box<ScriptError>),
}

/// The inputs that a run refused, to robots and to worlds: those of its script, each tick counted once however often
/// the run goes back to it, and commands that never came into the script. It is no part of the run.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Refusals {
    count: u64,
    first: Option<RefusedEvent>,
    /// The last tick with inputs that is counted.
    until: u64,
}

impl Refusals {
    /// The number of inputs refused so far.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The first one, with its reason.
    pub fn first(&self) -> Option<&RefusedEvent> {
        self.first.as_ref()
    }

    /// Begins the inputs of a tick. Returns whether they are to be counted.
    pub(crate) fn begin(&mut self, tick: u64) -> bool {
        let is_new = tick > self.until;
        self.until = std::cmp::max(self.until, tick);
        is_new
    }

    pub(crate) fn note(&mut self, event: impl FnOnce() -> RefusedEvent) {
        self.count += 1;
        self.first.get_or_insert_with(event);
    }
}
