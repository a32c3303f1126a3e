//! Scans against the exact oracle, and the guarantees of a scanner.

use std::f64::consts::TAU;

use motion_lab_core::collision::{RowsError, Scene};
use motion_lab_core::num::{cos, sin};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::{Instructions, RangeSensor, Scanner};

use oracle::fixtures::count_from_env;
use oracle::ray::{Lattice, holds_origin, meets, whole};

/// Rays from lattice points into lattice walls: through their ends, along them, past them. `MOTION_LAB_RAYS` sets their
/// number.
#[test]
fn lattice_rays_hit_exactly_what_they_should() {
    let rays = count_from_env("MOTION_LAB_RAYS", 100_000);
    let mut draws = Stream::new(Seed(21), "tests/scans");
    let (mut cast, mut hit, mut grazed) = (0, 0, 0);
    let mut sets = Instructions::available().into_iter().cycle();
    while cast < rays {
        let n_rays = [8, 16, 40, 360][draws.below(4) as usize];
        let size = 4 + 8 * draws.below(2);
        let mut point = || (draws.below(size) as i128, draws.below(size) as i128);
        let walls: Vec<(Lattice, Lattice)> = (0..6).map(|_| (point(), point())).filter(|(a, b)| a != b).collect();
        let from = point();
        let near = |p: Lattice| (p.0 - from.0, p.1 - from.1);
        let f = |p: Lattice| Point2::new(p.0 as f64, p.1 as f64);
        let scene = Scene::of_walls(&walls.iter().map(|(a, b)| Segment::new(f(*a), f(*b))).collect::<Vec<_>>());
        let sensor = RangeSensor { n_rays, max_range: 1e3 };
        let mut scanner = Scanner::with_instructions(sensor, sets.next().unwrap());
        let mut ranges = vec![0.0; n_rays as usize];
        scanner.scan_into(&scene, &[], &Pose2 { x: f(from).x, y: f(from).y, theta: 0.0 }, &mut ranges);
        cast += u64::from(n_rays);
        if walls.iter().any(|(a, b)| holds_origin(near(*a), near(*b))) {
            assert!(ranges.iter().all(|r| *r == 0.0), "{from:?} is on a wall of {walls:?}");
            continue;
        }
        for (k, &range) in ranges.iter().enumerate() {
            let (x, y) = sensor.direction(k as u32);
            let bearing = TAU * k as f64 / f64::from(n_rays);
            let ahead = (x - cos(bearing)).abs() < 4e-15 && (y - sin(bearing)).abs() < 4e-15;
            assert!(ahead, "ray {k} of {n_rays} looks along {x}, {y}");
            let direction = whole((x, y)).expect("no component is that small");
            let met = walls.iter().filter_map(|(a, b)| meets(near(*a), near(*b), direction));
            let exact = met.fold(f64::INFINITY, |m, t| if t < m { t } else { m });
            let right = range == exact || (range - exact).abs() <= 1e-12 * exact;
            assert!(right, "ray {k} of {n_rays} from {from:?} into {walls:?}: {range}, but exactly {exact}");
            hit += usize::from(exact.is_finite());
            let at_end = |p: Lattice| near(p).0 * direction.1 == near(p).1 * direction.0;
            grazed += usize::from(walls.iter().any(|(a, b)| at_end(*a) || at_end(*b)));
        }
    }
    assert!(hit as u64 > rays / 4 && grazed as u64 > rays / 50, "{hit} hits, {grazed} through an end point, of {cast}");
}

#[test]
fn many_scans_at_once_are_the_single_ones_in_order() {
    let scene = Scene::apartment();
    let sensor = RangeSensor { n_rays: 37, max_range: 4.0 };
    let mut draws = Stream::new(Seed(22), "tests/scans");
    let poses: Vec<Pose2> = (0..100)
        .map(|_| Pose2::new(draws.uniform(0.0, 12.0), draws.uniform(0.0, 8.0), draws.uniform(-3.0, 3.0)))
        .collect();
    let all = sensor.scans(&scene, &poses);
    assert_eq!(all.len(), 37 * 100);
    for (pose, ranges) in poses.iter().zip(all.chunks(37)) {
        assert_eq!(ranges, sensor.scan_from(&scene, &[], pose));
    }
    let mut places = vec![7.0; 37 * 100];
    sensor.scans_into(&scene, &poses, &mut places).unwrap();
    assert_eq!(places, all);
    let few = sensor.scans_into(&scene, &poses[1..], &mut places);
    assert_eq!(few, Err(RowsError::Places { answers: 37 * 99, places: 37 * 100 }));
}

#[test]
fn a_scanner_allocates_nothing_after_its_first_scans() {
    let walls: Vec<Segment> = (0..300)
        .map(|i| {
            let (x, y) = (f64::from(i % 20), f64::from(i / 20));
            Segment::new(Point2::new(x, y + 0.2), Point2::new(x + 0.5, y))
        })
        .collect();
    let other = Footprint::disc(Point2::new(3.0, 3.0), 0.2).parts()[0].placed().clone();
    for scene in [Scene::apartment(), Scene::of_walls(&walls)] {
        let mut scanner = Scanner::new(RangeSensor { n_rays: 360, max_range: 4.0 });
        let mut ranges = [0.0; 360];
        let mut scan = |k: u32| {
            let pose = Pose2::new(6.1 + 0.01 * f64::from(k), 4.3, f64::from(k));
            scanner.scan_into(&scene, std::slice::from_ref(&other), &pose, &mut ranges);
        };
        // a small scene lists what is seen from where, after some scans from each square
        (0..400).for_each(|k| scan(k % 50));
        let counted = allocation_counter::measure(|| (1..50).for_each(&mut scan)).count_total;
        assert_eq!(counted, 0);
    }
}
