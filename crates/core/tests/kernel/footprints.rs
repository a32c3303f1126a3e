//! The places of robots along their motions by the textbook's formulas instead of the library's. Verdicts hold for
//! these places.
//!
//! A chart line moves at a constant rate in every coordinate, angles the short way round. A drive goes round its
//! turning centre.

use std::f64::consts::PI;

use motion_lab_core::geometry::{Placed, Vertices};
use motion_lab_core::num::{cos, sin, tan};
use motion_lab_core::prelude::*;
use oracle::fixtures::{apartment, lot, workbench};
use oracle::{short, sweep};

/// The angle in (-pi, pi].
fn wrapped(angle: f64) -> f64 {
    short(0.0, angle)
}

fn between(a: f64, b: f64, s: f64) -> f64 {
    a + s * (b - a)
}

fn turned(a: f64, b: f64, s: f64) -> f64 {
    a + s * short(a, b)
}

fn disc(x: f64, y: f64, radius: f64) -> Placed {
    Placed::new([Point2::new(x, y)], radius)
}

/// The links of an arm, by the sums of its angles.
fn links(base: Point2, lengths: &[f64], angles: &[f64], radius: f64) -> Vec<Placed> {
    let (mut at, mut heading) = (base, 0.0);
    let link = |(length, angle): (&f64, &f64)| {
        heading += angle;
        let from = at;
        at = Point2::new(from.x + length * cos(heading), from.y + length * sin(heading));
        Placed::new([from, at], radius)
    };
    lengths.iter().zip(angles).map(link).collect()
}

/// The rectangle from `back` to `front` along a heading, half its width to either side.
fn rectangle([x, y]: [f64; 2], heading: f64, [back, front]: [f64; 2], half: f64) -> Placed {
    let (c, s) = (cos(heading), sin(heading));
    let corners = [(back, -half), (front, -half), (front, half), (back, half)];
    Placed::new(
        corners.iter().map(|(u, v)| Point2::new(x + c * u - s * v, y + s * u + c * v)).collect::<Vertices>(),
        0.0,
    )
}

/// The lab's car, 3.9 m by 1.7 m with 0.7 m behind its rear axle, and its trailer, whose box reaches from 2.8 m to 1 m
/// behind the axle.
fn car(x: f64, y: f64, theta: f64, psi: Option<f64>) -> Vec<Placed> {
    let trailer = psi.map(|psi| rectangle([x, y], psi, [-2.8, -1.0], 0.75));
    std::iter::once(rectangle([x, y], theta, [-0.7, 3.2], 0.85)).chain(trailer).collect()
}

/// Checks that the motion goes through the textbook's places and that its verdict holds for them. Returns whether it is
/// free.
fn holds<R: Robot>(
    checker: &Checker<R>,
    motion: &impl Motion<Configuration = R::Configuration>,
    tolerance: f64,
    at: impl Fn(f64) -> Vec<Placed>,
) -> bool {
    let what = || format!("{:?} from {} to {}", checker.robot(), motion.at(0.0), motion.at(1.0));
    for i in 0..=12 {
        let s = f64::from(i) / 12.0;
        let (footprint, expected) = (motion.footprint_at(s), at(s));
        assert_eq!(footprint.parts().len(), expected.len(), "{}", what());
        for (part, placed) in footprint.parts().iter().zip(&expected) {
            let (found, core) = (part.placed(), placed.core());
            assert_eq!((found.radius(), found.core().len()), (placed.radius(), core.len()), "{}", what());
            let off = found.core().iter().zip(core).map(|(p, q)| (p - q).norm());
            assert!(off.fold(0.0, |m, d| if d > m { d } else { m }) <= tolerance, "at {s} it is elsewhere: {}", what());
        }
    }
    let pieces: Vec<Placed> = checker.scene().pieces().map(|(_, piece)| piece.clone()).collect();
    let clearance = |s: f64| at(s).iter().fold(f64::INFINITY, |m, part| sweep::nearest_of(part, &pieces, m));
    let least = |until: f64, samples: u32| {
        let all = (0..=samples).map(|i| clearance(until * f64::from(i) / f64::from(samples)));
        all.fold(f64::INFINITY, |m, d| if d < m { d } else { m })
    };
    let verdict = checker.motion_verdict(motion);
    match verdict {
        EdgeVerdict::Free { clearance } => {
            assert!(least(1.0, 120) >= clearance - tolerance, "less than {clearance}: {}", what());
        }
        EdgeVerdict::Hit { free_until, contact_at, .. } => {
            assert!(clearance(contact_at) <= tolerance, "no contact at {contact_at}: {}", what());
            assert!(
                free_until == 0.0 || least(0.999 * free_until, 60) > 0.0,
                "not free until {free_until}: {}",
                what()
            );
        }
        EdgeVerdict::Unresolved { free_until, .. } => {
            assert!(
                free_until == 0.0 || least(0.999 * free_until, 60) > 0.0,
                "not free until {free_until}: {}",
                what()
            );
        }
    }
    verdict.is_free()
}

