//! `Stay`, when and for how long a robot has to be at its goal.

use serde::Deserialize;

/// When and for how long the robot has to be at the goal.
///
/// Left out, or `(hold: 1, at: any)`: the attempt is over at the first tick at which the robot is at the goal, even if
/// it only drives through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stay {
    /// Number of ticks in a row that the robot has to be there, from 1 to the limit's ticks; 1 when left out.
    #[serde(default)]
    pub hold: Option<u64>,
    /// When it has to be there.
    #[serde(default)]
    pub at: When,
}

/// When the robot has to be at the goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum When {
    /// At any time within the limit: the attempt ends there.
    #[default]
    Any,
    /// At the end: the attempt lasts as many ticks as the limit says, and the robot has to be at the goal in the last
    /// `hold` of them.
    End,
}
