//! `TickSpan` and `ShownSpan`, the part of a run that the time line shows.

use motion_lab_core::num::greater;

/// Fewest ticks that are shown: a second.
const FEWEST: u64 = 20;

/// Ticks from one to another, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TickSpan {
    /// The first tick.
    pub from: u64,
    /// The last tick.
    pub to: u64,
}

impl TickSpan {
    /// Whether it holds a tick.
    pub fn holds(self, tick: u64) -> bool {
        (self.from..=self.to).contains(&tick)
    }

    /// The tick of it that is nearest to `tick`.
    pub fn nearest(self, tick: u64) -> u64 {
        tick.clamp(self.from, self.to.max(self.from))
    }

    /// The span `factor` times as near, in which `at`, a time in ticks, lies at this share of it; `None` where that is
    /// the whole of a run of `end` ticks.
    pub fn zoomed(self, (at, share): (f64, f64), factor: f64, end: u64) -> Option<Self> {
        let long = self.to.saturating_sub(self.from).max(1);
        let wanted = greater((long as f64 / factor).round(), FEWEST as f64);
        if wanted >= end as f64 {
            return None;
        }
        let from = ((at - share * wanted).round() as u64).min(end - wanted as u64);
        Some(TickSpan { from, to: from + wanted as u64 })
    }

    /// The span of the same length that holds `tick`: itself, or moved so that a quarter of it lies ahead; `None` where
    /// it is the whole of a run of `end` ticks.
    pub fn with(self, tick: u64, end: u64) -> Option<Self> {
        let long = self.to.saturating_sub(self.from);
        if long >= end {
            return None;
        }
        let from = if tick > self.to {
            (tick + long / 4).saturating_sub(long)
        } else if tick < self.from {
            tick.saturating_sub(long / 4)
        } else {
            self.from
        };
        let from = from.min(end - long);
        Some(TickSpan { from, to: from + long })
    }
}

/// The part of a run that the time line shows. It goes along with the present tick, and stays where the reader looks
/// elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShownSpan {
    /// The part; `None` for all of the run.
    pub part: Option<TickSpan>,
    /// The present tick of the last frame.
    tick: u64,
    /// The time in ticks that the wheel turns about. It is kept while it is under the pointer, so that the ends, which
    /// are whole ticks, do not carry it away step by step.
    pivot: f64,
}

impl ShownSpan {
    /// What is shown of a run of `end` ticks that stands at `tick`. A tick that goes on out of sight, as a run plays,
    /// moves nothing; one that leaves the part or that is gone to is shown.
    pub fn follow(&mut self, tick: u64, end: u64, playing: bool) -> TickSpan {
        let before = std::mem::replace(&mut self.tick, tick);
        let goes_on_unseen = playing && tick > before && self.part.is_some_and(|part| !part.holds(before));
        let is_still = tick == before || goes_on_unseen;
        self.part = self.part.and_then(|part| part.with(if is_still { part.nearest(tick) } else { tick }, end));
        self.part.unwrap_or(TickSpan { from: 0, to: end })
    }

    /// Shows `factor` times less of a run of `end` ticks, of which `span` is shown. What is at this share of it stays
    /// there.
    pub fn zoom(&mut self, span: TickSpan, share: f64, factor: f64, end: u64) {
        let under = span.from as f64 + share * span.to.saturating_sub(span.from) as f64;
        if (self.pivot - under).abs() > 0.5 {
            self.pivot = under;
        }
        self.part = span.zoomed((self.pivot, share), factor, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: TickSpan = TickSpan { from: 0, to: 1200 };

    #[test]
    fn what_is_under_the_pointer_keeps_its_place() {
        let zoomed = |span: TickSpan, at: u64, factor, end| {
            let share = (at - span.from) as f64 / (span.to - span.from).max(1) as f64;
            span.zoomed((at as f64, share), factor, end)
        };
        // a quarter from the left, before and after
        assert_eq!(zoomed(WHOLE, 300, 2.0, 1200), Some(TickSpan { from: 150, to: 750 }));
        assert_eq!(zoomed(TickSpan { from: 150, to: 750 }, 300, 0.5, 1200), None, "the whole again");
        assert_eq!(zoomed(WHOLE, 1200, 4.0, 1200), Some(TickSpan { from: 900, to: 1200 }));
        assert_eq!(zoomed(WHOLE, 0, 1e9, 1200), Some(TickSpan { from: 0, to: 20 }), "a second at least");
        assert_eq!(zoomed(WHOLE, 600, 0.5, 1200), None);
        assert_eq!(zoomed(TickSpan { from: 0, to: 0 }, 0, 3.0, 0), None, "nothing has run yet");
        // shown wider at the end of the run, it stays in it
        assert_eq!(zoomed(TickSpan { from: 1100, to: 1200 }, 1100, 0.25, 1200), Some(TickSpan { from: 800, to: 1200 }));
    }

    #[test]
    fn a_part_stays_where_the_reader_looks_and_goes_along_with_what_is_gone_to() {
        let part = TickSpan { from: 100, to: 200 };
        let mut shown = ShownSpan { part: Some(part), tick: 1200, pivot: 0.0 };
        for (tick, playing, from, why) in [
            (1200, false, 100, "paused elsewhere, it stays"),
            (1201, true, 100, "what plays on out of sight does not call it there"),
            (1260, true, 100, "nor does it at a high speed"),
            (1259, false, 1184, "a tick back is gone to: 25 of the 100 ticks lie before it"),
            (1260, true, 1184, "and plays on in sight"),
            (1285, true, 1200, "until the end of the run, which grows"),
            (40, true, 15, "played in a loop it is at its beginning"),
            (150, true, 75, "and what leaves it is followed"),
        ] {
            let now = shown.follow(tick, 1300, playing);
            assert_eq!((now.from, now.to), (from, from + 100), "{why}");
            assert_eq!(shown.part, Some(now), "{why}");
        }
        assert_eq!(shown.follow(0, 90, false), TickSpan { from: 0, to: 90 }, "a shorter run is shown whole");
        assert_eq!(shown.part, None);
        // a run that was cut off behind the part
        let mut shown = ShownSpan { part: Some(TickSpan { from: 1100, to: 1200 }), tick: 700, pivot: 0.0 };
        assert_eq!(shown.follow(700, 900, false), TickSpan { from: 800, to: 900 });
    }

    #[test]
    fn a_tick_is_shown_by_the_least_move() {
        let near = TickSpan { from: 400, to: 500 };
        for (tick, end) in [(0, 1200), (399, 1200), (400, 1200), (450, 1200), (500, 500), (501, 501), (1200, 1200)] {
            let span = near.with(tick, end).unwrap();
            assert!(span.holds(tick) && span.to <= end && span.to - span.from == 100, "{tick} of {end}: {span:?}");
        }
        assert_eq!(near.with(450, 1200), Some(near), "it does not move without need");
        assert_eq!(near.with(500, 1200), Some(near), "nor under a pointer that drags to its end");
        assert_eq!(near.with(501, 1200), Some(TickSpan { from: 426, to: 526 }), "with room for what comes");
        assert_eq!(near.with(399, 1200), Some(TickSpan { from: 374, to: 474 }));
        assert_eq!(near.with(50, 90), None, "a run that is shorter is shown whole");
    }
}
