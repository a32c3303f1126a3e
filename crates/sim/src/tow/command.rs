//! `TowCommand`, what a tow asks of a robot.

use motion_lab_core::robots::CHANNEL_UNITS;

/// What a towed robot does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TowState {
    /// It stands: its grip is where it is pulled to.
    Rests,
    /// It goes, or turns on the spot.
    Goes,
    /// A car stands and steers: what pulls it is abeam, nearer than it can turn.
    OnlySteers,
    /// A car stands: backing up would fold its trailer farther than steering can open it.
    Folded,
}

/// The channels that a tow asks for, and what the robot does by them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TowCommand {
    /// The channels, -128 to 128 of the robot's limits: forward and left.
    pub channels: [i16; 2],
    /// What the robot does.
    pub state: TowState,
}

impl TowCommand {
    /// A robot at rest.
    pub(super) const REST: TowCommand = TowCommand { channels: [0, 0], state: TowState::Rests };
}

/// The channel that is nearest to a value whose limit is `most`; 0 where there is no limit to measure by.
pub(super) fn channel(value: f64, most: f64) -> i16 {
    // the cast takes what is not a number to 0
    (value / most * CHANNEL_UNITS).clamp(-CHANNEL_UNITS, CHANNEL_UNITS).round_ties_even() as i16
}
