//! `EvasionSet`, the inputs among which a way out is sought.

use crate::run::MAX_CHANNEL;

/// The greatest number of switches.
pub const MAX_SWITCHES: u32 = 3;

/// The greatest number of ticks before a contact, and after it: ten minutes.
pub const MAX_WINDOW: u64 = 12_000;

/// The greatest number of branches from one tick.
pub const MAX_BRANCHES: u64 = 1_000_000;

/// The inputs among which a way out is sought: the robot is driven by channels that stay the same but for a few
/// switches. All of them are tried.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EvasionSet {
    /// The speed channels.
    pub speeds: EvasionSpeeds,
    /// The values of the second channel, the turn rate or the steering angle, in the order in which they are tried.
    pub turns: Vec<i16>,
    /// How often the channels may change after the first of them apply.
    pub switches: u32,
    /// The channels change at multiples of this many ticks after the first apply.
    pub every: u64,
    /// How many ticks from the contact's on must be free of contact.
    pub horizon: u64,
    /// From how many ticks before the contact a way out is sought.
    pub back: u64,
}

/// The speed channels among which a way out is sought.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EvasionSpeeds {
    /// The speed that the robot had: it steers, and neither brakes nor turns back.
    Kept,
    /// These values, in the order in which they are tried.
    Channels(Vec<i16>),
}

/// Why a set is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EvasionSetError {
    /// No channels at all.
    #[error("no {0}: there must be one at least")]
    None(&'static str),
    /// A channel out of range.
    #[error("channel {0}: channels are from -{MAX_CHANNEL} to {MAX_CHANNEL}")]
    Channel(i16),
    /// Too many switches.
    #[error("{0} switches: at most {MAX_SWITCHES}")]
    Switches(u32),
    /// Channels that never may change.
    #[error("a switch every 0 ticks: there must be 1 at least")]
    Every,
    /// A window of no ticks, or of too many.
    #[error("{ticks} ticks {what}: there must be 1 to {MAX_WINDOW}")]
    Window {
        /// Of which side of the contact.
        what: &'static str,
        /// The number of ticks.
        ticks: u64,
    },
    /// Too many branches.
    #[error("{0} branches from one tick: at most {MAX_BRANCHES}; take fewer channels or switches, or rarer ones")]
    Branches(u64),
}

impl Default for EvasionSet {
    /// Steering alone: nine angles or rates, one switch at multiples of 0.25 s, 2 s free of contact, from at most 5 s
    /// before.
    fn default() -> Self {
        EvasionSet {
            speeds: EvasionSpeeds::Kept,
            turns: vec![0, 32, -32, 64, -64, 96, -96, 128, -128],
            switches: 1,
            every: 5,
            horizon: 40,
            back: 100,
        }
    }
}

impl EvasionSet {
    /// Checks the set.
    ///
    /// # Errors
    /// [`EvasionSetError`], for the first thing out of range.
    pub fn check(&self) -> Result<(), EvasionSetError> {
        let speeds = match &self.speeds {
            EvasionSpeeds::Kept => &[0][..],
            EvasionSpeeds::Channels(speeds) => speeds,
        };
        for (what, channels) in [("speeds", speeds), ("turns", &self.turns)] {
            if channels.is_empty() {
                return Err(EvasionSetError::None(what));
            }
            if let Some(&channel) = channels.iter().find(|c| !(-MAX_CHANNEL..=MAX_CHANNEL).contains(*c)) {
                return Err(EvasionSetError::Channel(channel));
            }
        }
        if self.switches > MAX_SWITCHES {
            return Err(EvasionSetError::Switches(self.switches));
        }
        if self.every == 0 {
            return Err(EvasionSetError::Every);
        }
        for (what, ticks) in [("after the contact", self.horizon), ("before the contact", self.back)] {
            if !(1..=MAX_WINDOW).contains(&ticks) {
                return Err(EvasionSetError::Window { what, ticks });
            }
        }
        let branches = self.branches(speeds.len() as u64);
        if branches > MAX_BRANCHES { Err(EvasionSetError::Branches(branches)) } else { Ok(()) }
    }

    /// The number of branches from the earliest tick, with this many speeds, if none meets anything: the inputs to the
    /// power of the pieces, for each choice of the ticks at which they change.
    fn branches(&self, speeds: u64) -> u64 {
        let inputs = speeds.saturating_mul(self.turns.len() as u64);
        let places = (self.back + self.horizon) / self.every;
        let (mut branches, mut choices, mut all) = (inputs, 1_u64, inputs);
        for switch in 0..u64::from(self.switches) {
            // binomial coefficients, one from the last
            choices = choices.saturating_mul(places.saturating_sub(switch)) / (switch + 1);
            branches = branches.saturating_mul(inputs.saturating_sub(1));
            all = all.saturating_add(branches.saturating_mul(choices));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_range_is_refused() {
        assert_eq!(EvasionSet::default().check(), Ok(()));
        let refused = |set: EvasionSet| set.check().unwrap_err().to_string();
        let set = EvasionSet::default;
        assert!(refused(EvasionSet { turns: vec![], ..set() }).starts_with("no turns"));
        assert!(refused(EvasionSet { speeds: EvasionSpeeds::Channels(vec![]), ..set() }).starts_with("no speeds"));
        assert!(refused(EvasionSet { turns: vec![0, 129], ..set() }).starts_with("channel 129"));
        assert!(refused(EvasionSet { switches: 4, ..set() }).starts_with("4 switches"));
        assert!(refused(EvasionSet { every: 0, ..set() }).starts_with("a switch every 0 ticks"));
        assert!(refused(EvasionSet { horizon: 0, ..set() }).starts_with("0 ticks after"));
        assert!(refused(EvasionSet { back: 12_001, ..set() }).starts_with("12001 ticks before"));
    }

    #[test]
    fn branches_are_counted_as_by_hand() {
        // 2 inputs, 3 places for a switch: 2, then 2 * 1 * 3, then 2 * 1 * 1 * 3
        let set = EvasionSet { turns: vec![1, 2], switches: 2, every: 4, horizon: 6, back: 6, ..EvasionSet::default() };
        assert_eq!(set.branches(1), 2 + 6 + 6);
        let many = EvasionSet { switches: 3, every: 1, horizon: 12_000, back: 12_000, ..EvasionSet::default() };
        assert!(matches!(many.check(), Err(EvasionSetError::Branches(n)) if n > MAX_BRANCHES));
    }
}
