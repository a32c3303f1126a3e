//! `Log`, a whole run as data.

use super::{Digest, Frame, Script};
use crate::random::Seed;
use crate::tour::TourConfig;

/// The length of a tick in seconds: the simulation runs at 20 Hz. Time is tick * DT, never a sum.
pub const DT: f64 = 0.05;

/// A recorded run: everything that determines it, and every frame that came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// The seed.
    pub seed: Seed,
    /// The configuration, with the worlds themselves.
    pub config: TourConfig,
    /// The input script.
    pub script: Script,
    /// The state before tick 1.
    pub initial: Frame,
    /// The state after each tick: `frames[k]` is that of tick k + 1.
    pub frames: Vec<Frame>,
    /// The digest of each tick's frame, in the same order.
    pub digests: Vec<Digest>,
}
