//! Certificates: the verifier accepts the library's own and refuses all others.

use std::f64::consts::PI;

use motion_lab_core::collision::{Certificate, CertificateError, ProvenStep, verify_certificate};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::num::{self, cos, sin};
use motion_lab_core::prelude::*;

use oracle::fixtures::{count_from_env, workbench};

/// Edges from a micrometre to a centimetre long, into and along obstacles. There the rounding of closed forms is
/// nearest to the clearance that they claim.
#[test]
fn the_verifier_accepts_every_certificate_of_a_short_edge() {
    let mut s = Stream::new(Seed(88), "tests/short edges");
    let mut certificate = Certificate::new();
    let (mut hits, mut free) = (0, 0);
    for i in 0..count_from_env("MOTION_LAB_EDGES", 20_000) {
        // near the origin, at room size, and far out, where an ulp is larger
        let (scale, at) = [(0.4, 0.0), (2.0, 0.0), (3.0, 40.0), (0.3, 0.2)][i as usize % 4];
        let mut place = || Point2::new(at + s.uniform(-scale, scale), at + s.uniform(-scale, scale));
        let (wall, corner) = ([place(), place()], place());
        let bounds = Aabb { min: Point2::new(at - scale, at - scale), max: Point2::new(at + scale, at + scale) };
        let radius = s.uniform(0.01, 0.2);
        // a hair's breadth off an obstacle: the middle of a wall beside a box, or a pin that stands alone
        let gap = num::exp(s.uniform(num::ln(1e-7), num::ln(1e-2)));
        let direction = (wall[1] - wall[0]).normalize();
        let normal = Vector2::new(-direction.y, direction.x);
        let (scene, from) = if i % 3 == 0 {
            let pin = s.uniform(0.001, 0.1);
            let scene = Scene::empty(bounds).with_obstacle_at(
                "the pin",
                Pose2::new(wall[0].x, wall[0].y, 0.0),
                Shape::Disc { radius: pin },
            );
            (scene, wall[0] + normal * (radius + pin + gap))
        } else {
            let far = corner + Vector2::new(0.1, 0.07);
            let scene = Scene::empty(bounds).with_obstacle("the wall", Shape::Segment { a: wall[0], b: wall[1] });
            let scene = scene.with_obstacle("the box", Shape::Rectangle { min: corner, max: far });
            (scene, wall[0] + (wall[1] - wall[0]) * s.unit() + normal * (radius + gap))
        };
        let checker = Checker::new(scene, RustyDisc { radius });
        // toward it, past it, or along it
        let length = num::exp(s.uniform(num::ln(1e-6), num::ln(1e-2)));
        let turn = [0.0, s.uniform(-0.1, 0.1), s.uniform(-PI, PI)][s.below(3) as usize];
        let to = from + (direction * sin(turn) - normal * cos(turn)) * length;
        let (a, b) = (R2(from), R2(to));
        let verdict = checker.edge_certified(&a, &b, &mut certificate).unwrap();
        let motion = checker.robot().edge(&a, &b).unwrap();
        let proven = verify_certificate(checker.scene(), &motion, &certificate);
        let until = match verdict {
            EdgeVerdict::Free { .. } => 1.0,
            EdgeVerdict::Hit { free_until, .. } | EdgeVerdict::Unresolved { free_until, .. } => free_until,
        };
        assert_eq!(proven, Ok(until), "{verdict:?}: {a:?} to {b:?}, radius {radius}, wall {wall:?}");
        assert_eq!(checker.edge_free(&a, &b), verdict.is_free(), "{a:?} to {b:?}");
        hits += u32::from(matches!(verdict, EdgeVerdict::Hit { free_until, .. } if free_until > 0.0));
        free += u32::from(verdict.is_free());
    }
    assert!(hits > 4_000 && free > 4_000, "{hits} hits, {free} free");
}

#[test]
fn a_certificate_that_claims_too_much_or_leaves_a_gap_is_refused() {
    let checker = Checker::new(workbench(), Reach::<2>::workbench());
    let angle = |s: &mut Stream| s.uniform(-PI, PI);
    let mut s = Stream::new(Seed(87), "tests/certificates");
    let mut certificate = Certificate::new();
    let mut tried = 0;
    while tried < 200 {
        let (a, b) = (T2::new(angle(&mut s), angle(&mut s)), T2::new(angle(&mut s), angle(&mut s)));
        let verdict = checker.edge_certified(&a, &b, &mut certificate).unwrap();
        if !verdict.is_free() || certificate.steps().len() < 3 {
            continue;
        }
        tried += 1;
        let motion = checker.robot().edge(&a, &b).unwrap();
        let verify =
            |steps: Vec<ProvenStep>| verify_certificate(checker.scene(), &motion, &Certificate::from_steps(0.0, steps));
        let steps = certificate.steps().to_vec();
        assert_eq!(verify(steps.clone()), Ok(1.0));
        let k = 1 + s.below(steps.len() as u64 - 2) as usize;
        let tampered = |change: fn(&mut ProvenStep)| {
            let mut steps = steps.clone();
            change(&mut steps[k]);
            verify(steps)
        };
        assert!(
            matches!(tampered(|p| p.clearance *= 1.001), Err(CertificateError::Unproven { step, .. }) if step == k)
        );
        assert!(matches!(tampered(|p| p.clearance = f64::NAN), Err(CertificateError::Unproven { .. })));
        assert!(matches!(tampered(|p| p.from += 1e-9), Err(CertificateError::Broken(step)) if step == k));
        assert!(matches!(tampered(|p| p.to = p.from), Err(CertificateError::Backward(step)) if step == k));
        assert!(tampered(|p| p.to = 2.0).is_err() && tampered(|p| p.to = f64::NAN).is_err());
        let mut missing = steps.clone();
        missing.remove(k);
        assert_eq!(verify(missing), Err(CertificateError::Broken(k)));
        assert_eq!(verify(steps[..k].to_vec()), Ok(steps[k].from), "what is left proves only so far");
    }
    // one step over an edge that hits proves nothing, whatever it claims
    let (a, b) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
    let motion = checker.robot().edge(&a, &b).unwrap();
    for clearance in [1.0, 1e-300, 0.0, -1.0] {
        let lie = Certificate::from_steps(0.0, vec![ProvenStep { from: 0.0, to: 1.0, clearance }]);
        assert!(verify_certificate(checker.scene(), &motion, &lie).is_err());
    }
}
