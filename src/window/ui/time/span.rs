//! `TickSpan`, the part of a run that the time line shows.

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

    /// The span `factor` times as near, in which `at` keeps its place; `None` where that is the whole of a run of `end`
    /// ticks.
    pub fn zoomed(self, at: u64, factor: f64, end: u64) -> Option<Self> {
        let long = self.to.saturating_sub(self.from).max(1);
        let wanted = greater((long as f64 / factor).round(), FEWEST as f64);
        if wanted >= end as f64 {
            return None;
        }
        let before = (at.saturating_sub(self.from) as f64 * wanted / long as f64).round() as u64;
        let from = at.saturating_sub(before).min(end - wanted as u64);
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

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: TickSpan = TickSpan { from: 0, to: 1200 };

    #[test]
    fn what_is_under_the_pointer_keeps_its_place() {
        // a quarter from the left, before and after
        assert_eq!(WHOLE.zoomed(300, 2.0, 1200), Some(TickSpan { from: 150, to: 750 }));
        assert_eq!(TickSpan { from: 150, to: 750 }.zoomed(300, 0.5, 1200), None, "the whole again");
        assert_eq!(WHOLE.zoomed(1200, 4.0, 1200), Some(TickSpan { from: 900, to: 1200 }));
        assert_eq!(WHOLE.zoomed(0, 1e9, 1200), Some(TickSpan { from: 0, to: 20 }), "a second at least");
        assert_eq!(WHOLE.zoomed(600, 0.5, 1200), None);
        assert_eq!(TickSpan { from: 0, to: 0 }.zoomed(0, 3.0, 0), None, "nothing has run yet");
        // shown wider at the end of the run, it stays in it
        assert_eq!(TickSpan { from: 1100, to: 1200 }.zoomed(1100, 0.25, 1200), Some(TickSpan { from: 800, to: 1200 }));
    }

    #[test]
    fn the_present_tick_is_always_shown() {
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
