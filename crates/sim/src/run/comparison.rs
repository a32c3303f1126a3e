//! `Comparison`, a run compared with a log while it is simulated.

use std::borrow::Borrow;
use std::fmt;
use std::slice::from_ref;

use super::log::DIGEST_TICKS;
use super::{Digest, Divergence, Frame, Log, Recorded, RunDigest, first_divergence};

/// A run compared with a log, tick by tick from tick 0 on: its frames in every bit, or its digests second by second.
/// Ticks beyond the recording are compared with nothing.
///
/// `L` is a [`Log`], a reference to one, or a box.
#[derive(Clone, Debug)]
pub struct Comparison<L> {
    log: L,
    run: RunDigest,
    difference: Option<Difference>,
}

/// The first place in which a run differs from its log.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// A value of a frame: `expected` in the log, `found` in the run; [named](Divergence::named).
    Value(Divergence),
    /// A second, by its digest.
    Second(DifferingSecond),
}

/// A second in which a run differs from its log of digests.
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

impl Difference {
    /// The first tick that differs, or may.
    pub fn first_tick(&self) -> u64 {
        match self {
            Difference::Value(divergence) => divergence.tick,
            Difference::Second(second) => second.first_tick,
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Difference::Value(divergence) => divergence.fmt(f),
            Difference::Second(second) => second.fmt(f),
        }
    }
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

impl<L: Borrow<Log>> Comparison<L> {
    /// A comparison of a run at tick 0, whose frame is `initial`.
    pub fn begin(log: L, initial: &Frame) -> Self {
        let run = RunDigest::new(&log.borrow().recipe, initial);
        let mut comparison = Comparison { log, run, difference: None };
        comparison.compare(initial);
        comparison
    }

    /// Compares the run's next frame. Returns whether all agree so far.
    pub fn tick(&mut self, frame: &Frame) -> bool {
        self.run.tick(frame);
        self.compare(frame);
        self.difference.is_none()
    }

    fn compare(&mut self, frame: &Frame) {
        if self.difference.is_some() {
            return;
        }
        let log = self.log.borrow();
        self.difference = match &log.recorded {
            Recorded::Frames { .. } => log
                .frame(frame.tick)
                .and_then(|recorded| first_divergence(from_ref(recorded), from_ref(frame)))
                .map(|divergence| Difference::Value(divergence.named(&log.recipe.config))),
            Recorded::Digests(digests) => digests.after(frame.tick).and_then(|expected| {
                let (tick, found) = (frame.tick, self.run.lower_half());
                let is_whole = |whole: Digest| tick < digests.ticks || whole == self.run.digest();
                if expected == found && digests.whole.is_none_or(is_whole) {
                    return None;
                }
                let first_tick = if tick == 0 { 0 } else { (tick - 1) / DIGEST_TICKS * DIGEST_TICKS + 1 };
                Some(Difference::Second(DifferingSecond { first_tick, last_tick: tick, expected, found }))
            }),
        };
    }

    /// The log.
    pub fn log(&self) -> &Log {
        self.log.borrow()
    }

    /// The digest of the run so far.
    pub fn digest(&self) -> Digest {
        self.run.digest()
    }

    /// The first place that differs.
    pub fn difference(&self) -> Option<&Difference> {
        self.difference.as_ref()
    }

    /// The number of recorded ticks that the run equals, from the first on, once all of them were compared: whole
    /// seconds, where a log of digests differs.
    pub fn identical(&self) -> u64 {
        self.difference.as_ref().map_or(self.log().ticks(), |d| d.first_tick().saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::fixture;

    #[test]
    fn the_first_difference_counts_and_what_is_not_recorded_agrees() {
        let log = fixture::log();
        let initial = log.initial().unwrap();
        let mut same = Comparison::begin(&log, initial);
        assert!(log.frames().iter().all(|frame| same.tick(frame)));
        assert!(same.tick(&Frame { tick: 4, ..initial.clone() }), "nothing is recorded of this tick");
        assert_eq!((same.identical(), same.difference()), (3, None));

        let mut frames = log.frames().to_vec();
        frames[1].robots[0].contacts ^= 1;
        frames[2].robots[0].flash ^= 1;
        let mut differing = Comparison::begin(&log, initial);
        let agree: Vec<bool> = frames.iter().map(|frame| differing.tick(frame)).collect();
        assert_eq!((agree, differing.identical()), (vec![true, false, false], 1));
        let Some(Difference::Value(Divergence { tick, field, .. })) = differing.difference() else { panic!() };
        assert_eq!((*tick, field.as_str()), (2, "contacts"));

        let at_start = Comparison::begin(&log, &Frame { robots: Vec::new(), ..initial.clone() });
        assert_eq!((at_start.identical(), at_start.difference().map(Difference::first_tick)), (0, Some(0)));
    }

    #[test]
    fn the_run_s_digest_is_that_of_its_log() {
        let log = fixture::log();
        let mut run = Comparison::begin(&log, log.initial().unwrap());
        log.frames().iter().for_each(|frame| assert!(run.tick(frame)));
        assert_eq!(Some(run.digest()), log.digest());
    }
}
