//! The library's certificates before a judge that shares neither distances nor motion bounds with it: the oracle has
//! its own kinematics, its own hulls and its own bound of a part's stray.
//!
//! `verify_certificate` asks the library for its distances and its sagitta, as the march does, so that an error in
//! either would pass it. It would not pass here.

use std::f64::consts::PI;

use motion_lab_core::collision::{Certificate, ProvenStep};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::RUSTY;
use oracle::arm::obstacles;
use oracle::fixtures::{apartment, lot, workbench};
use oracle::proof::{self, Line};

/// What a survey of a robot's edges met.
#[derive(Debug, Default)]
struct Met {
    steps: usize,
    /// Steps whose claim is the whole of what the oracle proves, but for a micrometre.
    tight: usize,
    hits: usize,
    free: usize,
}

/// Judges the certificates of some edges. A claim above what the oracle proves is an error, and so is a forged step
/// that goes over a contact.
fn judge<R: Robot>(
    scene: &Scene,
    robot: R,
    its: &proof::Robot,
    edges: usize,
    mut ends: impl FnMut() -> [R::Configuration; 2],
) -> Met {
    let (pieces, checker) = (obstacles(scene), Checker::new(scene.clone(), robot));
    let (mut met, mut certificate) = (Met::default(), Certificate::new());
    for _ in 0..edges {
        let [a, b] = ends();
        let verdict = checker.edge_certified(&a, &b, &mut certificate).unwrap();
        let line = Line::new(its, &a, &b);
        let mut at = 0.0;
        for &ProvenStep { from, to, clearance } in certificate.steps() {
            assert!(from == at && to > from, "{a:?} to {b:?}: steps from {at}, {from} to {to}");
            at = to;
            let (proven, rounding) = line.proven(from, to, &pieces);
            assert!(
                clearance > 0.0 && clearance <= proven + rounding,
                "{a:?} to {b:?}: claims {clearance} from {from} to {to}, where {proven} is proven"
            );
            met.steps += 1;
            met.tight += usize::from(clearance > proven - 1e-6);
        }
        match verdict {
            EdgeVerdict::Free { clearance } => {
                met.free += 1;
                assert_eq!(at, 1.0, "{a:?} to {b:?}");
                let is_least = certificate.steps().iter().all(|step| clearance <= step.clearance);
                assert!(is_least, "{a:?} to {b:?}: {clearance}");
            }
            EdgeVerdict::Hit { free_until, contact_at, .. } => {
                met.hits += 1;
                assert_eq!(at, free_until, "{a:?} to {b:?}");
                // a step over the contact, whatever it claims
                let (proven, rounding) = line.proven(at, contact_at, &pieces);
                assert!(
                    proven <= rounding,
                    "{a:?} to {b:?}: {proven} is proven over the contact at {at} to {contact_at}"
                );
            }
            EdgeVerdict::Unresolved { .. } => {}
        }
    }
    met
}

#[test]
fn an_oracle_with_a_distance_and_a_bound_of_its_own_accepts_every_certificate() {
    let mut s = Stream::new(Seed(89), "tests/proofs");
    let angle = |s: &mut Stream| s.uniform(-PI, PI);

    let its = proof::Robot::disc(RUSTY.body_radius);
    let place = |s: &mut Stream| R2::new(s.uniform(0.2, 11.8), s.uniform(0.2, 7.8));
    let rusty = judge(&apartment(), RustyDisc::default(), &its, 1500, || [place(&mut s), place(&mut s)]);

    let mut s = Stream::new(Seed(90), "tests/proofs");
    let its = proof::Robot::arm(&[1.0, 1.0], 0.03);
    let arm = Reach::<2>::workbench();
    let reach = judge(&workbench(), arm, &its, 1500, || [(); 2].map(|()| T2::new(angle(&mut s), angle(&mut s))));

    let its = proof::Robot::arm(&[0.6, 0.5, 0.4], 0.03);
    let mut three = || [(); 2].map(|()| Tn([angle(&mut s), angle(&mut s), angle(&mut s)]));
    let longer = judge(&workbench(), Reach::<3>::redundant(), &its, 1500, &mut three);

    let mut s = Stream::new(Seed(91), "tests/proofs");
    let mut car = || {
        let from = Pose2::new(s.uniform(3.0, 13.0), s.uniform(1.5, 4.0), angle(&mut s));
        let to =
            Pose2::new(from.x + s.uniform(-3.0, 3.0), from.y + s.uniform(-1.0, 2.0), from.theta + s.uniform(-0.8, 0.8));
        let fold = s.uniform(-0.6, 0.6);
        [from, to].map(|body| HitchCfg { body, trailer: Some(body.theta + fold) })
    };
    let hitch = judge(&lot(), HITCH.with_trailer(), &proof::Robot::car_with_trailer(), 1500, &mut car);

    for (name, met) in [("rusty", rusty), ("reach", reach), ("reach3", longer), ("hitch", hitch)] {
        assert!(met.steps > 400 && met.tight > 20 && met.free > 40 && met.hits > 40, "{name}: {met:?}");
    }
}