fn pose(scene: &Scene, s: &mut Stream) -> Pose2 {
    let b = scene.bounds();
    Pose2::new(s.uniform(b.min.x, b.max.x), s.uniform(b.min.y, b.max.y), s.uniform(-PI, PI))
}

#[test]
fn edges_lead_through_the_places_that_the_chart_has_on_the_line() {
    let mut s = Stream::new(Seed(131), "tests/footprints");
    let rusty = Checker::new(apartment(), RustyDisc::default());
    let reach = Checker::new(workbench(), Reach::<2>::workbench());
    let three = Checker::new(workbench(), Reach::<3>::redundant());
    let hitch = Checker::new(lot(), HITCH);
    let towing = Checker::new(lot(), HITCH.with_trailer());
    let mut free = [0; 5];
    for i in 0..120 {
        let part = [1.0, 0.3, 0.1][i % 3]; // of the way to anywhere
        let (p, q) = (pose(rusty.scene(), &mut s), pose(rusty.scene(), &mut s));
        let (a, b) = (R2(p.position()), R2(p.position() + (q.position() - p.position()) * part));
        let line = rusty.robot().edge(&a, &b).unwrap();
        let at = |s: f64| vec![disc(between(a.0.x, b.0.x, s), between(a.0.y, b.0.y, s), 0.11)];
        free[0] += u32::from(holds(&rusty, &line, 1e-12, at));

        let mut any = || [(); 3].map(|()| s.uniform(-PI, PI));
        let (a, by) = (any(), any());
        let b = [0, 1, 2].map(|j| wrapped(a[j] + part * by[j]));
        let angles = |s: f64| [0, 1, 2].map(|j| turned(a[j], b[j], s));
        let line = reach.robot().edge(&Tn([a[0], a[1]]), &Tn([b[0], b[1]])).unwrap();
        free[1] +=
            u32::from(holds(&reach, &line, 1e-12, |s| links(Point2::origin(), &[1.0, 1.0], &angles(s)[..2], 0.03)));
        let line = three.robot().edge(&Tn(a), &Tn(b)).unwrap();
        free[2] +=
            u32::from(holds(&three, &line, 1e-12, |s| links(Point2::origin(), &[0.6, 0.5, 0.4], &angles(s), 0.03)));

        let (p, q) = (pose(hitch.scene(), &mut s), pose(hitch.scene(), &mut s));
        let q = Pose2::new(between(p.x, q.x, part), between(p.y, q.y, part), turned(p.theta, q.theta, part));
        let psi = [p.theta, q.theta].map(|theta| wrapped(theta + s.uniform(-1.0, 1.0)));
        let [alone, with] = [[None; 2], psi.map(Some)];
        for (k, checker, [from, to]) in [(3, &hitch, alone), (4, &towing, with)] {
            let (a, b) = (HitchCfg { body: p, trailer: from }, HitchCfg { body: q, trailer: to });
            let line = checker.robot().edge(&a, &b).unwrap();
            let at = |s: f64| {
                let trailer = from.zip(to).map(|(from, to)| turned(from, to, s));
                car(between(p.x, q.x, s), between(p.y, q.y, s), turned(p.theta, q.theta, s), trailer)
            };
            free[k] += u32::from(holds(checker, &line, 1e-12, at));
        }
    }
    assert!(free.iter().all(|n| (4..116).contains(n)), "one-sided: {free:?} of 120 free");
}

