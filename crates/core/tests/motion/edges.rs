//! Edges of the three robots in the three worlds: the certified verdicts against dense sampling.

use std::f64::consts::PI;
use std::sync::Arc;

use motion_lab_core::collision::{Certificate, Checker, EdgeVerdict, MarchOptions, Scene};
use motion_lab_core::configuration::{Configuration, HitchCfg, R2, T2, Tn};
use motion_lab_core::geometry::{Placed, Point2, Pose2, Shape};
use motion_lab_core::num::{cos, sin};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{
    CarBody, CarCmd, Drivable, HITCH, Hitch, Motion, RUSTY, Reach, Robot, RustyCmd, RustyDisc, TrailerBody,
};

use super::verdicts::{Sampled, Tally, check, check_claims};
use oracle::fixtures::{apartment, count_from_env, lot, scene_of, workbench};
use oracle::sweep;

/// Surveys `count` edges from free configurations (nine in ten) and any, some short and some long.
fn survey<R: Robot>(
    name: &str,
    robot: R,
    scene: &Arc<Scene>,
    count: u64,
    mut draw: impl FnMut(&mut Stream) -> R::Configuration,
) -> Tally {
    let mut s = Stream::new(Seed(81), name);
    let checker = Checker::new(scene.clone(), robot);
    let world = Sampled::new(scene);
    let mut certificate = Certificate::new();
    let (mut tally, mut by_march, mut with_margin) = (Tally::default(), Tally::default(), Tally::default());
    for i in 0..count {
        let mut a = draw(&mut s);
        for _ in 0..if i % 10 == 0 { 0 } else { 200 } {
            if checker.is_free(&a) {
                break;
            }
            a = draw(&mut s);
        }
        let far = draw(&mut s);
        let b = a.interpolate(&far, [1.0, 0.3, 0.1, 0.02][i as usize % 4]).unwrap();
        let motion = checker.robot().edge(&a, &b).unwrap();
        let at = || format!("{:?} from {a:?} to {b:?}", checker.robot());
        let verdict = checker.edge_certified(&a, &b, &mut certificate).unwrap();
        check_claims(&world, &motion, 0.0, (verdict, &certificate), &mut tally, at);
        assert_eq!(checker.edge(&a, &b).unwrap(), verdict, "{}", at());
        assert_eq!(checker.edge_free(&a, &b), verdict.is_free(), "{}", at());
        if i % 5 == 0 {
            // motions with a closed form are marched too, and the verdicts agree
            let marched = check(&world, &motion, MarchOptions::default(), &mut certificate, &mut by_march, at);
            assert!(agree(verdict, marched), "{verdict:?} {marched:?}: {}", at());
            let options = MarchOptions { margin: 0.02, ..MarchOptions::default() };
            check(&world, &motion, options, &mut certificate, &mut with_margin, at);
        }
    }
    tally.print(name);
    tally
}

/// Whether two verdicts on one motion can both be true: of two hits the brackets of the first contact overlap.
fn agree(a: EdgeVerdict, b: EdgeVerdict) -> bool {
    let bracket = |verdict: EdgeVerdict| match verdict {
        EdgeVerdict::Free { .. } => None,
        EdgeVerdict::Hit { free_until, contact_at, .. } => Some((free_until, contact_at)),
        EdgeVerdict::Unresolved { free_until, .. } => Some((free_until, 1.0)),
    };
    match (bracket(a), bracket(b)) {
        (Some((free_a, hit_a)), Some((free_b, hit_b))) => free_a <= hit_b && free_b <= hit_a,
        (a, b) => a.is_none() && b.is_none(),
    }
}

/// A random pose in the scene's bounds.
fn pose(scene: &Scene, s: &mut Stream) -> Pose2 {
    let b = scene.bounds();
    Pose2::new(s.uniform(b.min.x, b.max.x), s.uniform(b.min.y, b.max.y), s.uniform(-PI, PI))
}

