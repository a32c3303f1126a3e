//! The certified march: a motion proven free step by step, or bracketed where it hits.

use super::limits::judge_beginning;
use super::place::{At, ContactAhead, Course, MotionStart};
use super::step::step_clearance;
use crate::collision::{
    Certificate, Collision, EdgeVerdict, HitBy, MarchOptions, ObstacleId, ProvenStep, UnresolvedReason,
};
use crate::geometry::{Footprint, Part, largest_coordinate};
use crate::num::{greater, lesser, sqrt, ulp};
use crate::robots::Motion;

/// Largest width of a hit's bracket, metres of motion, where the footprint meets the obstacle head-on.
pub const BRACKET: f64 = 1e-6;

/// How far any part can move between `s0` and `s1`, metres.
pub(crate) fn width<M: Motion>(motion: &M, parts: usize, s0: f64, s1: f64) -> f64 {
    (0..parts).fold(0.0, |w, k| greater(motion.bound(k, s0, s1), w))
}

/// The length of the next step to try, in units of s: the longest after which the clearance, falling from `clearance`
/// at `closing` metres per unit of s, is still one and a half times the step's sagitta.
fn promising(clearance: f64, closing: f64, acceleration: f64) -> f64 {
    let a = 1.5 * 0.125 * acceleration;
    // the positive root of a h^2 + closing h = clearance, in the form that keeps its digits
    2.0 * clearance / (closing + sqrt(closing * closing + 4.0 * a * clearance))
}

/// Whether a motion keeps its clearance above `options.margin`, by proof.
///
/// The march goes from 0 to 1 in steps, each proven by [`Motion::sagitta`] and one `distance` query per part. It first
/// tries the whole motion, which proves a free translation or disc line at once. Then each step's length is guessed
/// from the clearance and how fast it falls, and halved where the proof fails. Guesses cost only time: what is proven
/// does not depend on them. Near a grazed obstacle the sagitta is of second order in the step, so sliding along a wall
/// stays cheap. Where the far end of a failed step is in contact, the hit is bracketed between the last proven point
/// and that contact; a bracket of at most [`BRACKET`] of motion ends the march. A motion that leaves its robot's own
/// limits is marched up to there, and hits the limit.
pub fn march<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    options: MarchOptions,
    certificate: Option<&mut Certificate>,
) -> EdgeVerdict {
    // below 0 m a motion in contact would be above its margin; NaN stays, which nothing exceeds
    let options = if options.margin < 0.0 { MarchOptions { margin: 0.0, ..options } } else { options };
    if let Some(leaving) = motion.leaves_limits() {
        return judge_beginning(motion, leaving, certificate, |beginning, certificate| {
            march_within(collision, beginning, options, certificate)
        });
    }
    march_within(collision, motion, options, certificate)
}

/// As [`march`], for a motion within its robot's own limits.
fn march_within<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    options: MarchOptions,
    certificate: Option<&mut Certificate>,
) -> EdgeVerdict {
    let start = motion.footprint_at(0.0);
    let clearance = if options.budget > 0 { clearance_of_all(collision, motion, &start) } else { 0.0 };
    if clearance > options.margin {
        if let Some(c) = certificate {
            c.clear(options.margin);
            c.push(ProvenStep { from: 0.0, to: 1.0, clearance });
        }
        return EdgeVerdict::Free { clearance };
    }
    let distance = collision.distance(&start);
    march_on(collision, motion, options, certificate, MotionStart { footprint: start, distance })
}

/// The clearance that a single step proves for the whole motion, metres; not positive where it proves nothing. Most
/// free motions are proven so.
pub(crate) fn clearance_of_all<M: Motion>(collision: &dyn Collision, motion: &M, start: &Footprint) -> f64 {
    step_clearance(collision, motion, At::new(0.0, start), At::new(1.0, &motion.footprint_at(1.0)))
}

/// As [`march`], for a motion that one step does not prove free.
pub(crate) fn march_on<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    options: MarchOptions,
    mut certificate: Option<&mut Certificate>,
    start: MotionStart,
) -> EdgeVerdict {
    if let Some(c) = certificate.as_deref_mut() {
        c.clear(options.margin);
    }
    let gap = start.distance - options.margin;
    if gap <= 0.0 {
        return hit(collision, motion, 0.0, 0.0);
    }
    let mut plain = Plain { collision, motion, margin: options.margin, clearance: f64::INFINITY, certificate };
    let end = motion.footprint_at(1.0);
    go(&mut plain, motion, Course { start: start.footprint, gap, end: &end }, options.budget)
}

pub(crate) trait MarchQueries {
    /// Whether one step proves the motion free between two places; records the step if so.
    fn proves(&mut self, from: At, to: At) -> bool;

    /// The least clearance of the steps proven so far, metres.
    fn clearance(&self) -> f64;

    /// The clearance of a footprint along the motion, less the margin, metres.
    fn gap(&self, footprint: &Footprint) -> f64;

    /// Whether the clearance of a footprint along the motion does not exceed the margin.
    fn touches(&self, footprint: &Footprint) -> bool {
        self.gap(footprint) <= 0.0
    }

    /// A shortcut to the hit, tried once as soon as a contact is known: brackets the first contact after a free place
    /// without marching up to it. `None` where the march has to go on.
    fn pinched(&mut self, _ahead: ContactAhead) -> Option<EdgeVerdict> {
        None
    }

    /// The checker that answers every query.
    fn collision(&self) -> &dyn Collision;
}

