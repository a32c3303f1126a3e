//! Certified paths, shortcuts and goal regions.

use std::sync::Arc;

use motion_lab_core::configuration::Chart;
use motion_lab_core::num::{cos, sin};
use motion_lab_core::planning::{Ball, CertifiedPath, MARGIN, Metric, PathError, TipDisc};

use super::*;

#[test]
fn a_path_is_proven_or_refused() {
    let checker = room(&[[0.0, -0.5, 0.0, 0.5]]);
    let at = R2::new;
    let path = |corners: &[R2]| CertifiedPath::through(&checker, corners);
    assert_eq!(path(&[]).unwrap_err(), PathError::Empty);
    let through = path(&[at(-1.0, 0.0), at(-0.5, 0.0), at(0.5, 0.0)]).unwrap_err();
    assert!(matches!(through, PathError::NotFree { leg: 1, verdict: EdgeVerdict::Hit { .. }, .. }), "{through:?}");
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

/// Corners above a wall on y = 0 from x = -1 to 1, whose ends a disc of 10 cm goes round.
fn over_a_wall(corners: &[[f64; 2]]) -> (DiscChecker, LinePath<RustyDisc>) {
    let checker = room(&[[-1.0, 0.0, 1.0, 0.0]]);
    let corners: Vec<R2> = corners.iter().map(|[x, y]| R2::new(*x, *y)).collect();
    let path = LinePath::through(&checker, &corners).unwrap();
    (checker, path)
}

#[test]
fn shortcuts_keep_a_millimetre_where_the_path_has_it() {
    // from 0.1 mm to 0.5 m above the wall and back: the straight way is 0.1 mm above it
    let low = 0.1001;
    let (checker, path) = over_a_wall(&[[-1.5, low], [0.0, 0.6], [1.5, low]]);
    let metric = Metric::unit(&path.start());
    let clearance = |path: &LinePath<RustyDisc>| disc_clearance(checker.scene(), 0.1, &path.corners());
    assert!(clearance(&path) > MARGIN, "{}", clearance(&path));
    let shorter = [
        path.pruned(&checker, &metric),
        path.smoothed(&checker, &metric, 6),
        path.shortcut(&checker, &metric, &mut Stream::new(Seed(3), "shortcut"), 400),
    ];
    for short in &shorter {
        let claimed = short.verify(checker.scene()).unwrap();
        assert!(claimed >= MARGIN && clearance(short) >= MARGIN - 1e-9, "{claimed} {}", clearance(short));
    }
    assert!(shorter[2].length(&metric) < 0.99 * path.length(&metric), "it is shortened all the same");
    // a path that has less is shortened as far as it goes itself
    let (_, near) = over_a_wall(&[[-1.5, low], [0.0, low], [0.2, 0.3], [0.5, low], [1.5, low]]);
    let pruned = near.pruned(&checker, &metric);
    assert!(pruned.corners().iter().all(|q| q.0.y == low), "{:?}", pruned.corners());
    assert!((clearance(&pruned) - 1e-4).abs() < 1e-8, "{}", clearance(&pruned));
}

#[test]
fn an_arms_shortcuts_keep_the_margin_too() {
    let mut kept = 0;
    for seed in 0..40 {
        let path = solve(&mut RrtConnect::new(round_the_post(seed)), &Bounds::default()).unwrap();
        let (problem, metric) = (round_the_post(seed), Metric::unit(&path.start()));
        if arm_clearance(&path.corners()) < MARGIN + 1e-6 {
            continue;
        }
        kept += 1;
        let short = path.shortcut(problem.checker(), &metric, &mut Stream::new(Seed(seed), "shortcut"), 200);
        let clearance = arm_clearance(&short.pruned(problem.checker(), &metric).corners());
        assert!(clearance >= MARGIN - 1e-7, "seed {seed}: {clearance}");
    }
    assert!(kept > 30, "{kept}");
}

#[test]
fn a_path_that_keeps_a_margin_is_proven_to() {
    let (checker, path) = over_a_wall(&[[-1.5, 0.2], [1.5, 0.2]]);
    let motions = || path.legs().iter().map(|leg| leg.motion().clone());
    // the wall is 0.2 m away, the radius 0.1 m
    let kept = LinePath::try_keeping(&checker, motions(), 0.099).unwrap();
    assert!(kept.verify(checker.scene()).unwrap() > 0.099);
    let near = LinePath::try_keeping(&checker, motions(), 0.101).unwrap_err();
    assert_eq!(near.to_string(), "leg 0 hits wall 0 with part 0");
}

#[test]
fn a_leg_that_hits_names_the_obstacle_and_the_part() {
    let checker = room(&[[0.0, -0.5, 0.0, 0.5], [1.0, -0.5, 1.0, 0.5]]);
    let at = R2::new;
    let through = CertifiedPath::through(&checker, &[at(-1.0, 0.8), at(0.5, 0.8), at(0.5, 0.0), at(1.5, 0.0)]);
    let refused = through.unwrap_err();
    assert_eq!(refused.to_string(), "leg 2 hits wall 1 with part 0");
    let PathError::NotFree { obstacle, .. } = &refused else { panic!("{refused:?}") };
    assert_eq!(obstacle.as_deref(), Some("wall 1"));
    // the arm turns about its base, stretched out, and the post stands beside its first link
    let arm = round_the_post(1);
    let refused = CertifiedPath::through(arm.checker(), &[arm.start(), arm.goal()]).unwrap_err().to_string();
    assert_eq!(refused, "leg 0 hits the post with part 0");
    // a hitch that folds too far hits nothing
    let plane = Aabb::new(Point2::new(-50.0, -50.0), Point2::new(50.0, 50.0));
    let car = Checker::new(Scene::empty(plane), HITCH.with_trailer().with_jackknife(0.3));
    let q = HitchCfg { body: Pose2::new(6.5, 2.5, 0.0), trailer: Some(0.0) };
    let arc = car.robot().drive(&q, &CarCmd { v: 1.0, phi: 0.5 }, 3.0).unwrap();
    let folded = CertifiedPath::try_new(&car, [arc]).unwrap_err();
    assert_eq!(folded.to_string(), "leg 0 leaves the robot's own limits with part 1");
    assert!(matches!(folded, PathError::NotFree { obstacle: None, .. }), "{folded:?}");
}
