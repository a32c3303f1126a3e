//! A first contact pinched between a free place and one in contact, and proven from its near side backward.

use smallvec::SmallVec;

use super::march::{BRACKET, step_clearance};
use super::{Collision, ProvenStep};
use crate::geometry::Footprint;
use crate::num::{greater, lesser, sqrt};
use crate::robots::Motion;

/// More steps than this are left to the march.
const MOST: usize = 24;

/// So many distances at most are asked on the way to a contact.
const TRIES: u32 = 40;

/// What a pinch needs to know of a motion: bounds over all its parts.
#[derive(Clone, Copy)]
pub(super) struct Pace {
    pub(super) speed: f64,
    pub(super) acceleration: f64,
}

/// A free place of a motion: where, how far from contact, and how fast it closes there, metres per unit of s.
#[derive(Clone, Copy)]
struct Near {
    s: f64,
    gap: f64,
    closing: f64,
}

/// A contact in a bracket of at most [`BRACKET`] of motion, and the steps, last first, that prove everything from where the search began
/// to the bracket.
pub(super) struct Pinched {
    pub(super) free_until: f64,
    pub(super) contact_at: f64,
    pub(super) steps: SmallVec<[ProvenStep; MOST]>,
}

/// Searches from a free place, where the footprint is `gap` metres from contact, to one that is in contact. `None` where that takes too long or
/// what lies between is not proven: another contact may come first. Then it is the march's business.
pub(super) fn pinch<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    pace: Pace,
    (lo, at_lo, gap): (f64, &Footprint, f64),
    contact: f64,
) -> Option<Pinched> {
    let gap_at = |s: f64| collision.distance(&motion.footprint_at(s));
    let (near, contact_at) = approach(gap_at, pace, Near { s: lo, gap, closing: pace.speed }, contact)?;
    let mut steps = SmallVec::new();
    let (mut hi, mut at_hi, mut gap) = (near.s, motion.footprint_at(near.s), near.gap);
    while hi > lo {
        if steps.len() == MOST {
            return None;
        }
        // as far back as the gap, which is least at the near side, exceeds one and a half times the sagitta
        let mut h = sqrt(gap / (1.5 * 0.125 * greater(pace.acceleration, 1e-9)));
        let (from, at_from, clearance) = loop {
            let from = if h < hi - lo { hi - h } else { lo };
            let at_from = if from == lo { at_lo.clone() } else { motion.footprint_at(from) };
            let clearance = step_clearance(collision, motion, (from, &at_from), (hi, &at_hi));
            if clearance > 0.0 {
                break (from, at_from, clearance);
            }
            h = 0.25 * lesser(h, hi - lo);
            if h * pace.speed < 0.1 * BRACKET {
                return None;
            }
        };
        steps.push(ProvenStep { from, to: hi, clearance });
        gap += 0.5 * near.closing * (hi - from);
        (hi, at_hi) = (from, at_from);
    }
    Some(Pinched { free_until: near.s, contact_at, steps })
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
