//! `DigestComparison`, a run compared with a digest log while it is simulated.

use std::fmt;

use super::mcap::{DIGEST_TICKS, DigestLog};
use super::{Digest, RunDigest};

/// A run compared with a digest log, second by second. Ticks beyond the recording are compared with nothing.
#[derive(Clone, Debug)]
pub struct DigestComparison<'a> {
    log: &'a DigestLog,
    difference: Option<DifferingSecond>,
}

/// The first second in which a run differs from its digest log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct DifferingSecond {
    /// The first tick that may differ; 0 for the start of the run.
    pub first_tick: u64,
    /// The last tick of the second; the frames up to it are not the recorded ones.
    pub last_tick: u64,
    /// The digest in the log: the lower half of the run's up to the last tick.
    pub expected: u64,
    /// The same of the simulated run.
    pub found: u64,
}

impl fmt::Display for DifferingSecond {
    /// In words: `second 3, ticks 41 to 60: the digest is 0123456789abcdef in the log, ... in the run`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DifferingSecond { first_tick, last_tick, expected, found } = self;
        match last_tick {
            0 => write!(f, "tick 0, before the first second")?,
            last => write!(f, "second {}, ticks {first_tick} to {last}", last.div_ceil(DIGEST_TICKS))?,
        }
        write!(f, ": the digest is {expected:016x} in the log and {found:016x} in the run")
    }
}

impl<'a> DigestComparison<'a> {
    /// A comparison with a log. The first digest to compare is that of tick 0.
    pub fn with(log: &'a DigestLog) -> Self {
        DigestComparison { log, difference: None }
    }

    /// Compares the run so far, whose last tick is `tick`, where the log has a digest of it. Returns whether all agree
    /// so far.
    pub fn tick(&mut self, tick: u64, run: &RunDigest) -> bool {
        if self.difference.is_none()
            && let Some(expected) = self.log.after(tick)
        {
            let found = DigestLog::kept(run.digest());
            let is_whole = |digest: Digest| tick < self.log.ticks || digest == run.digest();
            if expected != found || !self.log.digest.is_none_or(is_whole) {
                let first_tick = if tick == 0 { 0 } else { (tick - 1) / DIGEST_TICKS * DIGEST_TICKS + 1 };
                self.difference = Some(DifferingSecond { first_tick, last_tick: tick, expected, found });
            }
        }
        self.difference.is_none()
    }

    /// The number of recorded ticks.
    pub fn recorded(&self) -> u64 {
        self.log.ticks
    }

    /// The number of recorded ticks that the run equals, from the first on, once all of them were compared: whole
    /// seconds, where they differ.
    pub fn identical(&self) -> u64 {
        self.difference.map_or(self.log.ticks, |d| d.first_tick.saturating_sub(1))
    }

    /// The first second that differs.
    pub fn difference(&self) -> Option<&DifferingSecond> {
        self.difference.as_ref()
    }
}
