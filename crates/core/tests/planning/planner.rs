//! The interfaces of planners: batches, clearance, the last free configuration, problems.

use std::f64::consts::PI;

use motion_lab_core::collision::{ChainChecker, Checker, Collision, Problem, ProblemError, Rows, RowsError, Scene};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ConfigurationError, HITCH};

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
fn rows_of_numbers_get_the_answers_of_their_configurations_in_the_callers_memory() {
    let checker = arm();
    let mut s = Stream::new(Seed(12), "rows");
    let numbers: Vec<f64> = (0..400).map(|_| s.uniform(-PI, PI)).collect();
    let qs: Vec<T2> = numbers.chunks(2).map(|q| T2::new(q[0], q[1])).collect();
    let rows = Rows::new(checker.robot(), &numbers, 2).unwrap();
    let (from, to) = (Rows::new(checker.robot(), &numbers[..200], 2), Rows::new(checker.robot(), &numbers[200..], 2));
    let (from, to) = (from.unwrap(), to.unwrap());
    assert!(rows.len() == 200 && to.len() == 100 && !rows.is_empty());

    let (mut free, mut hits, mut distances) = ([false; 200], [false; 200], [0.0; 200]);
    let (mut witnesses, mut clear) = (vec![None; 200], [false; 100]);
    let mut verdicts = vec![Err(ConfigurationError::OtherRobot); 100];
    checker.are_free_into(&rows, &mut free).unwrap();
    checker.intersects_into(&rows, &mut hits).unwrap();
    checker.distances_into(&rows, &mut distances).unwrap();
    checker.witnesses_into(&rows, &mut witnesses).unwrap();
    checker.edges_free_into(&from, &to, &mut clear).unwrap();
    checker.edges_into(&from, &to, &mut verdicts).unwrap();
    for (i, q) in qs.iter().enumerate() {
        let footprint = checker.robot().footprint(q);
        assert_eq!((free[i], hits[i]), (checker.is_free(q), block().intersects(&footprint)), "{q}");
        assert_eq!((distances[i], witnesses[i]), (checker.distance(q), block().witness(&footprint)), "{q}");
    }
    assert!(hits.contains(&true) && hits.contains(&false));
    for i in 0..100 {
        let (a, b) = (&qs[i], &qs[100 + i]);
        assert_eq!((clear[i], &verdicts[i]), (checker.edge_free(a, b), &checker.edge(a, b)), "{a} {b}");
    }

    // nothing is written where places are wrong
    let mut few = [7.0; 199];
    assert_eq!(checker.distances_into(&rows, &mut few), Err(RowsError::Places { answers: 200, places: 199 }));
    assert_eq!(few, [7.0; 199]);
    let pairs = checker.edges_free_into(&rows, &to, &mut clear);
    assert_eq!(pairs, Err(RowsError::Pairs { from: 200, to: 100 }));
}

#[test]
fn rows_that_are_no_configurations_are_named_by_their_number() {
    let car = HITCH.with_trailer();
    let row = |numbers: &[f64], width| Rows::new(&car, numbers, width).map(|rows| rows.len());
    assert_eq!(row(&[0.0; 8], 4), Ok(2));
    assert_eq!(row(&[], 4), Ok(0));
    assert_eq!(row(&[0.0; 9], 4), Err(RowsError::Ragged { numbers: 9, width: 4 }));
    assert_eq!(row(&[0.0; 9], 0), Err(RowsError::Ragged { numbers: 9, width: 0 }));
    assert_eq!(row(&[0.0; 10], 5), Err(RowsError::Width { width: 5 }));
    let reason = ConfigurationError::HitchWithoutTrailer;
    assert_eq!(row(&[0.0; 9], 3), Err(RowsError::Row { row: 0, reason }));
    let mut numbers = [0.0; 12];
    numbers[10] = f64::INFINITY;
    let reason = ConfigurationError::NotFinite;
    assert_eq!(row(&numbers, 4), Err(RowsError::Row { row: 2, reason }), "the third row, from 0");
    // of every width each number counts, in the first row, within and in the last one
    fn each_number<R: Robot>(robot: &R, width: usize) {
        for at in 0..5 * width {
            let mut numbers = vec![0.5; 5 * width];
            assert_eq!(Rows::new(robot, &numbers, width).map(|rows| rows.len()), Ok(5));
            numbers[at] = f64::NAN;
            let reason = ConfigurationError::NotFinite;
            let refused = Rows::new(robot, &numbers, width).map(|rows| rows.len());
            assert_eq!(refused, Err(RowsError::Row { row: at / width, reason }), "number {at}");
        }
    }
    each_number(&RustyDisc::default(), 2);
    each_number(&RUSTY, 3);
    each_number(&HITCH, 3);
    each_number(&car, 4);
    each_number(&Reach::<1> { base: Point2::new(0.0, 0.0), lengths: [1.0], link_radius: 0.1 }, 1);
    each_number(&Reach::<5> { base: Point2::new(0.0, 0.0), lengths: [1.0; 5], link_radius: 0.1 }, 5);
}

#[test]
fn a_part_of_rows_is_those_of_its_range_that_there_are() {
    let disc = Checker::new(block(), RustyDisc::default());
    let numbers: Vec<f64> = (0..20).map(|i| f64::from(i) * 0.3).collect();
    let rows = Rows::new(disc.robot(), &numbers, 2).unwrap();
    let distances = |rows: &Rows<'_, RustyDisc>| {
        let mut found = vec![0.0; rows.len()];
        disc.distances_into(rows, &mut found).unwrap();
        found
    };
    let all = distances(&rows);
    assert_eq!(distances(&rows.part(3..7)), all[3..7]);
    assert_eq!(distances(&rows.part(8..99)), all[8..]);
    assert_eq!(distances(&rows.part(3..8).part(1..3)), all[4..6]);
    assert!(
        rows.part(4..4).is_empty() && rows.part(10..12).is_empty() && rows.part(usize::MAX - 1..usize::MAX).is_empty()
    );
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
