//! `Explanation`, what is known of a contact: until when it could be avoided, and how.

use super::ContactEpisode;
use crate::run::Script;

/// What is known of a contact.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Explanation {
    /// The contact.
    pub episode: ContactEpisode,
    /// The last tick from which standing still avoids it. For the lab's robots that is the contact's own tick, as they
    /// stop within a tick; it is earlier for a robot that brakes, and none for one that begins in contact.
    pub stopping: LastChance,
    /// The last tick from which the robot avoids it and goes on: one that drives, among the set of inputs; an arm, by a
    /// path round to where it leaves the contact.
    pub going_on: LastChance,
}

/// The last tick at which a contact can be avoided.
#[derive(Clone, Debug, PartialEq)]
pub enum LastChance {
    /// There is one. From the next tick up to the contact's it is too late: by no input of the set; of an arm's way
    /// round, by no path that the planner finds.
    At(Evasion),
    /// There is none.
    None(NoEvasion),
}

impl LastChance {
    /// The way out, if there is one.
    pub fn evasion(&self) -> Option<&Evasion> {
        match self {
            LastChance::At(evasion) => Some(evasion),
            LastChance::None(_) => None,
        }
    }
}

/// A way out of a contact. The run with its script has been simulated, and has no contact of the robot up to
/// [`free_until`](Self::free_until) that the run did not have before.
#[derive(Clone, Debug, PartialEq)]
pub struct Evasion {
    /// The first tick with another input: the last chance.
    pub tick: u64,
    /// The last tick that is known to be free. A robot that is driven by channels then stops.
    pub free_until: u64,
    /// By what the robot avoids the contact.
    pub means: EvasionMeans,
    /// The whole script of the run with the way out: what the robot got before, this, and what all others get.
    pub script: Script,
    /// What it took to know that nothing later will do.
    pub extent: SearchExtent,
    /// Whether the other robot that it would meet is in contact from then on up to there, with whatever: a contact
    /// counts for whoever moves, so that one that drives on may still meet this one, which stands.
    pub is_still_met: bool,
    /// Whether it stands in the way of a change of the world that the run makes meanwhile, such as a closing door,
    /// which is then refused.
    pub is_in_the_way: bool,
}

/// By what a robot avoids a contact.
#[derive(Clone, Debug, PartialEq)]
pub enum EvasionMeans {
    /// Channels, each from its tick on.
    Channels(Vec<(u64, [i16; 2])>),
    /// An arm stays where it is.
    Standing,
    /// A path of an arm, of this length by its joints, radians, which ends after this tick.
    Path {
        /// The length, radians.
        length: f64,
        /// The last tick of the way.
        arrives: u64,
    },
}

/// Why there is no way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoEvasion {
    /// No input of the set avoids it, from this tick on; none was tried from an earlier one.
    #[error("no input of the set avoids it, from tick {} on", .0.earliest)]
    TooLate(SearchExtent),
    /// The robot stood, so it has no speed to keep.
    #[error("it stood, so there is no speed to keep; name the speeds to be tried")]
    Stood,
    /// The robot's speed is not known.
    #[error("its speed is not known; name the speeds to be tried")]
    NoSpeed,
    /// The robot takes neither channels nor targets.
    #[error("it takes no inputs by which it could avoid anything")]
    NoInputs,
    /// The run ends in contact, so that an arm's path has no end.
    #[error("the run ends in contact, so it is not known where it would leave it")]
    EndsInContact,
    /// Others live in the arm's world, and a path knows nothing of them.
    #[error("{0} lives in its world too, and a path knows nothing of it")]
    Company(String),
    /// No planner found a path that can be played.
    #[error("there is no path round to where it leaves the contact: {0}")]
    NoPath(String),
}

/// How far a search went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SearchExtent {
    /// The earliest tick from which it was sought.
    pub earliest: u64,
    /// The number of branches that were tried, each counted once.
    pub branches: u64,
    /// The number of ticks of all branches.
    pub ticks: u64,
}