/// The queries of a march, all answered by a checker, for all parts and all obstacles.
struct Plain<'a, M> {
    collision: &'a dyn Collision,
    motion: &'a M,
    margin: f64,
    clearance: f64,
    certificate: Option<&'a mut Certificate>,
}

impl<M: Motion> MarchQueries for Plain<'_, M> {
    fn proves(&mut self, from: At, to: At) -> bool {
        let clearance = step_clearance(self.collision, self.motion, from, to);
        if clearance > self.margin {
            self.clearance = lesser(clearance, self.clearance);
            if let Some(c) = self.certificate.as_deref_mut() {
                c.push(ProvenStep { from: from.s, to: to.s, clearance });
            }
        }
        clearance > self.margin
    }

    fn clearance(&self) -> f64 {
        self.clearance
    }

    fn gap(&self, footprint: &Footprint) -> f64 {
        self.collision.distance(footprint) - self.margin
    }

    fn collision(&self) -> &dyn Collision {
        self.collision
    }
}

/// The verdict that a motion hits, with the part and the obstacle in contact.
pub(crate) fn hit(collision: &dyn Collision, motion: &impl Motion, free_until: f64, contact_at: f64) -> EdgeVerdict {
    let witness = collision.witness(&motion.footprint_at(contact_at));
    let (part, obstacle) = witness.map_or((0, ObstacleId::UNKNOWN), |w| (w.part, w.obstacle));
    EdgeVerdict::Hit { free_until, contact_at, part, by: HitBy::Obstacle(obstacle) }
}

/// Marches from a free start. One step is known not to prove the whole motion.
pub(crate) fn go<M: Motion>(
    ground: &mut impl MarchQueries,
    motion: &M,
    course: Course,
    mut budget: u32,
) -> EdgeVerdict {
    let Course { start, gap, end } = course;
    let parts = start.parts().len();
    let width = |lo: f64, hi: f64| width(motion, parts, lo, hi);
    let unresolved = |free_until: f64, contact: Option<f64>, reason| {
        let gap = width(free_until, contact.unwrap_or(1.0));
        EdgeVerdict::Unresolved { free_until, gap, reason }
    };
    // the first place known to be in contact; nothing beyond it matters
    let mut contact = ground.touches(end).then_some(1.0);
    let size = largest_coordinate(start.parts().iter().chain(end.parts()).map(Part::placed));
    let finest = 64.0 * ulp(size);
    let speed = width(0.0, 1.0);
    let acceleration = (0..parts).fold(0.0, |a, k| greater(8.0 * motion.sagitta(k, 0.0, 1.0), a));
    // a little less than the bracket, so that its two ends fit in it
    let fine = 0.45 * BRACKET / speed;
    let (mut lo, mut gap, mut at_lo) = (0.0, gap, start);
    let mut may_pinch = true;
    // the fraction of the guessed step that is tried: guesses that fail again and again are too long for this motion
    let mut trust = 1.0;
    let mut h = if contact.is_some() { promising(gap, speed, acceleration) } else { 1.0 };
    loop {
        if budget == 0 {
            return unresolved(lo, contact, UnresolvedReason::Budget);
        }
        budget -= 1;
        if let Some(contact) = contact
            && std::mem::take(&mut may_pinch)
            && let Some(verdict) = ground.pinched(ContactAhead { from: At::new(lo, &at_lo), gap, contact })
        {
            return verdict;
        }
        let hi = match contact {
            Some(c) if lo + h >= c => lo + 0.5 * (c - lo),
            _ => lesser(lo + h, 1.0),
        };
        let at_hi = if hi == 1.0 { end.clone() } else { motion.footprint_at(hi) };
        // the whole motion is known not to be proven by one step
        if (lo, hi) != (0.0, 1.0) && ground.proves(At::new(lo, &at_lo), At::new(hi, &at_hi)) {
            if hi == 1.0 {
                return EdgeVerdict::Free { clearance: ground.clearance() };
            }
            let gap_hi = ground.gap(&at_hi);
            let closing = greater((gap - gap_hi) / (hi - lo), 0.0);
            (lo, at_lo, gap) = (hi, at_hi, gap_hi);
            if let Some(c) = contact
                && width(lo, c) <= BRACKET
            {
                return hit(ground.collision(), motion, lo, c);
            }
            // never too short to go forward
            h = greater(trust * promising(gap, closing, acceleration), 16.0 * f64::EPSILON);
            trust = lesser(1.5 * trust, 1.0);
            if h < fine {
                // about to touch: a contact just ahead ends the march, otherwise it creeps on
                let ahead = lesser(lo + 2.0 * fine, 1.0);
                if ground.touches(&motion.footprint_at(ahead)) {
                    return hit(ground.collision(), motion, lo, ahead);
                }
            }
            continue;
        }
        // for the motion's end it is known already
        if hi < contact.unwrap_or(1.0) && ground.touches(&at_hi) {
            contact = Some(hi);
            if width(lo, hi) <= BRACKET {
                return hit(ground.collision(), motion, lo, hi);
            }
        }
        let middle = lo + 0.5 * (hi - lo);
        if width(lo, hi) <= finest || middle <= lo || middle >= hi {
            // Rounding allows nothing finer here. A contact known farther on still makes it a hit, in a wider bracket.
            return match contact {
                Some(c) => hit(ground.collision(), motion, lo, c),
                None => unresolved(lo, None, UnresolvedReason::Tolerance),
            };
        }
        h = 0.5 * (hi - lo);
        trust *= 0.5;
    }
}

#[cfg(test)]
mod tests;
