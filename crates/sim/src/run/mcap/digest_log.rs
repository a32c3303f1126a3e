//! `DigestLog`, a run as data without its frames: what determines it, and a digest of each second.

use crate::run::{Digest, Script};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// Number of ticks between two digests of a [`DigestLog`]: a second.
pub const DIGEST_TICKS: u64 = 20;

/// Largest number of robots whose run is logged with every frame unless something else is asked for.
pub const MOST_ROBOTS_IN_FULL: usize = 100;

/// A recorded run without its frames: everything that determines it, and a digest of each second.
///
/// Each digest is the lower half of the [`RunDigest`](crate::run::RunDigest) so far: it covers every frame from the
/// initial one on, so a changed bit in any frame changes the digest of its second and, but for a chance of 2^-64, all
/// that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct DigestLog {
    /// The seed.
    pub seed: Seed,
    /// The run's settings, with the worlds themselves.
    pub config: TourConfig,
    /// The input script.
    pub script: Script,
    /// The digest before tick 1, which covers the initial frame.
    pub start: u64,
    /// The digests after every 20th tick, and after the last tick that is recorded.
    pub digests: Vec<u64>,
    /// The number of recorded ticks.
    pub ticks: u64,
    /// The whole run's digest, in full; `None` when the recording ends before the run does.
    pub digest: Option<Digest>,
}

impl DigestLog {
    /// The recorded digest after `tick`; `None` where none is recorded.
    pub fn after(&self, tick: u64) -> Option<u64> {
        let at = match tick {
            0 => return Some(self.start),
            _ if tick > self.ticks => return None,
            _ if tick == self.ticks => tick.div_ceil(DIGEST_TICKS),
            _ if tick.is_multiple_of(DIGEST_TICKS) => tick / DIGEST_TICKS,
            _ => return None,
        };
        self.digests.get(usize::try_from(at).ok()?.checked_sub(1)?).copied()
    }

    /// The digest that such a log keeps of a run so far: the lower half of the run's.
    pub fn kept(run: Digest) -> u64 {
        run.0 as u64
    }
}

/// A digest log read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadDigestLog {
    /// The run, or its sealed beginning.
    pub log: DigestLog,
    /// The program that wrote it, with its version.
    pub program: String,
}
