//! `verify_certificate`, which checks certificates. It knows the contracts of [`Motion`] and [`Collision`] and nothing
//! of how a certificate is made: its hull and its rounding are its own. It trusts
//! [`Collision::distance_of_hull_within`], [`Motion::sagitta`] and the exact orientation predicate, which the march
//! uses too.

use crate::collision::{Certificate, CertificateError, Collision, ProvenStep};
use crate::geometry::{Footprint, Placed, Point2, Vertices, orientation};
use crate::num::{greater, lesser, ulp};
use crate::robots::Motion;
use crate::short_list::ShortList;

/// The rounding allowed for, ulps of the largest coordinate: 16 for a distance and 16 for the vertices of a placed
/// shape.
const ROUNDING: f64 = 32.0;

/// Accepts a certificate when its steps join from 0 on and each is proven by the distance from the hull of its two end
/// footprints and the motion's sagitta bound. Returns where the proof ends.
///
/// Within a step no point of a part strays farther than the sagitta from the chord between its places at the two ends,
/// which lies in the convex hull of the part's two placed shapes. So the hull's distance, less the sagitta, is a lower
/// bound of the clearance; 32 ulps of the largest coordinate are subtracted for rounding.
///
/// No step may go beyond where the motion leaves its robot's own limits.
///
/// # Errors
/// [`CertificateError`] names the first step that fails, or a margin that proves nothing: below 0 a step may be above
/// it and hit.
pub fn verify_certificate<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    certificate: &Certificate,
) -> Result<f64, CertificateError> {
    let margin = certificate.margin();
    if !(margin.is_finite() && margin >= 0.0) {
        return Err(CertificateError::Margin(margin));
    }
    let limit = motion.leaves_limits().map_or(1.0, |leaving| leaving.within_until);
    let (mut at, mut end) = (0.0, None);
    for (i, step) in certificate.steps().iter().enumerate() {
        if step.from != at {
            return Err(CertificateError::Broken(i));
        }
        if !(step.to > step.from && step.to <= 1.0) {
            return Err(CertificateError::Backward(i));
        }
        if step.to > limit {
            return Err(CertificateError::BeyondLimit { step: i, within_until: limit });
        }
        // a step begins where the one before ends
        let ends = [end.unwrap_or_else(|| motion.footprint_at(step.from)), motion.footprint_at(step.to)];
        let proven = proven(collision, motion, step, greater(step.clearance, margin), &ends);
        if !(step.clearance <= proven && proven > margin) {
            return Err(CertificateError::Unproven { step: i, claimed: step.clearance, proven });
        }
        let [_, reached] = ends;
        (at, end) = (step.to, Some(reached));
    }
    Ok(at)
}

/// The clearance that the contracts prove along a step, metres; 0 where the footprints at its ends don't match or are
/// not valid. Where it is more than `needed` any number above that will do, so no obstacle is measured that is farther.
fn proven<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    step: &ProvenStep,
    needed: f64,
    ends: &[Footprint; 2],
) -> f64 {
    let [from, to] = [0, 1].map(|i: usize| ends[i].parts());
    if from.len() != to.len() || !ends.iter().all(Footprint::is_valid) {
        return 0.0;
    }
    let rounding = |size: f64| if size.is_finite() { ROUNDING * ulp(size) } else { 0.0 };
    let mut least = f64::INFINITY;
    for (k, (p, q)) in from.iter().zip(to).enumerate() {
        let (p, q) = (p.placed(), q.placed());
        let points: ShortList<Point2, 16> = p.core().iter().chain(q.core()).copied().collect();
        let vertices = around(&points);
        let radius = greater(p.radius(), q.radius());
        let size = vertices.iter().fold(greater(radius, 1.0), |m, v| greater(greater(v.x.abs(), v.y.abs()), m));
        let sagitta = motion.sagitta(k, step.from, step.to);
        // four times the rounding, because that may double with the distance
        let enough = needed + sagitta + 4.0 * rounding(size + needed + sagitta);
        let distance = collision.distance_of_hull_within(Placed::new(vertices, radius), enough);
        let proven = distance - sagitta - rounding(size + distance);
        if proven.is_nan() {
            return 0.0;
        }
        least = lesser(proven, least);
    }
    least
}

