//! `Log`, a recorded run as data.

use std::sync::Arc;

use super::{Digest, Frame, Recipe, RunDigest};
use crate::tour::TourConfig;

/// Number of ticks between two digests of a log without frames: a second.
pub const DIGEST_TICKS: u64 = 20;

/// Largest number of robots whose run is logged with every frame unless something else is asked for.
pub const MAX_ROBOTS_IN_FULL: usize = 100;

/// What a log has of its run beside the recipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogKind {
    /// Every frame to the last bit.
    Frames,
    /// A digest of each second.
    Digests,
}

impl LogKind {
    /// The kind for a run of which nobody said it: frames for at most [`MAX_ROBOTS_IN_FULL`] robots.
    pub fn usual(config: &TourConfig) -> Self {
        if config.robot_names().count() > MAX_ROBOTS_IN_FULL { LogKind::Digests } else { LogKind::Frames }
    }
}

/// A recorded run: its recipe, and its frames or their digests.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// What determines the run.
    pub recipe: Recipe,
    /// What was recorded of it.
    pub recorded: Recorded,
}

/// What was recorded of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Recorded {
    /// Every frame.
    Frames {
        /// The state before tick 1.
        initial: Frame,
        /// The state after each tick: `frames[k]` is that of tick k + 1.
        frames: Vec<Frame>,
    },
    /// A digest of each second.
    Digests(SecondDigests),
}

/// The digests of a run, second by second.
///
/// Each is the lower half of the [`RunDigest`] so far: it covers every frame from the initial one on. So a changed bit
/// in any frame changes the digest of its second and, but for a chance of 2^-64, all that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondDigests {
    /// The digest before tick 1, which covers the initial frame.
    pub start: u64,
    /// The digests after every 20th tick, and after the last tick that is recorded.
    pub digests: Vec<u64>,
    /// The number of recorded ticks.
    pub ticks: u64,
    /// The whole run's digest, in full; `None` when the recording ends before the run does.
    pub whole: Option<Digest>,
}

impl SecondDigests {
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
}

impl Log {
    /// The recipe of what is recorded: of a recording that ends early, one that ends with it.
    pub fn recorded_recipe(&self) -> Recipe {
        let mut recipe = self.recipe.clone();
        if recipe.config.ticks != self.ticks() {
            Arc::make_mut(&mut recipe.config).ticks = self.ticks();
            recipe.script.truncate_after(self.ticks());
        }
        recipe
    }

    /// A log with frames.
    pub fn with_frames(recipe: Recipe, initial: Frame, frames: Vec<Frame>) -> Self {
        Log { recipe, recorded: Recorded::Frames { initial, frames } }
    }

    /// What it has of the run.
    pub fn kind(&self) -> LogKind {
        match self.recorded {
            Recorded::Frames { .. } => LogKind::Frames,
            Recorded::Digests(_) => LogKind::Digests,
        }
    }

    /// The state after each tick: number k is that of tick k + 1. Empty for a log of digests.
    pub fn frames(&self) -> &[Frame] {
        match &self.recorded {
            Recorded::Frames { frames, .. } => frames,
            Recorded::Digests(_) => &[],
        }
    }

    /// The same, to be changed: a forged log.
    pub fn frames_mut(&mut self) -> &mut [Frame] {
        match &mut self.recorded {
            Recorded::Frames { frames, .. } => frames,
            Recorded::Digests(_) => &mut [],
        }
    }

    /// The frames alone.
    pub fn into_frames(self) -> Vec<Frame> {
        match self.recorded {
            Recorded::Frames { frames, .. } => frames,
            Recorded::Digests(_) => Vec::new(),
        }
    }

    /// The state before tick 1; `None` in a log of digests.
    pub fn initial(&self) -> Option<&Frame> {
        match &self.recorded {
            Recorded::Frames { initial, .. } => Some(initial),
            Recorded::Digests(_) => None,
        }
    }

    /// The state after a tick, 0 for the initial one; `None` where it is not recorded.
    pub fn frame(&self, tick: u64) -> Option<&Frame> {
        match tick.checked_sub(1) {
            None => self.initial(),
            Some(before) => self.frames().get(usize::try_from(before).ok()?),
        }
    }

    /// The number of recorded ticks.
    pub fn ticks(&self) -> u64 {
        match &self.recorded {
            Recorded::Frames { frames, .. } => frames.len() as u64,
            Recorded::Digests(digests) => digests.ticks,
        }
    }

    /// The digest of the run as far as it is recorded; see [`RunDigest`] for what it covers. `None` for a log of
    /// digests that ends before its run does.
    pub fn digest(&self) -> Option<Digest> {
        match &self.recorded {
            Recorded::Frames { initial, frames } => {
                let mut run = RunDigest::new(&self.recipe, initial);
                frames.iter().for_each(|frame| run.tick(frame));
                Some(run.digest())
            }
            Recorded::Digests(digests) => digests.whole,
        }
    }
}
