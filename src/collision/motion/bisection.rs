//! A first contact pinched between a free place and one in contact, and proven from its near side backward.

use smallvec::SmallVec;

use super::conservative_advancement::BRACKET;
use crate::geometry::Footprint;
use crate::num::{greater, lesser, sqrt};
use crate::robots::Motion;

/// More steps than this are left to the march.
const MOST: usize = 24;

/// Steps, each from where to where.
type Steps = SmallVec<[(f64, f64); MOST]>;

/// So many contacts are tried, each before the last: the first one tried need not be the first on the way.
const CONTACTS: u32 = 8;

/// So many distances at most are asked on the way to a contact.
const TRIES: u32 = 40;

/// What a pinch needs to know of a motion: bounds over the parts that may hit.
#[derive(Clone, Copy)]
pub(crate) struct Pace {
    pub(crate) speed: f64,
    pub(crate) acceleration: f64,
}

/// A free place of a motion: where, how far from contact, and how fast it closes there, metres per unit of s.
#[derive(Clone, Copy)]
struct Near {
    s: f64,
    gap: f64,
    closing: f64,
}

/// A contact in a bracket of at most [`BRACKET`] of motion, and from where to where the steps go, last first, that prove everything from
/// where the search began to the bracket.
pub(crate) struct Pinched {
    pub(crate) free_until: f64,
    pub(crate) contact_at: f64,
    pub(crate) steps: Steps,
}

/// Searches from a free place, where the footprint is `gap_lo` metres from contact, to one that is in contact. `None` where that takes too long or
/// what lies between is not proven: then it is the march's business.
///
/// `gap` tells how far a footprint is from contact, metres, 0 in contact; `clearance` what one step between two places proves.
pub(crate) fn pinch<M: Motion>(
    gap: impl Fn(&Footprint) -> f64,
    clearance: impl Fn((f64, &Footprint), (f64, &Footprint)) -> f64,
    motion: &M,
    pace: Pace,
    (lo, at_lo, gap_lo): (f64, &Footprint, f64),
    mut contact: f64,
) -> Option<Pinched> {
    let gap_at = |s: f64| gap(&motion.footprint_at(s));
    let from = Near { s: lo, gap: gap_lo, closing: pace.speed };
    for _ in 0..CONTACTS {
        let (near, contact_at) = approach(gap_at, pace, from, contact)?;
        match prove_back(&gap, &clearance, motion, pace, (lo, at_lo), near)? {
            Ok(steps) => return Some(Pinched { free_until: near.s, contact_at, steps }),
            Err(earlier) => contact = earlier,
        }
    }
    None
}

/// Proves everything from `lo` to a free place, backward from that in steps that grow with the clearance: the steps, last first, or a
/// contact on the way.
fn prove_back<M: Motion>(
    gap: impl Fn(&Footprint) -> f64,
    clearance: impl Fn((f64, &Footprint), (f64, &Footprint)) -> f64,
    motion: &M,
    pace: Pace,
    (lo, at_lo): (f64, &Footprint),
    near: Near,
) -> Option<Result<Steps, f64>> {
    let mut steps = Steps::new();
    let (mut hi, mut at_hi, mut room) = (near.s, motion.footprint_at(near.s), near.gap);
    while hi > lo {
        if steps.len() == MOST {
            return None;
        }
        // as far back as the room, which is least at the near side, exceeds one and a half times the sagitta
        let mut h = sqrt(room / (1.5 * 0.125 * greater(pace.acceleration, 1e-9)));
        let (from, at_from) = loop {
            let from = if h < hi - lo { hi - h } else { lo };
            let at_from = if from == lo { at_lo.clone() } else { motion.footprint_at(from) };
            if clearance((from, &at_from), (hi, &at_hi)) > 0.0 {
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

/// The free place nearest to the contact and the contact, not farther apart than [`BRACKET`].
fn approach(gap_at: impl Fn(f64) -> f64, pace: Pace, mut near: Near, mut contact: f64) -> Option<(Near, f64)> {
    // a little less than the bracket, so that its two ends fit in it
    let fine = 0.45 * BRACKET / pace.speed;
    for _ in 0..TRIES {
        if (contact - near.s) * pace.speed <= BRACKET {
            return Some((near, contact));
        }
        let ahead = near.gap / near.closing;
        // most of the way to where it would touch; from near by just before it, then just behind it
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
        near = Near { s, gap, closing: if closing > 1e-3 * pace.speed { closing } else { pace.speed } };
    }
    None
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn a_contact_is_approached_in_a_few_questions() {
        // a straight one, one that closes ever faster, one that it hardly closes in on; the first contact is at 0.7
        let gaps: [fn(f64) -> f64; 3] = [|s| 0.7 - s, |s| 0.49 - s * s, |s| 0.02 * (0.7 - s)];
        let pace = Pace { speed: 2.0, acceleration: 2.0 };
        for (i, gap) in gaps.into_iter().enumerate() {
            let asked = Cell::new(0);
            let gap_at = |s: f64| {
                asked.set(asked.get() + 1);
                greater(gap(s), 0.0)
            };
            let start = Near { s: 0.0, gap: gap(0.0), closing: pace.speed };
            let (near, contact) = approach(gap_at, pace, start, 1.0).unwrap();
            assert!(near.s < 0.7 && 0.7 <= contact && near.gap == gap(near.s), "{i}: {} {contact}", near.s);
            assert!((contact - near.s) * pace.speed <= BRACKET && asked.get() <= 24, "{i}: {} questions", asked.get());
        }
    }
}
