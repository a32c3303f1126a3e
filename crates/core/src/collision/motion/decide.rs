//! Deciding a motion: the one order in which proofs are tried, for edges, sweeps and the ticks of robots that contact
//! does not hold. The tick of a robot that is held keeps a margin; its order is in `keeps.rs`.
//!
//! The cheap proofs come first: a separation test, contact at either end, a closed form or one step of the march; then
//! the march. Each rung is sound by itself, so the order changes no verdict.

use super::closed_form::disc_line::DiscLine;
use super::closed_form::verdicts::{circular, linear, straight};
use super::lanes::rung;
use super::limits::judge_beginning;
use super::local_march::march_nearby;
use super::place::Ends;
use super::separation::{halve, is_separated, open_parts};
use crate::collision::{Certificate, Collision, EdgeVerdict, MarchOptions, Scene};
use crate::geometry::Segment;
use crate::robots::Motion;

/// The verdict on a motion in a scene: in closed form where one decides, otherwise by the march with at most `budget`
/// attempts to prove a step.
///
/// A closed form only predicts the first contact. The verdict itself is proven: the motion is free throughout, or up to
/// just before that contact, and in contact just after it. For parts in translation one step of the march proves it
/// free, for discs a clearance in closed form, less its rounding. If a certificate is asked for, steps that the
/// verifier accepts prove every free stretch. A motion that leaves its robot's own limits is judged up to there, and
/// hits the limit if that much is free.
pub(crate) fn verdict<M: Motion>(
    scene: &Scene,
    motion: &M,
    budget: u32,
    certificate: Option<&mut Certificate>,
) -> EdgeVerdict {
    if let Some(leaving) = motion.leaves_limits() {
        return judge_beginning(motion, leaving, certificate, |beginning, certificate| {
            verdict_within(scene, beginning, budget, certificate)
        });
    }
    verdict_within(scene, motion, budget, certificate)
}

/// As [`verdict`], for a motion within its robot's own limits.
fn verdict_within<M: Motion>(
    scene: &Scene,
    motion: &M,
    budget: u32,
    mut certificate: Option<&mut Certificate>,
) -> EdgeVerdict {
    if let Some((way, radius)) = motion.disc_line()
        && let Some(verdict) = linear(scene, way, radius, certificate.as_deref_mut())
    {
        return verdict;
    }
    if certificate.is_none()
        && let Some((arc, radius)) = motion.disc_arc()
    {
        let closed = circular(scene, motion, &arc, radius);
        return closed.unwrap_or_else(|| march_nearby(scene, motion, budget, None, motion.footprint_at(0.0)));
    }
    let start = motion.footprint_at(0.0);
    let turns = (0..start.parts().len()).any(|k| motion.rates(k).acceleration != 0.0);
    if !turns && let Some(verdict) = straight(scene, motion, &start, certificate.as_deref_mut()) {
        return verdict;
    }
    march_nearby(scene, motion, budget, certificate, start)
}

/// Largest number of halvings, enough for most motions; after that the [`verdict`] decides.
const HALVINGS: u32 = 48;

/// Whether a motion in a scene is proven free: true wherever the [`verdict`] says so. Faster, because it computes
/// neither the clearance nor the first contact.
pub(crate) fn is_free<M: Motion>(scene: &Scene, motion: &M) -> bool {
    let sure = motion.linkage().filter(|_| motion.leaves_limits().is_none());
    let sure = sure.and_then(|linkage| rung::decide(scene, &linkage));
    sure.unwrap_or_else(|| is_free_by_ladder(scene, motion))
}

/// As [`is_free`], without the rung of eight intervals at once.
pub(crate) fn is_free_by_ladder<M: Motion>(scene: &Scene, motion: &M) -> bool {
    let budget = MarchOptions::default().budget;
    if motion.leaves_limits().is_some() {
        return false;
    }
    if let Some(free) = motion.disc_line().and_then(|(way, radius)| is_line_free(scene, way, radius)) {
        return free;
    }
    if motion.disc_arc().is_some() {
        return verdict(scene, motion, budget, None).is_free();
    }
    let separate = |ends: Ends| {
        let open = open_parts(scene, motion, ends);
        (!open.is_empty()).then_some(open)
    };
    ladder(scene, motion, separate, |ends, open| {
        let decided = halve(scene, motion, ends, &open, HALVINGS);
        decided.unwrap_or_else(|| verdict(scene, motion, budget, None).is_free())
    })
}

/// As [`is_free`], for a disc of this radius whose centre runs along `way`; `None` where rounding could decide.
pub(crate) fn is_line_free(scene: &Scene, way: Segment, radius: f64) -> Option<bool> {
    DiscLine::new(way, radius, scene)?.is_free(scene)
}

/// Whether a motion is proven free by more than a margin, in any checker; `judge` decides what the separation test and
/// the two ends leave undecided.
pub(crate) fn is_free_or<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    margin: f64,
    judge: impl FnOnce() -> EdgeVerdict,
) -> bool {
    let separate = |ends: Ends| (!is_separated(collision, motion, margin, ends)).then_some(());
    ladder(collision, motion, separate, |_, ()| judge().is_free())
}

/// The ladder: true where `separate` leaves nothing undecided, false where an end is in contact, otherwise what `judge`
/// says of the rest.
fn ladder<M: Motion, T>(
    collision: &dyn Collision,
    motion: &M,
    separate: impl FnOnce(Ends) -> Option<T>,
    judge: impl FnOnce(Ends, T) -> bool,
) -> bool {
    let (start, end) = (motion.footprint_at(0.0), motion.footprint_at(1.0));
    let ends = Ends { start: &start, end: &end };
    match separate(ends) {
        None => true,
        Some(_) if collision.intersects(&start) || collision.intersects(&end) => false,
        Some(open) => judge(ends, open),
    }
}
