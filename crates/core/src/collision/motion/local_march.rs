//! The march of a motion in a scene, among the pieces that it can come near.

use smallvec::SmallVec;

use super::bisection::{SpeedBounds, pinch};
use super::conservative_advancement::{MarchQueries, go, hit, march_on, width};
use super::local_scene::Vicinity;
use super::place::{At, ContactAhead, Course, MotionStart};
use super::step::{least_proven, rounding};
use crate::collision::{Certificate, Collision, EdgeVerdict, MarchOptions, ProvenStep, Scene};
use crate::geometry::{Aabb, Footprint, largest_coordinate};
use crate::num::{greater, lesser};
use crate::robots::Motion;

/// What one step says of a whole motion.
enum Whole {
    /// It proves the motion free.
    Free,
    /// The motion begins in contact.
    HitAtStart,
    Open,
}

struct Nearby<'a, M> {
    scene: &'a Scene,
    motion: &'a M,
    around: Vicinity<'a>,
    /// The number of the footprint's parts.
    parts: usize,
    /// The parts that can come near anything.
    open: SmallVec<[usize; 4]>,
    /// The clearance that every step proves for the other parts, metres.
    kept: f64,
    /// The least clearance of the steps proven so far, metres.
    clearance: f64,
    certificate: Option<&'a mut Certificate>,
}

/// The verdict on a motion in a scene. A motion that [`march`](super::conservative_advancement::march) proves free is
/// proven in the same steps; a hit may get another bracket of its contact.
///
/// Most free motions are proven in one step. Where that step fails, it still settles some parts for good: a part whose
/// hull keeps more than two sagittas from everything is free in every step, because a step's ends are within one
/// sagitta of that hull and its own sagitta is no longer. The other parts are marched among the pieces that they can
/// come near, which are collected from the scene once. A step is given up at the first piece that is too near. A
/// contact, once it is known, is not marched at but [bracketed by bisection](pinch).
pub(crate) fn march_nearby<M: Motion>(
    scene: &Scene,
    motion: &M,
    budget: u32,
    certificate: Option<&mut Certificate>,
    start: Footprint,
) -> EdgeVerdict {
    let end = motion.footprint_at(1.0);
    if budget == 0 || !(start.is_valid() && end.is_valid()) {
        let (distance, options) = (scene.distance(&start), MarchOptions { margin: 0.0, budget });
        return march_on(scene, motion, options, certificate, MotionStart { footprint: start, distance });
    }
    let parts = start.parts().len();
    let mut march = Nearby::new(scene, motion, parts, certificate);
    if let Some(c) = march.certificate.as_deref_mut() {
        c.clear(0.0);
    }
    match march.whole(&start, &end) {
        Whole::Free => return EdgeVerdict::Free { clearance: march.clearance },
        Whole::HitAtStart => return hit(scene, motion, 0.0, 0.0),
        Whole::Open => {}
    }
    let gap = march.gap(&start);
    if gap <= 0.0 {
        return hit(scene, motion, 0.0, 0.0);
    }
    go(&mut march, motion, Course { start, gap, end: &end }, budget)
}

impl<'a, M: Motion> Nearby<'a, M> {
    /// A march of a motion of as many parts, all of them open.
    fn new(scene: &'a Scene, motion: &'a M, parts: usize, certificate: Option<&'a mut Certificate>) -> Self {
        Nearby {
            scene,
            motion,
            around: Vicinity::all(scene),
            parts,
            open: (0..parts).collect(),
            kept: f64::INFINITY,
            clearance: f64::INFINITY,
            certificate,
        }
    }

    /// Tries to prove the whole motion in one step. If that fails, finds the open parts and the pieces they can come
    /// near.
    fn whole(&mut self, start: &Footprint, end: &Footprint) -> Whole {
        let (from, to) = (At::new(0.0, start), At::new(1.0, end));
        let all = std::mem::take(&mut self.open);
        let mut least = f64::INFINITY;
        let mut swept: Option<Aabb> = None;
        for k in all {
            let (sagitta, distance, rounding) = self.clears_first(k, [from, to], least);
            if distance <= sagitta && self.around.touches(start.parts()[k].placed()) {
                return Whole::HitAtStart;
            }
            least = least_proven(distance - sagitta - rounding, least);
            let kept = distance - 2.0 * sagitta - 4.0 * rounding;
            if kept > 0.0 {
                self.kept = lesser(kept, self.kept);
                continue;
            }
            self.open.push(k);
            let [a, b] = [start, end].map(|footprint| footprint.parts()[k].placed().padded_bounds());
            let way = a.merged(&b).grown(sagitta);
            swept = Some(swept.map_or(way, |swept| swept.merged(&way)));
        }
        if least > 0.0 {
            self.clearance = least;
            self.note(from, to, least);
            return Whole::Free;
        }
        if let Some(swept) = swept {
            // no clearance above that at the start is ever reported; beyond it distances only serve to plan steps
            let range = self.open_gap(start, f64::INFINITY) + 0.25 * self.width(0.0, 1.0);
            self.around = Vicinity::new(self.scene, &swept, range);
        }
        Whole::Open
    }

