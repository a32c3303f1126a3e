//! `Log`, a whole run as data.

use super::{Digest, Frame, RunDigest, Script};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// A recorded run: everything that determines it, and every frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// The seed.
    pub seed: Seed,
    /// The run's settings, with the worlds themselves.
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

impl Log {
    /// The digest of the whole run; see [`RunDigest`] for what it covers.
    pub fn digest(&self) -> Digest {
        let mut run = RunDigest::new(self.seed, &self.config, &self.script, &self.initial);
        for frame in &self.frames {
            run.tick(frame);
        }
        run.digest()
    }
}
