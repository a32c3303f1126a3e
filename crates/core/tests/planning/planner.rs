//! The interfaces of planners: batches, clearance, the last free configuration, problems.

use std::f64::consts::PI;

use motion_lab_core::collision::{ChainChecker, Checker, Collision, Problem, ProblemError, Scene};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;

fn block() -> Scene {
    let bounds = Aabb { min: Point2::new(-2.4, -2.4), max: Point2::new(2.4, 2.4) };
    let shape = Shape::try_rectangle(Point2::new(0.5, 1.0), Point2::new(1.0, 1.5)).unwrap();
    Scene::empty(bounds).with_obstacle("the block", shape)
}

fn arm() -> ChainChecker<2> {
    ChainChecker::new(block(), Reach::<2>::workbench())
}

#[test]
fn a_batch_gives_the_answers_one_by_one_at_any_number_of_threads() {
    let checker = arm();
    let mut s = Stream::new(Seed(9), "batch");
    let mut draw = || T2::new(s.uniform(-PI, PI), s.uniform(-PI, PI));
    let qs: Vec<T2> = (0..500).map(|_| draw()).collect();
    let pairs: Vec<(T2, T2)> = (0..100).map(|_| (draw(), draw())).collect();
    let one_by_one: (Vec<bool>, Vec<f64>) =
        (qs.iter().map(|q| checker.is_free(q)).collect(), qs.iter().map(|q| checker.distance(q)).collect());
    assert!(one_by_one.0.contains(&true) && one_by_one.0.contains(&false));
    let verdicts: Vec<_> = pairs.iter().map(|(a, b)| checker.edge(a, b)).collect();
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            assert_eq!(checker.are_free(&qs), one_by_one.0);
            assert_eq!(checker.distances(&qs), one_by_one.1);
            assert_eq!(checker.edges(&pairs), verdicts);
            let free = checker.edges_free(&pairs);
            assert!(
                verdicts.iter().zip(free).all(|(verdict, free)| verdict.as_ref().is_ok_and(|v| v.is_free()) == free)
            );
        });
    }
}

#[test]
fn moving_along_the_clearance_direction_gains_exactly_that_much() {
    let disc = Checker::new(block(), RustyDisc::default());
    let mut s = Stream::new(Seed(10), "gradient");
    let mut tried = 0;
    while tried < 300 {
        let q = R2::new(s.uniform(-2.0, 2.0), s.uniform(-2.0, 2.0));
        let (dist, direction) = disc.clearance_gradient(&q).unwrap();
        let Some(n) = direction else {
            assert_eq!(dist, 0.0);
            continue;
        };
        // the obstacle is convex: straight away from the nearest point the distance grows one for one
        let farther = disc.distance(&R2(q.0 + n * 0.25));
        assert!((farther - dist - 0.25).abs() < 1e-14, "{q}: {dist} {farther}");
        tried += 1;
    }
}

#[test]
fn the_last_free_configuration_is_free_and_just_before_the_contact() {
    let checker = arm();
    let (a, b) = (T2::new(0.0, 0.0), T2::new(2.0, 0.0));
    let last = checker.last_free(&a, &b).unwrap().unwrap();
    assert!(checker.is_free(&last) && checker.distance(&last) < 1e-6);
    assert_eq!(checker.last_free(&a, &T2::new(-0.5, 0.0)).unwrap(), Some(T2::new(-0.5, 0.0)));
    assert_eq!(checker.last_free(&T2::new(1.0, 0.0), &a).unwrap(), None, "it starts in contact");
}

#[test]
fn a_problem_names_the_end_that_is_not_free() {
    let (free, blocked) = (T2::new(0.0, 0.0), T2::new(1.0, 0.0));
    let refused = Problem::try_new(arm(), free, blocked, Seed(1)).unwrap_err();
    assert_eq!(refused, ProblemError::Overlap { end: "goal", obstacle: "the block".into() });
    assert_eq!(refused.to_string(), "the goal would overlap the block");
    let nan = Problem::try_new(arm(), Tn([f64::NAN, 0.0]), free, Seed(1)).unwrap_err();
    assert!(matches!(nan, ProblemError::Configuration { end: "start", .. }));
}

#[test]
fn samples_are_seeded_and_cover_the_space() {
    let problem = || Problem::try_new(arm(), T2::new(0.0, 0.0), T2::new(-1.0, 0.0), Seed(3)).unwrap();
    let (mut p, mut again) = (problem(), problem());
    let samples: Vec<T2> = (0..400).map(|_| p.sample()).collect();
    assert!(samples.iter().all(|q| again.sample() == *q));
    for axis in 0..2 {
        for quadrant in 0..4 {
            let low = -PI + f64::from(quadrant) * PI / 2.0;
            let count = samples.iter().filter(|q| q.0[axis] >= low && q.0[axis] < low + PI / 2.0).count();
            assert!((60..140).contains(&count), "a quarter of 400, give or take 4.6 sigma: {count}");
        }
    }
    assert!(p.sample_free(100).is_some_and(|q| p.checker().is_free(&q)));
    assert!(!p.checker().scene().intersects(&p.checker().robot().footprint(&p.start())));
}