    /// As [`clears`](Self::clears), for the first step among all pieces. Where the parts before prove `least`, a
    /// distance is only a lower bound if it proves more than that and that the part is settled.
    fn clears_first(&self, part: usize, step: [At; 2], least: f64) -> (f64, f64, f64) {
        if least > 0.0 && least < f64::INFINITY {
            let below = greater(2.0 * self.motion.sagitta(part, 0.0, 1.0), least);
            let (sagitta, distance, rounding) = self.clears(&self.around, part, step, below);
            if distance < below + sagitta || distance - 2.0 * sagitta - 4.0 * rounding > 0.0 {
                return (sagitta, distance, rounding);
            }
        }
        self.clears(&self.around, part, step, f64::INFINITY)
    }

    /// The sagitta of a part in a step, the distance of its hull among these pieces and that distance's rounding,
    /// metres. A distance of no more than the sagitta is only an upper bound: the step fails in any case. A distance
    /// that proves more than `below` is only a lower bound.
    fn clears(&self, among: &Vicinity, part: usize, [from, to]: [At; 2], below: f64) -> (f64, f64, f64) {
        let hull = from.footprint.parts()[part].placed().hull_with(to.footprint.parts()[part].placed());
        let (size, sagitta) = (largest_coordinate([&hull]), self.motion.sagitta(part, from.s, to.s));
        let reach = below + sagitta;
        let within = reach + 2.0 * rounding(size, reach);
        let distance = among.distance(&hull, sagitta, within).unwrap_or(within);
        (sagitta, distance, rounding(size, distance))
    }

    /// The least of `below` and of what a step proves for these parts, metres; not positive when it proves nothing.
    fn proven(&self, among: &Vicinity, parts: impl Iterator<Item = usize>, step: [At; 2], below: f64) -> f64 {
        let mut least = below;
        for k in parts {
            let (sagitta, distance, rounding) = self.clears(among, k, step, least);
            least = least_proven(distance - sagitta - rounding, least);
            if least <= 0.0 {
                break;
            }
        }
        least
    }

    /// The clearance that a step proves for the open parts, metres; not positive when it proves nothing. Only a lower
    /// bound where it is more than is asked for: the step's own clearance for a certificate, else the least of all.
    fn open_clearance(&self, from: At, to: At) -> f64 {
        let below = if self.certificate.is_some() { f64::INFINITY } else { self.clearance };
        self.proven(&self.around, self.open.iter().copied(), [from, to], below)
    }

    /// Whether a step is proven for the open parts: where its clearance is positive. A separation test proves most
    /// steps without a distance; what it proves, the distance proves too.
    fn is_open_proven(&self, from: At, to: At) -> bool {
        self.is_open_separated(from, to) || self.open_clearance(from, to) > 0.0
    }

    /// A conservative separation test of the open parts in a step. `false` is inconclusive.
    fn is_open_separated(&self, from: At, to: At) -> bool {
        self.open.iter().all(|&k| {
            let ends = [from, to].map(|at| at.footprint.parts()[k].placed());
            self.around.clears(ends, self.motion.sagitta(k, from.s, to.s))
        })
    }

    /// The clearance that a step proves for all parts, metres, where it proves `open` for the open ones. The others are
    /// measured only where they may come nearer.
    fn clearance_of_all(&self, from: At, to: At, open: f64) -> f64 {
        if self.kept >= open {
            return open;
        }
        self.proven(&Vicinity::all(self.scene), self.settled(), [from, to], open)
    }

    /// Puts a proven step into the certificate, where one is asked for.
    fn note(&mut self, from: At, to: At, clearance: f64) {
        if let Some(c) = self.certificate.as_deref_mut() {
            c.push(ProvenStep { from: from.s, to: to.s, clearance });
        }
    }

    /// The parts that come near nothing.
    fn settled(&self) -> impl Iterator<Item = usize> {
        (0..self.parts).filter(|part| !self.open.contains(part))
    }

