//! Scans of every shape that a world may have, against rays cast by the textbook.

use std::f64::consts::{PI, TAU};

use motion_lab_core::num::sin_cos;
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use oracle::seen::{CONCAVE, KINDS, Seen, Tally, UNION, check, thing, world_of};

#[test]
fn every_shape_is_seen_where_it_stands_from_any_place_and_heading() {
    let mut s = Stream::new(Seed(111), "tests/scan shapes");
    for kind in 0..KINDS {
        let mut tally = Tally::default();
        for case in 0..40 {
            let frame = Pose2::new(s.uniform(-2.0, 2.0), s.uniform(-2.0, 2.0), s.uniform(-PI, PI));
            let things = thing(kind, &frame, s.uniform(0.4, 1.6));
            // the things stand in the world, or are another robot's parts
            let (scene, others) = if case % 2 == 0 || kind == CONCAVE {
                (Scene::of_world(&world_of(&things, kind == UNION)), vec![])
            } else {
                let parts = things.iter().map(Seen::body).map(|(pose, shape)| shape.place(&pose)).collect();
                (Scene::of_walls(&[]), parts)
            };
            let sensor = RangeSensor { n_rays: [7, 36, 61, 90][case % 4], max_range: [2.0, 6.0, 20.0][case % 3] };
            let mut place = || Point2::new(s.uniform(-3.5, 3.5), s.uniform(-3.5, 3.5));
            let mut places: Vec<Point2> = (0..5).map(|_| place()).collect();
            if kind > 0 {
                places.extend((0..9999).map(|_| place()).find(|p| things.iter().any(|t| t.holds(*p))));
            }
            for (i, p) in places.into_iter().enumerate() {
                let pose = Pose2 { x: p.x, y: p.y, theta: 2.9 * i as f64 - 0.37 * case as f64 };
                check(&things, sensor.max_range, &pose, &sensor.scan_from(&scene, &others, &pose), &mut tally);
            }
        }
        assert!(tally.hits > tally.rays / 30 && tally.grazed <= tally.rays / 500, "kind {kind}: {tally:?}");
        assert!(kind == 0 || tally.inside > tally.rays / 10, "kind {kind}: {tally:?}");
    }
}

#[test]
fn ray_k_looks_at_the_bearing_of_2_pi_k_over_n_counter_clockwise_from_the_heading() {
    let mut s = Stream::new(Seed(112), "tests/scan shapes");
    let nothing = Scene::of_walls(&[]);
    for n in (1..=20).chain([33, 64, 100, 359, 360, 361]) {
        for _ in 0..6 {
            let pose = Pose2 { x: s.uniform(-50.0, 50.0), y: s.uniform(-50.0, 50.0), theta: s.uniform(-9.0, 9.0) };
            let ray = s.below(n.into()) as usize;
            let (sin, cos) = sin_cos(pose.theta + TAU * ray as f64 / f64::from(n));
            // a post two metres off, so thin that the neighbouring rays miss it
            let radius = if n < 3 { 0.3 } else { 0.4 * sin_cos(PI / f64::from(n)).0 };
            let post = Shape::Disc { radius }.place(&Pose2::new(pose.x + 2.0 * cos, pose.y + 2.0 * sin, 0.0));
            let ranges = RangeSensor { n_rays: n, max_range: 9.0 }.scan_from(&nothing, &[post], &pose);
            for (k, range) in ranges.iter().enumerate() {
                let right = if k == ray { (range - (2.0 - radius)).abs() < 1e-9 } else { range.is_infinite() };
                assert!(right, "ray {k} of {n} reads {range}, and the post is at ray {ray} from {pose:?}");
            }
        }
    }
}
