//! `Comparison`, a run compared with a recording while it is simulated.

use std::slice::from_ref;

use super::{Divergence, Frame, Log, first_divergence};
use crate::tour::TourConfig;

/// A run compared with a recording, frame by frame from tick 0 on. The frames of ticks beyond the recording's last one
/// are compared with nothing.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    /// The recorded frames that are not compared yet.
    recorded: std::iter::Chain<std::option::IntoIter<&'a Frame>, std::slice::Iter<'a, Frame>>,
    ticks: u64,
    /// The recording's configuration, which names robots and sensors.
    config: Option<&'a TourConfig>,
    divergence: Option<Divergence>,
}

impl<'a> Comparison<'a> {
    /// A comparison with all frames of a log. The first frame to compare is that of tick 0.
    pub fn with(log: &'a Log) -> Self {
        Comparison { config: Some(&log.config), ..Self::from_tick_0(Some(&log.initial), &log.frames) }
    }

    /// A comparison with these frames, the first of which is that of tick 1; tick 0 is not compared.
    pub fn with_frames(frames: &'a [Frame]) -> Self {
        Self::from_tick_0(None, frames)
    }

    fn from_tick_0(initial: Option<&'a Frame>, frames: &'a [Frame]) -> Self {
        let recorded = initial.into_iter().chain(frames);
        Comparison { recorded, ticks: frames.len() as u64, config: None, divergence: None }
    }

    /// Compares the next frame of the run with the recorded one. Returns whether all frames so far agree in every bit.
    pub fn frame(&mut self, frame: &Frame) -> bool {
        let recorded = self.recorded.next();
        if self.divergence.is_none()
            && let Some(recorded) = recorded
        {
            let divergence = first_divergence(from_ref(recorded), from_ref(frame));
            self.divergence = match self.config {
                Some(config) => divergence.map(|divergence| divergence.named(config)),
                None => divergence,
            };
        }
        self.divergence.is_none()
    }

    /// The number of recorded ticks.
    pub fn recorded(&self) -> u64 {
        self.ticks
    }

    /// The number of recorded ticks that the run equals, from the first on, once all of them were compared.
    pub fn identical(&self) -> u64 {
        self.divergence.as_ref().map_or(self.ticks, |d| d.tick.saturating_sub(1))
    }

    /// The first value that differs: `expected` in the recording, `found` in the run. Compared with a log, it is
    /// [named](Divergence::named).
    pub fn divergence(&self) -> Option<&Divergence> {
        self.divergence.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::fixture;

    #[test]
    fn the_first_difference_counts_and_what_is_not_recorded_agrees() {
        let log = fixture::log();
        let mut same = Comparison::with(&log);
        assert!(std::iter::once(&log.initial).chain(&log.frames).all(|frame| same.frame(frame)));
        assert!(same.frame(&log.initial), "nothing is recorded of this tick");
        assert_eq!((same.recorded(), same.identical(), same.divergence()), (3, 3, None));

        let mut other = log.clone();
        other.frames[1].robots[0].contacts ^= 1;
        other.frames[2].robots[0].flash ^= 1;
        let mut differing = Comparison::with_frames(&log.frames);
        let agree: Vec<bool> = other.frames.iter().map(|frame| differing.frame(frame)).collect();
        assert_eq!(agree, [true, false, false]);
        assert_eq!((differing.recorded(), differing.identical()), (3, 1));
        let Divergence { tick, field, .. } = differing.divergence().unwrap();
        assert_eq!((*tick, field.as_str()), (2, "contacts"));

        let mut at_start = Comparison::with(&log);
        assert!(!at_start.frame(&Frame { robots: Vec::new(), ..log.initial.clone() }));
        assert_eq!(at_start.identical(), 0);
    }
}
