//! Certified paths, shortcuts and goal regions.

use std::sync::Arc;

use motion_lab_core::configuration::Chart;
use motion_lab_core::num::{cos, sin};
use motion_lab_core::planning::{Ball, CertifiedPath, Metric, PathError, TipDisc};

use super::*;

#[test]
fn a_path_is_proven_or_refused() {
    let checker = room(&[[0.0, -0.5, 0.0, 0.5]]);
    let at = R2::new;
    let path = |corners: &[R2]| CertifiedPath::through(&checker, corners);
    assert_eq!(path(&[]).unwrap_err(), PathError::Empty);
    let through = path(&[at(-1.0, 0.0), at(-0.5, 0.0), at(0.5, 0.0)]).unwrap_err();
    assert!(matches!(through, PathError::NotFree { leg: 1, verdict: EdgeVerdict::Hit { .. }, .. }), "{through:?}");
    assert_eq!(through.to_string(), "leg 1 is not proven free: it hits wall 0");
    let nan = path(&[at(-1.0, 0.0), at(f64::NAN, 0.0)]).unwrap_err();
    assert!(matches!(nan, PathError::Configuration { corner: 0, .. }), "{nan:?}");
    let edge = |a: R2, b: R2| checker.robot().edge(&a, &b).unwrap();
    let broken =
        CertifiedPath::try_new(&checker, [edge(at(-1.0, 0.0), at(-0.5, 0.0)), edge(at(-0.6, 0.0), at(-1.0, 0.0))]);
    assert_eq!(broken.unwrap_err(), PathError::Broken(1));
    let still = path(&[at(1.0, 0.0)]).unwrap();
    assert_eq!((still.start(), still.goal()), (at(1.0, 0.0), at(1.0, 0.0)));
    assert!((still.verify(checker.scene()).unwrap() - 0.9).abs() < 1e-9, "a metre from the wall, less the radius");
}

#[test]
fn the_arcs_of_a_drive_make_a_path_too() {
    let lot = CarChecker::new(Scene::lot(), HITCH.with_trailer());
    let mut q = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: Some(0.0) };
    let mut arcs = Vec::new();
    for phi in [0.3, -0.2] {
        let arc = lot.robot().drive(&q, &CarCmd { v: 1.0, phi }, 1.0).unwrap();
        q = arc.at(1.0);
        arcs.push(arc);
    }
    let path = CertifiedPath::try_new(&lot, arcs.clone()).unwrap();
    assert!(path.goal() == q && path.verify(lot.scene()).unwrap() > 0.0);
    arcs.reverse();
    assert_eq!(CertifiedPath::try_new(&lot, arcs).unwrap_err(), PathError::Broken(1));
}

/// Shortcuts of a path: each certified by the oracle too, none longer. Returns the lengths of path and shortcut.
fn shorten<R: Robot<Configuration: Chart>>(
    mut planner: Box<dyn Planner<R>>,
    seed: u64,
    oracle: impl Fn(&[R::Configuration]) -> f64,
) -> [f64; 2] {
    let path = solved(planner.as_mut(), seed, &oracle);
    let (checker, metric) = (planner.problem().checker(), Metric::unit(&path.start()));
    let length = |path: &LinePath<R>| path.length(&metric);
    let pruned = path.pruned(checker, &metric);
    let short = pruned.shortcut(checker, &metric, &mut Stream::new(Seed(seed), "shortcut"), 60);
    let smooth = short.smoothed(checker, &metric, 2);
    for (longer, shorter) in [(&path, &pruned), (&pruned, &short), (&short, &smooth)] {
        assert!(length(shorter) <= length(longer) + 1e-12, "seed {seed}: {} {}", length(longer), length(shorter));
        assert!(shorter.start() == path.start() && shorter.goal() == path.goal());
        let claimed = shorter.verify(checker.scene()).unwrap();
        assert!(claimed > 0.0 && oracle(&shorter.corners()) >= claimed - 1e-9, "seed {seed}");
    }
    assert!(pruned.legs().len() <= path.legs().len());
    [length(&path), length(&smooth)]
}

#[test]
fn shortcuts_are_never_longer_and_always_certified() {
    let scene = Scene::apartment();
    let (mut before, mut after) = (0.0, 0.0);
    for seed in 0..30 {
        let disc = shorten::<RustyDisc>(Box::new(Rrt::new(across_the_apartment(seed))), seed, |c| {
            disc_clearance(&scene, 0.11, c)
        });
        let arm = shorten::<Reach<2>>(Box::new(RrtConnect::new(round_the_post(seed))), seed, arm_clearance);
        (before, after) = (before + disc[0] + arm[0], after + disc[1] + arm[1]);
    }
    assert!(after < 0.9 * before, "{before} {after}: nothing was gained");
}

#[test]
fn a_straight_way_has_no_corner_to_cut() {
    let checker = room(&[]);
    let straight = [R2::new(-1.0, 0.25), R2::new(-0.5, 0.25), R2::new(1.0, 0.25)];
    let path = LinePath::through(&checker, &straight).unwrap();
    let metric = Metric::unit(&straight[0]);
    // nothing is shorter than half a metre and one and a half, so nothing is replaced
    for same in [path.smoothed(&checker, &metric, 3), path.pruned(&checker, &metric)] {
        assert_eq!(same.corners(), straight);
    }
    // with a corner there is: a cut leaves two
    let bent = LinePath::through(&checker, &[straight[0], R2::new(0.0, 1.0), straight[2]]).unwrap();
    assert_eq!(bent.smoothed(&checker, &metric, 1).corners().len(), 4);
    assert_eq!(bent.pruned(&checker, &metric).corners(), [straight[0], straight[2]]);
}

#[test]
fn a_goal_region_is_reached_where_its_centre_need_not_be() {
    let mut beside = 0;
    for seed in 0..20 {
        let (problem, arm) = (round_the_post(seed), Reach::<2>::workbench());
        let disc = TipDisc { arm, centre: Point2::new(2.0 * cos(3.1), 2.0 * sin(3.1)), radius: 0.3 };
        let problem = problem.try_with_region(Arc::new(disc)).unwrap();
        let path = solve(&mut Rrt::new(problem), &Bounds::default()).unwrap();
        // the tip of the arm by its kinematics written out
        let [a, b] = path.goal().0;
        let tip = Point2::new(cos(a) + cos(a + b), sin(a) + sin(a + b));
        assert!((tip - disc.centre).norm() <= 0.3 + 1e-12);
        beside += u32::from(path.goal() != T2::new(3.1, 0.0));
    }
    assert!(beside > 5, "{beside}");
    let (centre, problem) = (T2::new(0.0, 0.0), round_the_post(1));
    let ball = Ball { centre, radius: 0.5, metric: Metric::unit(&centre) };
    assert!(problem.try_with_region(Arc::new(ball)).is_err(), "the goal does not lie in it");
}