#[test]
fn half_a_turn_goes_the_positive_way_and_others_the_short_way() {
    let checker = Checker::new(workbench(), Reach::<2>::workbench());
    for (a, b, middle) in
        [(0.0, PI, 0.5 * PI), (PI, 0.0, -0.5 * PI), (3.0, -3.0, PI), (-3.0, 3.0, PI), (-0.5 * PI, 0.5 * PI, 0.0)]
    {
        let line = checker.robot().edge(&Tn([a, 0.0]), &Tn([b, 0.0])).unwrap();
        assert!(short(line.at(0.5).0[0], middle).abs() < 1e-12, "from {a} to {b}: {}", line.at(0.5));
    }
}

#[test]
fn drives_lead_round_their_turning_centres_and_drag_the_trailer_along() {
    let mut s = Stream::new(Seed(132), "tests/footprints");
    let (rusty, hitch, towing) =
        (Checker::new(apartment(), RUSTY), Checker::new(lot(), HITCH), Checker::new(lot(), HITCH.with_trailer()));
    let mut free = [0; 3];
    // the pose after a distance along a circle of this curvature, whose centre lies its inverse to the left
    let round = |p: &Pose2, way: f64, curvature: f64| {
        let (r, theta) = (1.0 / curvature, p.theta + curvature * way);
        (p.x - r * sin(p.theta) + r * sin(theta), p.y + r * cos(p.theta) - r * cos(theta), theta)
    };
    for i in 0..120 {
        let (p, dt) = (pose(rusty.scene(), &mut s), [0.05, 0.5, 2.0][i % 3]);
        let (v, omega) = (s.uniform(-0.6, 0.6), s.uniform(0.2, 2.5) * [1.0, -1.0][i % 2]);
        let arc = rusty.robot().drive(&p, &RustyCmd { v, omega }, dt).unwrap();
        let at = |s: f64| {
            let (x, y, _) = round(&p, s * v * dt, omega / v);
            vec![disc(x, y, 0.11)]
        };
        free[0] += u32::from(holds(&rusty, &arc, 1e-11, at));

        let (p, v, phi) = (pose(hitch.scene(), &mut s), s.uniform(-1.5, 1.5), s.uniform(0.1, 0.6) * [1.0, -1.0][i % 2]);
        let curvature = tan(phi) / 2.5;
        let arc = hitch.robot().drive(&HitchCfg { body: p, trailer: None }, &CarCmd { v, phi }, dt).unwrap();
        let at = |s: f64| {
            let (x, y, theta) = round(&p, s * v * dt, curvature);
            car(x, y, theta, None)
        };
        free[1] += u32::from(holds(&hitch, &arc, 1e-11, at));

        // psi' = (v / 2 m) sin(theta - psi), in two hundred midpoint steps
        let (dt, psi) = (0.1, p.theta + s.uniform(-1.2, 1.2));
        let start = HitchCfg { body: p, trailer: Some(wrapped(psi)) };
        let arc = towing.robot().drive(&start, &CarCmd { v, phi }, dt).unwrap();
        let trailer = |way: f64| {
            let (n, mut psi) = (200, psi);
            let h = way / f64::from(n);
            for k in 0..n {
                let theta = |half_steps: f64| p.theta + curvature * h * (f64::from(k) + 0.5 * half_steps);
                let half = psi + 0.5 * h * 0.5 * sin(theta(0.0) - psi);
                psi += h * 0.5 * sin(theta(1.0) - half);
            }
            psi
        };
        let at = |s: f64| {
            let (x, y, theta) = round(&p, s * v * dt, curvature);
            car(x, y, theta, Some(trailer(s * v * dt)))
        };
        free[2] += u32::from(holds(&towing, &arc, 1e-8, at));
    }
    assert!(free.iter().all(|n| (6..116).contains(n)), "one-sided: {free:?} of 120 free");
}
