//! A contact bracketed by bisection between a free place and one in contact, then proven to be the first by steps
//! backward from the bracket.

use smallvec::SmallVec;

use super::conservative_advancement::BRACKET;
use super::place::{At, ContactAhead};
use crate::geometry::Footprint;
use crate::num::{greater, lesser, sqrt};
use crate::robots::Motion;

/// Largest number of steps in a proof; with more the caller falls back to the march.
const MAX_STEPS: usize = 24;

/// Steps, each as its start and its end.
type Steps = SmallVec<[(f64, f64); MAX_STEPS]>;

/// Largest number of contacts tried, each before the last: the contact bracketed first need not be the motion's first.
const CONTACTS: u32 = 8;

/// Largest number of distance queries in the approach to one contact.
const TRIES: u32 = 40;

/// Bounds on the speed and acceleration of the parts that may hit, as in `Rates`.
#[derive(Clone, Copy)]
pub(crate) struct SpeedBounds {
    pub(crate) speed: f64,
    pub(crate) acceleration: f64,
}

/// A free place of a motion: its parameter, its distance from contact in metres, and the closing speed there in metres
/// per unit of s.
#[derive(Clone, Copy)]
struct FreePlace {
    s: f64,
    gap: f64,
    closing: f64,
}

/// A contact in a bracket of at most [`BRACKET`] of motion, and the steps, last first, that prove the motion free from
/// where the search began to the bracket.
pub(crate) struct Pinched {
    pub(crate) free_until: f64,
    pub(crate) contact_at: f64,
    pub(crate) steps: Steps,
}

/// Brackets the first contact after a free place, given a contact farther on. `None` where that takes too long or the
/// motion up to the bracket is not proven free: the caller falls back to the march.
///
/// `gap` returns a footprint's distance from contact, metres, 0 in contact. `is_proven` returns whether one step
/// proves the motion free between two places.
pub(crate) fn pinch<M: Motion>(
    gap: impl Fn(&Footprint) -> f64,
    is_proven: impl Fn(At, At) -> bool,
    motion: &M,
    pace: SpeedBounds,
    ahead: ContactAhead,
) -> Option<Pinched> {
    let gap_at = |s: f64| gap(&motion.footprint_at(s));
    let from = FreePlace { s: ahead.from.s, gap: ahead.gap, closing: pace.speed };
    let mut contact = ahead.contact;
    for _ in 0..CONTACTS {
        let (near, contact_at) = approach(gap_at, pace, from, contact)?;
        match prove_back(&gap, &is_proven, motion, pace, ahead.from, near)? {
            Ok(steps) => return Some(Pinched { free_until: near.s, contact_at, steps }),
            Err(earlier) => contact = earlier,
        }
    }
    None
}

/// Proves the motion free from `start` to a free place, backward in steps that grow with the clearance. Returns the
/// steps, last first, or a contact between the two; `None` where it finds neither.
fn prove_back<M: Motion>(
    gap: impl Fn(&Footprint) -> f64,
    is_proven: impl Fn(At, At) -> bool,
    motion: &M,
    pace: SpeedBounds,
    start: At,
    near: FreePlace,
) -> Option<Result<Steps, f64>> {
    let At { s: lo, footprint: at_lo } = start;
    let mut steps = Steps::new();
    let (mut hi, mut at_hi, mut room) = (near.s, motion.footprint_at(near.s), near.gap);
    while hi > lo {
        if steps.len() == MAX_STEPS {
            return None;
        }
        // as far back as the room, which is least at the end nearer to the contact, exceeds one and a half times the
        // sagitta
        let mut h = sqrt(room / (1.5 * 0.125 * greater(pace.acceleration, 1e-9)));
        let (from, at_from) = loop {
            let from = if h < hi - lo { hi - h } else { lo };
            let at_from = if from == lo { at_lo.clone() } else { motion.footprint_at(from) };
            if is_proven(At::new(from, &at_from), At::new(hi, &at_hi)) {
                break (from, at_from);
            }
            if from > lo && gap(&at_from) <= 0.0 {
                return Some(Err(from));
            }
            h = 0.25 * lesser(h, hi - lo);
            if h * pace.speed < 0.1 * BRACKET {
                return None;
            }
        };
        steps.push((from, hi));
        room += 0.5 * near.closing * (hi - from);
        (hi, at_hi) = (from, at_from);
    }
    Some(Ok(steps))
}

/// A free place and a contact after it, not farther apart than [`BRACKET`]; `None` after too many queries.
fn approach(
    gap_at: impl Fn(f64) -> f64,
    pace: SpeedBounds,
    mut near: FreePlace,
    mut contact: f64,
) -> Option<(FreePlace, f64)> {
    // a little less than the bracket, so that its two ends fit in it
    let fine = 0.45 * BRACKET / pace.speed;
    for _ in 0..TRIES {
        if (contact - near.s) * pace.speed <= BRACKET {
            return Some((near, contact));
        }
        let ahead = near.gap / near.closing;
        // most of the way to the expected contact; once near, just before it, then just behind it
        let step = if ahead > 1e3 * fine {
            0.9 * ahead
        } else if ahead > fine {
            ahead - 0.5 * fine
        } else {
            2.0 * fine
        };
        let s = if near.s + step < contact { near.s + step } else { 0.5 * (near.s + contact) };
        let gap = gap_at(s);
        if gap <= 0.0 {
            contact = s;
            continue;
        }
        let closing = (near.gap - gap) / (s - near.s);
        near = FreePlace { s, gap, closing: if closing > 1e-3 * pace.speed { closing } else { pace.speed } };
    }
    None
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn a_contact_is_approached_in_a_few_questions() {
        // gaps that close evenly, ever faster, and hardly at all; the first contact is at 0.7
        let gaps: [fn(f64) -> f64; 3] = [|s| 0.7 - s, |s| 0.49 - s * s, |s| 0.02 * (0.7 - s)];
        let pace = SpeedBounds { speed: 2.0, acceleration: 2.0 };
        for (i, gap) in gaps.into_iter().enumerate() {
            let asked = Cell::new(0);
            let gap_at = |s: f64| {
                asked.set(asked.get() + 1);
                greater(gap(s), 0.0)
            };
            let start = FreePlace { s: 0.0, gap: gap(0.0), closing: pace.speed };
            let (near, contact) = approach(gap_at, pace, start, 1.0).unwrap();
            assert!(near.s < 0.7 && 0.7 <= contact && near.gap == gap(near.s), "{i}: {} {contact}", near.s);
            assert!((contact - near.s) * pace.speed <= BRACKET && asked.get() <= 24, "{i}: {} questions", asked.get());
        }
    }
}
