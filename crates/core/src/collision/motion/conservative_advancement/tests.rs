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
    assert!(!verdict(f64::NAN).is_free() && !verdict(f64::INFINITY).is_free());
}

/// A disc of 0.25 m through a wall: the clearance of its sweep is 0 m, which is above every margin below 0.
#[test]
fn below_a_margin_of_nothing_nothing_more_is_free() {
    let c = disc(wall((3.0, -1.0), (3.0, 1.0)), 0.25);
    let edge = c.robot().edge(&R2::new(0.0, 0.0), &R2::new(8.0, 0.0)).unwrap();
    let whole = vec![ProvenStep { from: 0.0, to: 1.0, clearance: -1.0 }];
    for margin in [-1e-300, -1.0, -1e6, f64::NEG_INFINITY, f64::NAN, f64::INFINITY] {
        let mut certificate = Certificate::new();
        let verdict = march(c.scene(), &edge, MarchOptions { margin, budget: 4096 }, Some(&mut certificate));
        assert!(!verdict.is_free(), "{margin}: {verdict:?}");
        if margin < 0.0 {
            assert!(matches!(verdict, EdgeVerdict::Hit { .. }), "{margin}: {verdict:?}");
            assert_eq!(certificate.margin(), 0.0);
            let free = verify_certificate(c.scene(), &edge, &certificate).unwrap();
            // the disc touches at x = 2.75 of 8
            assert!(free > 0.34 && free < 2.75 / 8.0, "{margin}: {free}");
        }
        let forged = [vec![], whole.clone()].map(|steps| Certificate::from_steps(margin, steps));
        for forged in &forged {
            let verdict = verify_certificate(c.scene(), &edge, forged);
            assert!(matches!(verdict, Err(CertificateError::Margin(_))), "{margin}: {verdict:?}");
        }
    }
    let claim = Certificate::from_steps(-0.0, vec![ProvenStep { from: 0.0, to: 0.25, clearance: 0.7 }]);
    assert_eq!(verify_certificate(c.scene(), &edge, &claim), Ok(0.25), "minus nothing is nothing");
}

#[test]
fn a_forged_certificate_is_refused() {
    let c = disc(wall((3.0, -1.0), (3.0, 1.0)), 0.25);
    let edge = c.robot().edge(&R2::new(0.0, 0.0), &R2::new(8.0, 0.0)).unwrap();
    let step = |from: f64, to: f64, clearance: f64| ProvenStep { from, to, clearance };
    let verify = |steps| verify_certificate(c.scene(), &edge, &Certificate::from_steps(0.0, steps));
    assert_eq!(verify(vec![step(0.0, 0.25, 0.7)]), Ok(0.25));
    assert!(matches!(verify(vec![step(0.0, 0.25, 0.8)]), Err(CertificateError::Unproven { step: 0, .. })));
    assert!(matches!(verify(vec![step(0.0, 1.0, 0.0)]), Err(CertificateError::Unproven { .. })), "through the wall");
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