fn worlds() -> [(&'static str, Arc<Scene>); 3] {
    [("the Apartment", Arc::new(apartment())), ("the Workbench", Arc::new(workbench())), ("the Lot", Arc::new(lot()))]
}

/// Number of edges surveyed in all. `MOTION_LAB_EDGES` changes it (to a million for the acceptance run).
fn edges() -> u64 {
    count_from_env("MOTION_LAB_EDGES", 10_000)
}

/// Hitch at a quarter of its size.
fn toy() -> Hitch {
    let (body, trailer) = (HITCH.body, HITCH.trailer_body);
    Hitch {
        wheelbase: 0.25 * HITCH.wheelbase,
        body: CarBody {
            length: 0.25 * body.length,
            width: 0.25 * body.width,
            rear_overhang: 0.25 * body.rear_overhang,
        },
        trailer_body: TrailerBody {
            front_overhang: 0.25 * trailer.front_overhang,
            rear_overhang: 0.25 * trailer.rear_overhang,
            width: 0.25 * trailer.width,
        },
        ..HITCH
    }
}

fn angle(s: &mut Stream) -> f64 {
    s.uniform(-PI, PI)
}

/// Checks that a robot's verdicts are of every sort, and hardly any undecided.
fn assert_telling(name: &str, tallies: &[Tally], count: u64) {
    let sum = |f: fn(&Tally) -> u64| tallies.iter().map(f).sum::<u64>();
    let (free, hits, unresolved) = (sum(|t| t.free), sum(|t| t.hits), sum(|t| t.unresolved));
    println!("{name}: {unresolved} of {count} edges unresolved");
    assert!(free > count / 10 && hits > count / 10, "one-sided: {free} free, {hits} hits of {count}");
    assert!(sum(|t| t.transversal) > count / 20, "hardly a transversal hit");
    assert!(sum(|t| t.wide) <= hits / 100 + 1, "{} of {hits} hits in a wide bracket", sum(|t| t.wide));
    assert!(unresolved <= count / 1000 + 1, "{unresolved} of {count} unresolved");
}

#[test]
fn edges_of_rusty_agree_with_dense_sampling() {
    let n = edges() / 9;
    let tallies = worlds().map(|(world, scene)| {
        let draw = |s: &mut Stream| R2(pose(&scene, s).position());
        survey(&format!("Rusty in {world}"), RustyDisc::default(), &scene, n, draw)
    });
    assert_telling("Rusty", &tallies, 3 * n);
}

#[test]
fn edges_of_reach_agree_with_dense_sampling() {
    let n = edges() / 9;
    let mut tallies = Vec::new();
    for (world, scene) in worlds() {
        let base = match world {
            "the Apartment" => Point2::new(6.0, 4.0), // in the corridor
            "the Lot" => Point2::new(4.7, 4.3),       // beside a pillar
            _ => Point2::origin(),
        };
        let draw2 = |s: &mut Stream| T2::new(angle(s), angle(s));
        let draw3 = |s: &mut Stream| Tn([angle(s), angle(s), angle(s)]);
        let thin = Reach { base, ..Reach::<2>::choset() };
        let thick = Reach { base, ..Reach::<2>::workbench() };
        let three = Reach { base, ..Reach::<3>::redundant() };
        tallies.push(survey(&format!("Reach without thickness in {world}"), thin, &scene, n / 3, draw2));
        tallies.push(survey(&format!("Reach in {world}"), thick, &scene, n / 3, draw2));
        tallies.push(survey(&format!("Reach<3> in {world}"), three, &scene, n / 3, draw3));
    }
    assert_telling("Reach", &tallies, 3 * n);
}

#[test]
fn edges_of_hitch_agree_with_dense_sampling() {
    let n = edges() / 9;
    let mut tallies = Vec::new();
    for (world, scene) in worlds() {
        // a toy of a quarter of its size where the car does not fit
        let car = if world == "the Lot" { HITCH } else { toy() };
        let towing = Hitch { hitch_len: Some(0.8 * car.wheelbase), ..car };
        let alone = |s: &mut Stream| HitchCfg { body: pose(&scene, s), trailer: None };
        let with_trailer = |s: &mut Stream| HitchCfg { trailer: Some(angle(s)), ..alone(s) };
        tallies.push(survey(&format!("Hitch in {world}"), car, &scene, n / 2, alone));
        tallies.push(survey(&format!("Hitch with a trailer in {world}"), towing, &scene, n / 2, with_trailer));
    }
    assert_telling("Hitch", &tallies, 3 * n);
}

/// Table N: `edge_free` against sampling every 2 mm (2 mrad) of the chart, on 264 random edges over the three robots.
#[test]
fn edge_free_against_dense_sampling_at_2_mm_in_the_chart() {
    fn compare<R: Robot>(
        checker: &Checker<R>,
        mut draw: impl FnMut(&mut Stream) -> R::Configuration,
        seed: u64,
    ) -> u32 {
        let mut s = Stream::new(Seed(seed), "tests/chart");
        let pieces: Vec<Placed> = checker.scene().pieces().map(|(_, p)| p.clone()).collect();
        let mut free = 0;
        for _ in 0..88 {
            let mut a = draw(&mut s);
            while !checker.is_free(&a) {
                a = draw(&mut s);
            }
            let b = a.interpolate(&draw(&mut s), 0.3).unwrap();
            let length = a.difference(&b).unwrap().iter().map(|d| d * d).sum::<f64>().sqrt();
            let n = (length / 0.002).ceil();
            let motion = checker.robot().edge(&a, &b).unwrap();
            let sampled = (0..=n as u32).all(|i| {
                let footprint = motion.footprint_at(f64::from(i) / n);
                footprint.parts().iter().all(|part| sweep::nearest_of(part.placed(), &pieces, 1.0) > 0.0)
            });
            let verdict = checker.edge(&a, &b).unwrap();
            // Sampling may miss a contact between two samples and find an edge free that the march finds hit. Then the
            // verdict's own contact must be one.
            if verdict.is_free() {
                assert!(sampled, "{a} to {b} is said to be free");
            } else if sampled {
                let EdgeVerdict::Hit { contact_at, .. } = verdict else { panic!("{verdict:?}: {a} to {b}") };
                let contact = motion.footprint_at(contact_at);
                let gap = contact.parts().iter().fold(1.0, |m, p| sweep::nearest_of(p.placed(), &pieces, m));
                assert!(gap < 1e-12, "{a} to {b} is said to hit");
            }
            free += u32::from(verdict.is_free());
        }
        free
    }
    let [(_, apartment), (_, workbench), (_, lot)] = worlds();
    let rusty = Checker::new(apartment.clone(), RustyDisc::default());
    let reach = Checker::new(workbench, Reach::<2>::workbench());
    let hitch = Checker::new(lot.clone(), HITCH.with_trailer());
    let free = [
        compare(&rusty, |s| R2(pose(&apartment, s).position()), 82),
        compare(&reach, |s| T2::new(angle(s), angle(s)), 83),
        compare(&hitch, |s| HitchCfg { body: pose(&lot, s), trailer: Some(angle(s)) }, 84),
    ];
    assert!(free.iter().all(|n| (8..80).contains(n)), "one-sided: {free:?} of 88 free");
}

/// The arcs of a tick or a few seconds of driving, with the trailer in tow.
#[test]
fn arcs_of_rusty_and_hitch_agree_with_dense_sampling() {
    let n = edges() / 20;
    let mut s = Stream::new(Seed(85), "tests/arcs");
    let [(_, apartment), (_, workbench), (_, lot)] = worlds();
    let mut certificate = Certificate::new();
    let mut tally = Tally::default();
    let options = MarchOptions::default();
    let towing = Hitch { hitch_len: Some(0.5), ..toy() };
    for i in 0..n {
        let dt = [0.05, 1.0, 4.0][i as usize % 3];
        let (v, turn) = (s.uniform(-1.5, 1.5), s.uniform(-2.5, 2.5));
        let q = pose(&apartment, &mut s);
        let arc = RUSTY.drive(&q, &RustyCmd { v, omega: turn }, dt).unwrap();
        check(&Sampled::new(&apartment), &arc, options, &mut certificate, &mut tally, || format!("{arc:?}"));
        let (car, scene) = [(HITCH, &lot), (HITCH.with_trailer(), &lot), (towing, &workbench)][i as usize % 3];
        let trailer = car.hitch_len.map(|_| angle(&mut s));
        let q = HitchCfg { body: pose(scene, &mut s), trailer };
        let arc = car.drive(&q, &CarCmd { v, phi: 0.3 * turn }, dt).unwrap();
        check(&Sampled::new(scene), &arc, options, &mut certificate, &mut tally, || format!("{arc:?}"));
    }
    tally.print("Arcs");
    assert_telling("Arcs", &[tally], 2 * n);
}

/// Edges drawn to graze: along walls and past posts, at clearances from a millimetre down to 0.
#[test]
fn grazing_edges_are_decided_down_to_a_nanometre() {
    let mut s = Stream::new(Seed(86), "tests/grazing");
    let mut certificate = Certificate::new();
    let mut tally = Tally::default();
    for i in 0..400 {
        let gap = [1e-3, 1e-5, 1.5e-6, 1e-7, 1e-9, 0.0, -1e-9, -1e-6][i % 8];
        let (from, to) = (angle(&mut s), s.uniform(0.2, 2.0));
        let what = || format!("case {i} at a gap of {gap}");
        let options = MarchOptions::default();
        let verdict = match i / 8 % 3 {
            0 => {
                // a disc along a wall that lies slanted
                let wall = Pose2::new(s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0), from);
                let scene = scene_of(&[(wall, segment(-6.0, 6.0))]);
                let at = |x: f64| R2(wall.transform(Point2::new(x, 0.11 + gap)));
                let motion = RustyDisc::default().edge(&at(-5.0), &at(5.0)).unwrap();
                check(&Sampled::new(&scene), &motion, options, &mut certificate, &mut tally, what)
            }
            1 => {
                // the tip of a stretched arm past a post
                let arm = Reach::<2>::workbench();
                let out = 2.0 + 0.03 + 0.25 + gap;
                let scene = scene_of(&[(Pose2::new(out * cos(from), out * sin(from), 0.0), disc(0.25))]);
                let motion = arm.edge(&T2::new(from - 0.5 * to, 0.0), &T2::new(from + 0.5 * to, 0.0)).unwrap();
                check(&Sampled::new(&scene), &motion, options, &mut certificate, &mut tally, what)
            }
            _ => {
                // a corner of the turning car past a wall: its farthest reach from the rear axle
                let (x, y) = (HITCH.body.length - HITCH.body.rear_overhang, 0.5 * HITCH.body.width);
                let reach = (x * x + y * y).sqrt() + gap;
                let wall = Pose2::new(reach * cos(from), reach * sin(from), from + 0.5 * PI);
                let scene = scene_of(&[(wall, segment(-3.0, 3.0))]);
                let at = |theta: f64| HitchCfg { body: Pose2::new(0.0, 0.0, from + theta), trailer: None };
                let motion = HITCH.edge(&at(-1.3), &at(-0.02)).unwrap();
                check(&Sampled::new(&scene), &motion, options, &mut certificate, &mut tally, what)
            }
        };
        // the bodies' places are rounded, so a gap of exactly 0 may become contact or not
        if gap >= 1e-9 {
            assert!(!matches!(verdict, EdgeVerdict::Hit { .. }), "{verdict:?} in {}", what());
        }
        if gap > 1e-6 {
            assert!(verdict.is_free(), "{verdict:?} in {}", what());
        }
        if gap < 0.0 {
            assert!(!verdict.is_free(), "{verdict:?} in {}", what());
        }
    }
    tally.print("Grazing");
}

fn segment(from: f64, to: f64) -> Shape {
    Shape::try_segment(Point2::new(from, 0.0), Point2::new(to, 0.0)).unwrap()
}

fn disc(radius: f64) -> Shape {
    Shape::try_disc(radius).unwrap()
}