/// The corners of the convex hull, counter-clockwise from the leftmost (the lowest of these), by wrapping a string
/// around the points (Jarvis, 1973); points on an edge are left out.
fn around(points: &[Point2]) -> Vertices {
    let before = |a: &Point2, b: &Point2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    let Some(&start) = points.iter().min_by(|a, b| before(a, b)) else { return Vertices::new() };
    let (mut corners, mut at) = (Vertices::from([start]), start);
    // no hull has more corners than there are points
    for _ in 0..points.len() {
        let mut next = start;
        for &p in points.iter().filter(|&&p| p != at) {
            let turn = orientation(at, next, p);
            let farther = (p.x - at.x).abs() > (next.x - at.x).abs() || (p.y - at.y).abs() > (next.y - at.y).abs();
            if next == at || turn < 0.0 || (turn == 0.0 && farther) {
                next = p;
            }
        }
        if next == start {
            break;
        }
        corners.push(next);
        at = next;
    }
    corners
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::collision::march;
    use crate::collision::{MarchOptions, Scene, Witness};
    use crate::configuration::{R2, Tn};
    use crate::geometry::{Part, Pose2, Segment, Shape, convex_hull};
    use crate::random::{Seed, Stream};
    use crate::robots::{Rates, Reach, Robot};

    /// The two hulls share no code but the predicate: sorting and two chains there, a string around the points here.
    #[test]
    fn a_string_around_the_points_is_their_hull() {
        let mut s = Stream::new(Seed(5), "string");
        for i in 0..4000 {
            let n = 1 + s.below(10) as usize;
            let mut x = || if i % 2 == 0 { s.below(4) as f64 } else { s.uniform(-1.0, 1.0) };
            let points: Vec<Point2> = (0..n).map(|_| Point2::new(x(), x())).collect();
            assert_eq!(around(&points)[..], convex_hull(&points)[..], "{points:?}");
        }
        assert!(around(&[]).is_empty());
    }

    /// Two capsules that stand still. One may give NaN as its acceleration, and one of their numbers may be NaN at one
    /// end of the motion.
    #[derive(Default)]
    struct Odd {
        silent: Option<usize>,
        lost: Option<(usize, f64)>,
    }

    impl Motion for Odd {
        type Configuration = R2;

        fn at(&self, _s: f64) -> R2 {
            R2::new(0.0, 0.0)
        }

        fn footprint_at(&self, s: f64) -> Footprint {
            // two ends and a radius of either part
            let mut numbers = [0.0, 0.5, 0.1, 1.0, 1.5, 0.1];
            if let Some((number, _)) = self.lost.filter(|(_, at)| *at == s) {
                numbers[number] = f64::NAN;
            }
            let part = |[a, b, radius]: [f64; 3]| {
                let (a, b) = (Point2::new(a, 0.0), Point2::new(b, 0.0));
                Part::new(Pose2::IDENTITY, Shape::Capsule { a, b, radius })
            };
            let [a, b, c, d, e, f] = numbers;
            Footprint::new([part([a, b, c]), part([d, e, f])])
        }

        fn rates(&self, part: usize) -> Rates {
            Rates { speed: 0.0, acceleration: if self.silent == Some(part) { f64::NAN } else { 0.0 } }
        }
    }

    #[test]
    fn what_is_no_number_proves_nothing_wherever_it_is() {
        let wall = [Segment::new(Point2::new(-5.0, 2.0), Point2::new(5.0, 2.0))];
        let scene = Scene::of_walls(&wall);
        let claim = Certificate::from_steps(0.0, vec![ProvenStep { from: 0.0, to: 1.0, clearance: 1.0 }]);
        assert_eq!(verify_certificate(&scene, &Odd::default(), &claim), Ok(1.0), "1.9 m from the wall");
        let silent = [0, 1].map(|part| Odd { silent: Some(part), lost: None });
        let lost = [0.0, 1.0].map(|at| [0, 1, 2, 3, 4, 5].map(|number| Odd { silent: None, lost: Some((number, at)) }));
        for odd in silent.iter().chain(lost.as_flattened()) {
            assert!(verify_certificate(&scene, odd, &claim).is_err(), "{:?} {:?}", odd.silent, odd.lost);
            let verdict = march(&scene, odd, MarchOptions::default(), None);
            assert!(!verdict.is_free(), "{:?} {:?}", odd.silent, odd.lost);
        }
    }

    /// A scene that measures whatever it is asked for, however far it is.
    struct Unlimited<'a>(&'a Scene);

    impl Collision for Unlimited<'_> {
        fn intersects(&self, footprint: &Footprint) -> bool {
            self.0.intersects(footprint)
        }

        fn distance(&self, footprint: &Footprint) -> f64 {
            self.0.distance(footprint)
        }

        fn witness(&self, footprint: &Footprint) -> Option<Witness> {
            self.0.witness(footprint)
        }

        fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
            self.0.swept(a, b)
        }
    }

    /// A march proves each step exactly, so a claim of a nanometre more is false, whichever part is the nearest.
    #[test]
    fn what_need_not_be_measured_changes_no_answer_and_a_claim_of_more_is_refused() {
        let (scene, arm) = (Scene::workbench(), Reach::<3>::redundant());
        let (slow, options) = (Unlimited(&scene), MarchOptions::default());
        let mut draws = Stream::new(Seed(7), "claims");
        let (mut certificate, mut slowly) = (Certificate::new(), Certificate::new());
        let mut claims = 0;
        for _ in 0..400 {
            let a: [f64; 3] = std::array::from_fn(|_| draws.uniform(-PI, PI));
            let b = a.map(|angle| angle + draws.uniform(-0.6, 0.6));
            let edge = arm.edge(&Tn(a), &Tn(b).wrapped()).unwrap();
            let verdict = march(&scene, &edge, options, Some(&mut certificate));
            assert_eq!(verdict, march(&slow, &edge, options, Some(&mut slowly)));
            assert_eq!(certificate, slowly);
            let steps = certificate.steps();
            for (forged, more) in (0..steps.len()).flat_map(|i| [0.0, 1e-15, 1e-9, 0.1].map(|more| (i, more))) {
                let mut steps = steps.to_vec();
                steps[forged].clearance += more;
                for margin in [0.0, certificate.clearance()] {
                    let claim = Certificate::from_steps(margin, steps.clone());
                    let verified = verify_certificate(&scene, &edge, &claim);
                    assert_eq!(verified, verify_certificate(&slow, &edge, &claim), "{edge:?} {claim:?}");
                    assert!(margin > 0.0 || more > 0.0 || verified == Ok(claim.proven_until()), "{verified:?}");
                    let refused = matches!(verified, Err(CertificateError::Unproven { step, .. }) if step == forged);
                    assert!(margin > 0.0 || more < 1e-9 || refused, "{verified:?}");
                }
                claims += 1;
            }
        }
        assert!(claims > 1000, "{claims}");
    }
}
