//! `Frame`, the whole simulation's state after a tick, in its one canonical form.

use smallvec::SmallVec;

use crate::configuration::Coordinates;

/// A run's digest: xxh3-128 over the canonical encoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest(pub u128);

impl std::fmt::Display for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// The state of one robot after a tick: all that is needed to go on from here.
///
/// No NaN enters it, and -0.0 is stored as +0.0.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotState {
    /// The robot's id: its place in the run's list of robots.
    pub id: u32,
    /// The configuration's coordinates in its chart; their number tells the space.
    pub configuration: Coordinates,
    /// The robot's own state beside its configuration, in the order its kind documents: Rusty's accumulated left and right
    /// wheel turns (radians), its tour's next waypoint.
    pub extra: SmallVec<[f64; 4]>,
    /// The control channels held by manual driving, -128 to 128 of the maximum.
    pub channels: [i16; 2],
    /// The coordinates a manual move is heading for; empty when there is none.
    pub target: Coordinates,
    /// Whether a person drives, not the tour.
    pub manual: bool,
    /// Whether the last tick was in contact.
    pub in_contact: bool,
    /// Contact episodes since tick 0.
    pub contacts: u32,
    /// Ticks for which the flash still holds.
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
    /// What the robots' range sensors saw, by ascending robot id; a robot without a sensor has none.
    pub scans: Vec<RobotScan>,
}

/// What one robot's range sensor saw at the end of a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotScan {
    /// The robot's id.
    pub robot: u32,
    /// The range of each ray, metres; infinity where nothing is in range.
    pub ranges: Vec<f64>,
}