    /// The distance of a footprint's open parts, metres, or `within` if it is not less than that.
    fn open_gap(&self, footprint: &Footprint, within: f64) -> f64 {
        if !footprint.is_valid() {
            return 0.0;
        }
        nearest_of(&self.around, footprint, self.open.iter().copied(), within)
    }

    /// How far any part can move between two parameters, metres.
    fn width(&self, lo: f64, hi: f64) -> f64 {
        width(self.motion, self.parts, lo, hi)
    }
}

/// The distance of these parts of a valid footprint, metres, or `within` if it is not less than that.
fn nearest_of(among: &Vicinity, footprint: &Footprint, parts: impl Iterator<Item = usize>, within: f64) -> f64 {
    let parts = parts.map(|k| footprint.parts()[k].placed());
    parts.fold(within, |least, part| among.distance(part, 0.0, least).unwrap_or(least))
}

impl<M: Motion> MarchQueries for Nearby<'_, M> {
    fn proves(&mut self, from: At, to: At) -> bool {
        let open = self.open_clearance(from, to);
        if open <= 0.0 {
            return false;
        }
        let clearance = self.clearance_of_all(from, to, open);
        self.clearance = lesser(clearance, self.clearance);
        self.note(from, to, clearance);
        true
    }

    fn clearance(&self) -> f64 {
        self.clearance
    }

    fn gap(&self, footprint: &Footprint) -> f64 {
        let gap = self.open_gap(footprint, f64::INFINITY);
        // the settled parts keep at least `kept` everywhere
        if self.kept >= gap {
            return gap;
        }
        nearest_of(&Vicinity::all(self.scene), footprint, self.settled(), gap)
    }

    fn touches(&self, footprint: &Footprint) -> bool {
        !footprint.is_valid() || self.open.iter().any(|&k| self.around.touches(footprint.parts()[k].placed()))
    }

    fn pinched(&mut self, ahead: ContactAhead) -> Option<EdgeVerdict> {
        let acceleration = self.open.iter().fold(0.0, |most, &k| greater(self.motion.rates(k).acceleration, most));
        let pace = SpeedBounds { speed: self.width(0.0, 1.0), acceleration };
        let range = self.around.range();
        let gap_at = |footprint: &Footprint| self.open_gap(footprint, range);
        let is_proven = |from: At, to: At| self.is_open_proven(from, to);
        let found = pinch(gap_at, is_proven, self.motion, pace, ahead)?;
        if self.certificate.is_some() {
            for &(lo, hi) in found.steps.iter().rev() {
                let [at_lo, at_hi] = [lo, hi].map(|s| self.motion.footprint_at(s));
                let (from, to) = (At::new(lo, &at_lo), At::new(hi, &at_hi));
                self.note(from, to, self.clearance_of_all(from, to, self.open_clearance(from, to)));
            }
        }
        Some(hit(self.scene, self.motion, found.free_until, found.contact_at))
    }

    fn collision(&self) -> &dyn Collision {
        self.scene
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::collision::motion::conservative_advancement::march;
    use crate::configuration::{HitchCfg, Tn};
    use crate::geometry::{Point2, Pose2};
    use crate::random::{Seed, Stream};
    use crate::robots::{HITCH, Reach, Robot};

    /// Compares random edges with the march among all pieces: the same steps where they are free, a bracket about the
    /// same contact where they are not.
    fn compare<R: Robot>(scene: &Scene, robot: &R, mut draw: impl FnMut(&mut Stream) -> [R::Configuration; 2]) {
        let mut draws = Stream::new(Seed(9), "nearby");
        let (mut ours, mut theirs) = (Certificate::new(), Certificate::new());
        let (mut free, mut hits) = (0, 0);
        let budget = MarchOptions::default().budget;
        while free <= 40 || hits <= 40 {
            let [a, b] = draw(&mut draws);
            if scene.intersects(&robot.footprint(&a)) {
                continue;
            }
            let edge = robot.edge(&a, &b).unwrap();
            let quick = march_nearby(scene, &edge, budget, Some(&mut ours), edge.footprint_at(0.0));
            let slow = march(scene, &edge, MarchOptions::default(), Some(&mut theirs));
            assert_eq!(march_nearby(scene, &edge, budget, None, edge.footprint_at(0.0)), quick, "{a} to {b}");
            match (quick, slow) {
                (
                    EdgeVerdict::Hit { free_until, contact_at, .. },
                    EdgeVerdict::Hit { free_until: f, contact_at: c, .. },
                ) => {
                    hits += 1;
                    assert!(free_until <= c && f <= contact_at, "{quick:?} {slow:?}");
                }
                _ => {
                    free += usize::from(quick.is_free() && ours.steps().len() > 1);
                    assert_eq!((quick, &ours), (slow, &theirs), "{a} to {b}");
                }
            }
        }
    }

    #[test]
    fn a_free_edge_takes_the_same_steps_as_by_the_march() {
        let bench = Scene::workbench();
        let angles = |s: &mut Stream| Tn([s.uniform(-PI, PI), s.uniform(-PI, PI), s.uniform(-PI, PI)]);
        compare(&bench, &Reach::<3>::redundant(), |s| {
            let (a, by) = (angles(s), angles(s));
            [a, Tn([0, 1, 2].map(|i| a.0[i] + 0.4 * by.0[i])).wrapped()]
        });
        let lot = Scene::lot();
        let bounds = lot.bounds();
        compare(&lot, &HITCH.with_trailer(), |s| {
            let at = Point2::new(s.uniform(bounds.min.x, bounds.max.x), s.uniform(bounds.min.y, bounds.max.y));
            let body = Pose2::new(at.x, at.y, s.uniform(-PI, PI));
            let psi = body.theta + s.uniform(-0.5, 0.5);
            let moved =
                Pose2::new(at.x + s.uniform(-1.0, 1.0), at.y + s.uniform(-1.0, 1.0), body.theta + s.uniform(-0.5, 0.5));
            [(body, psi), (moved, psi + s.uniform(-0.5, 0.5))].map(|(body, psi)| HitchCfg { body, trailer: Some(psi) })
        });
    }

    /// Draws steps of edges, and says for how many both ways prove the step, and for how many neither does.
    fn compare_proofs<R: Robot>(
        scene: &Scene,
        robot: &R,
        mut draw: impl FnMut(&mut Stream) -> [R::Configuration; 2],
    ) -> [u32; 3] {
        let mut draws = Stream::new(Seed(12), "steps");
        let [mut proven, mut separated, mut unproven] = [0; 3];
        for _ in 0..400 {
            let [a, b] = draw(&mut draws);
            let edge = robot.edge(&a, &b).unwrap();
            let (start, end) = (edge.footprint_at(0.0), edge.footprint_at(1.0));
            let mut march = Nearby::new(scene, &edge, start.parts().len(), None);
            if !matches!(march.whole(&start, &end), Whole::Open) {
                continue;
            }
            for _ in 0..20 {
                let (s, width) = (draws.uniform(0.0, 1.0), [0.3, 0.1, 0.02, 1e-4][draws.below(4) as usize]);
                let (s0, s1) = (s * (1.0 - width), s * (1.0 - width) + width);
                let [from, to] = [s0, s1].map(|s| edge.footprint_at(s));
                let (from, to) = (At::new(s0, &from), At::new(s1, &to));
                let by_distance = march.open_clearance(from, to) > 0.0;
                assert_eq!(march.is_open_proven(from, to), by_distance, "{a} to {b}, {s0} to {s1}");
                separated += u32::from(march.is_open_separated(from, to));
                proven += u32::from(by_distance);
                unproven += u32::from(!by_distance);
            }
        }
        [proven, separated, unproven]
    }

    #[test]
    fn a_step_is_proven_exactly_where_its_clearance_is_positive() {
        let (bench, lot) = (Scene::workbench(), Scene::lot());
        let arm = compare_proofs(&bench, &Reach::<2>::workbench(), |s| {
            let mut angles = || Tn([s.uniform(-PI, PI), s.uniform(-PI, PI)]);
            [angles(), angles()]
        });
        let bounds = lot.bounds();
        let car = compare_proofs(&lot, &HITCH, |s| {
            let (x, y) = (s.uniform(bounds.min.x, bounds.max.x), s.uniform(bounds.min.y, bounds.max.y));
            let at = Pose2::new(x, y, s.uniform(-PI, PI));
            let to = Pose2::new(x + s.uniform(-2.0, 2.0), y + s.uniform(-2.0, 2.0), at.theta + s.uniform(-0.5, 0.5));
            [at, to].map(|body| HitchCfg { body, trailer: None })
        });
        for [proven, separated, unproven] in [arm, car] {
            let counts = format!("{proven} proven, {separated} of them separated, {unproven} not");
            assert!(proven > 300 && unproven > 300 && 10 * separated > 8 * proven, "{counts}");
        }
    }
}
