//! The certified march: a motion proven free step by step, or bracketed where it hits.

use super::limits::judge_beginning;
use super::place::{ContactAhead, Course, Place, Start};
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
    march_on(collision, motion, options, certificate, Start { footprint: start, distance })
}

/// The clearance that a single step proves for the whole motion, metres; not positive where it proves nothing. Most
/// free motions are proven so.
pub(crate) fn clearance_of_all<M: Motion>(collision: &dyn Collision, motion: &M, start: &Footprint) -> f64 {
    step_clearance(collision, motion, Place::new(0.0, start), Place::new(1.0, &motion.footprint_at(1.0)))
}

/// As [`march`], for a motion that one step does not prove free.
pub(crate) fn march_on<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    options: MarchOptions,
    mut certificate: Option<&mut Certificate>,
    start: Start,
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

/// The queries of a march.
pub(crate) trait Ground {
    /// Whether one step proves the motion free between two places; records the step if so.
    fn proves(&mut self, from: Place, to: Place) -> bool;

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

impl<M: Motion> Ground for Plain<'_, M> {
    fn proves(&mut self, from: Place, to: Place) -> bool {
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
pub(crate) fn go<M: Motion>(ground: &mut impl Ground, motion: &M, course: Course, mut budget: u32) -> EdgeVerdict {
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
            && let Some(verdict) = ground.pinched(ContactAhead { from: Place::new(lo, &at_lo), gap, contact })
        {
            return verdict;
        }
        let hi = match contact {
            Some(c) if lo + h >= c => lo + 0.5 * (c - lo),
            _ => lesser(lo + h, 1.0),
        };
        let at_hi = if hi == 1.0 { end.clone() } else { motion.footprint_at(hi) };
        // the whole motion is known not to be proven by one step
        if (lo, hi) != (0.0, 1.0) && ground.proves(Place::new(lo, &at_lo), Place::new(hi, &at_hi)) {
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
mod tests {
    use super::*;
    use crate::collision::{CarChecker, CertificateError, ChainChecker, DiscChecker, Scene, verify_certificate};
    use crate::configuration::{HitchCfg, R2, T2};
    use crate::geometry::{Point2, Segment};
    use crate::robots::{HITCH, Reach, Robot, RustyDisc};

    fn wall(a: (f64, f64), b: (f64, f64)) -> Scene {
        Scene::of_walls(&[Segment::new(Point2::new(a.0, a.1), Point2::new(b.0, b.1))])
    }

    fn disc(scene: Scene, radius: f64) -> DiscChecker {
        DiscChecker::new(scene, RustyDisc { radius })
    }

    #[test]
    fn a_disc_line_is_proven_in_one_step_with_its_exact_clearance() {
        let c = disc(wall((0.0, 1.0), (5.0, 1.0)), 0.25);
        let mut certificate = Certificate::new();
        let verdict = c.edge_certified(&R2::new(0.0, 0.0), &R2::new(5.0, 0.5), &mut certificate).unwrap();
        let EdgeVerdict::Free { clearance } = verdict else { panic!("{verdict:?}") };
        assert!((clearance - 0.25).abs() < 1e-13 && clearance <= 0.25, "{clearance}");
        assert_eq!(certificate.steps().len(), 1);
    }

    #[test]
    fn a_hit_is_bracketed_to_a_micrometre_at_the_true_place() {
        let c = disc(wall((3.0, -1.0), (3.0, 1.0)), 0.25);
        let verdict = c.edge(&R2::new(0.0, 0.0), &R2::new(8.0, 0.0)).unwrap();
        let EdgeVerdict::Hit { free_until, contact_at, part: 0, by: HitBy::Obstacle(ObstacleId(0)) } = verdict else {
            panic!("{verdict:?}")
        };
        // the disc's edge meets the wall when its centre is at x = 2.75
        assert!(free_until * 8.0 < 2.75 && 2.75 <= contact_at * 8.0, "{verdict:?}");
        assert!((contact_at - free_until) * 8.0 <= BRACKET);
    }

    #[test]
    fn a_thin_wall_is_not_jumped_however_long_the_edge() {
        let c = disc(wall((500.0, -1e-3), (500.0, 1e-3)), 0.001);
        assert!(matches!(c.edge(&R2::new(0.0, 0.0), &R2::new(1000.0, 0.0)).unwrap(), EdgeVerdict::Hit { .. }));
    }

    #[test]
    fn a_pure_trailer_rotation_is_seen() {
        // the chapter's bound for the car is 0 here: translation and body turn are nothing, only psi moves
        let towing = HITCH.with_trailer();
        let c = CarChecker::new(wall((-2.0, 2.0), (-2.0, 2.5)), towing);
        let body = crate::geometry::Pose2::IDENTITY;
        let at = |psi: f64| HitchCfg { body, trailer: Some(psi) };
        assert!(c.is_free(&at(0.0)) && c.is_free(&at(-2.0)), "both ends are free");
        assert!(matches!(c.edge(&at(0.0), &at(-2.0)).unwrap(), EdgeVerdict::Hit { part: 1, .. }));
    }

    #[test]
    fn sliding_a_nanometre_from_a_wall_stays_cheap() {
        let c = disc(wall((-9.0, 1.0), (9.0, 1.0)), 0.25);
        let y = 0.75 - 1e-9;
        let mut certificate = Certificate::new();
        let verdict = c.edge_certified(&R2::new(-5.0, y), &R2::new(5.0, y), &mut certificate).unwrap();
        assert!(verdict.is_free() && certificate.steps().len() == 1, "{verdict:?}");
        // an arm's tip grazing the wall from below at the top of its swing: the whole arm turns at a clearance of 1e-6
        let arm = Reach { base: Point2::origin(), lengths: [0.5, 0.5 - 1e-6], link_radius: 0.0 };
        let c = ChainChecker::new(wall((-9.0, 1.0), (9.0, 1.0)), arm);
        let verdict = c.edge_certified(&T2::new(0.3, 0.0), &T2::new(2.8, 0.0), &mut certificate).unwrap();
        assert!(verdict.is_free(), "{verdict:?}");
        assert!(certificate.steps().len() < 200, "second order: {} steps", certificate.steps().len());
    }

    #[test]
    fn the_budget_ends_a_march_honestly() {
        let arm = Reach { base: Point2::origin(), lengths: [0.5, 0.5 - 1e-6], link_radius: 0.0 };
        let c = ChainChecker::new(wall((-9.0, 1.0), (9.0, 1.0)), arm);
        let edge = arm.edge(&T2::new(0.3, 0.0), &T2::new(2.8, 0.0)).unwrap();
        let verdict = march(c.scene(), &edge, MarchOptions { margin: 0.0, budget: 7 }, None);
        let EdgeVerdict::Unresolved { free_until, gap, reason: UnresolvedReason::Budget } = verdict else {
            panic!("{verdict:?}")
        };
        assert!(free_until > 0.0 && free_until < 0.5 && gap > 0.0);
    }

    #[test]
    fn a_hit_at_a_slant_of_half_a_degree_is_found_within_the_budget() {
        let towing = HITCH.with_trailer();
        let c = CarChecker::new(Scene::lot(), towing);
        let at = |x: f64, y: f64, theta: f64, psi: f64| HitchCfg {
            body: crate::geometry::Pose2::new(x, y, theta),
            trailer: Some(psi),
        };
        let slanting = [
            (
                at(6.580537835706359, 5.000116440187204, -1.6981397455848564, 0.9941558724129376),
                at(6.506459608064548, 5.194483995305569, -1.391834082737191, 0.9968055580521787),
            ),
            (
                at(11.223791443309134, 4.3444481992722945, -0.5457796460445494, -2.9727288213857066),
                at(11.367714664055748, 4.601794940650447, -0.34499188382565926, -2.8521097355088636),
            ),
        ];
        for (a, b) in slanting {
            let verdict = c.edge(&a, &b).unwrap();
            assert!(matches!(verdict, EdgeVerdict::Hit { .. }), "{a}: {verdict:?}");
        }
    }

    #[test]
    fn a_margin_counts_as_contact() {
        let c = disc(wall((-9.0, 1.0), (9.0, 1.0)), 0.25);
        let edge = c.robot().edge(&R2::new(-5.0, 0.5), &R2::new(5.0, 0.5)).unwrap();
        let verdict = |margin: f64| march(c.scene(), &edge, MarchOptions { margin, budget: 4096 }, None);
        assert!(verdict(0.249).is_free());
        assert!(matches!(verdict(0.251), EdgeVerdict::Hit { free_until: 0.0, contact_at: 0.0, .. }));
    }

    #[test]
    fn a_forged_certificate_is_refused() {
        let c = disc(wall((3.0, -1.0), (3.0, 1.0)), 0.25);
        let edge = c.robot().edge(&R2::new(0.0, 0.0), &R2::new(8.0, 0.0)).unwrap();
        let step = |from: f64, to: f64, clearance: f64| ProvenStep { from, to, clearance };
        let verify = |steps| verify_certificate(c.scene(), &edge, &Certificate::from_steps(0.0, steps));
        assert_eq!(verify(vec![step(0.0, 0.25, 0.7)]), Ok(0.25));
        assert!(matches!(verify(vec![step(0.0, 0.25, 0.8)]), Err(CertificateError::Unproven { step: 0, .. })));
        assert!(
            matches!(verify(vec![step(0.0, 1.0, 0.0)]), Err(CertificateError::Unproven { .. })),
            "through the wall"
        );
        assert_eq!(verify(vec![step(0.0, 0.1, 0.1), step(0.2, 0.25, 0.1)]), Err(CertificateError::Broken(1)));
        assert_eq!(verify(vec![step(0.0, 0.0, 0.1)]), Err(CertificateError::Backward(0)));
    }

    #[test]
    fn an_edge_of_one_configuration_is_its_freedom() {
        let c = disc(wall((3.0, -1.0), (3.0, 1.0)), 0.25);
        for (x, free) in [(0.0, true), (2.75, false), (2.75 - 1e-9, true)] {
            let q = R2::new(x, 0.0);
            assert_eq!((c.is_free(&q), c.edge_free(&q, &q)), (free, free), "at {x}");
        }
    }
}
