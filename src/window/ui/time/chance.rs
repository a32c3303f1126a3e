//! `ShownChance`, the last chance to avoid a contact of the run on the screen.

use std::sync::Arc;

use motion_lab_sim::avoid::Evasion;
use motion_lab_sim::run::{Event, Script, WorldEvent};
use motion_lab_sim::tour::TourConfig;

/// The last chance to avoid a contact of the run on the screen.
#[derive(Clone, Debug)]
pub struct ShownChance {
    /// The robot's id.
    pub robot: u32,
    /// The first tick in contact.
    pub contact: u64,
    /// The way out: by going on where there is one, else by stopping.
    pub way_out: Option<Evasion>,
    /// What is known of it, in words.
    pub text: String,
    /// The settings of the run.
    pub config: Arc<TourConfig>,
    /// The inputs that the run had.
    pub script: ScriptMark,
    /// Whether its way out is asked for.
    pub is_asked: bool,
}

/// What tells a script from a later one of the same run: how much it holds, and what came last.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptMark {
    counts: [usize; 2],
    last: (Option<Event>, Option<WorldEvent>),
}

impl ScriptMark {
    /// The mark of a script.
    pub fn of(script: &Script) -> Self {
        let Script { events, changes, .. } = script;
        ScriptMark { counts: [events.len(), changes.len()], last: (events.last().cloned(), changes.last().cloned()) }
    }
}
