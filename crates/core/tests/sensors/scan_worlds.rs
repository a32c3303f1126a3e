//! Scans of whole worlds: thousands of pieces near the largest coordinates, mirrored worlds, and the Apartment, whose
//! rooms A and C are mirror images of each other (SPEC W1).

use std::f64::consts::PI;

use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;

use oracle::fixtures::{Body, apartment, scene_of};
use oracle::seen::{CONCAVE, KINDS, Seen, Tally, UNION, check, thing, things_of, world_of};

#[test]
fn thousands_of_pieces_are_seen_one_by_one_out_to_the_limit_of_the_coordinates() {
    let mut s = Stream::new(Seed(113), "tests/scan worlds");
    // the centre of their square, its reach, the size of the things, and the range of the sensor
    let worlds = [(Point2::new(9_960.0, -9_950.0), 30.0, 0.3, 12.0), (Point2::origin(), 9_900.0, 60.0, 4_000.0)];
    for (centre, reach, size, max_range) in worlds {
        let mut place = |theta: f64| Pose2 {
            x: s.uniform(centre.x - reach, centre.x + reach),
            y: s.uniform(centre.y - reach, centre.y + reach),
            theta: theta * s.uniform(-1.0, 1.0),
        };
        let kinds = (0..KINDS).filter(|kind| ![CONCAVE, UNION].contains(kind)).cycle();
        let things: Vec<Seen> = kinds.take(2000).flat_map(|kind| thing(kind, &place(PI), size)).collect();
        let scene = scene_of(&things.iter().map(Seen::body).collect::<Vec<Body>>());
        let sensor = RangeSensor { n_rays: 90, max_range };
        let poses: Vec<Pose2> = (0..5).map(|_| place(9.0)).collect();
        let mut tally = Tally::default();
        for (pose, ranges) in poses.iter().zip(sensor.scans(&scene, &poses).chunks(90)) {
            check(&things, max_range, pose, ranges, &mut tally);
        }
        assert!(tally.hits > 150 && tally.grazed < 4, "{tally:?}");
    }
}

/// Whether two readings agree.
fn same(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= 1e-9
}

#[test]
fn a_mirrored_world_and_sensor_give_the_mirrored_scan() {
    let mut s = Stream::new(Seed(114), "tests/scan mirror");
    let (mut seen, mut rays) = (0, 0);
    for case in 0..60 {
        let mut place = |reach: f64| Pose2::new(s.uniform(-reach, reach), s.uniform(-reach, reach), s.uniform(-PI, PI));
        let things: Vec<Seen> = (0..3).flat_map(|i| thing((case + 3 * i) % KINDS, &place(3.0), 0.8)).collect();
        // the plane's image in the y axis; the rays of the mirrored sensor go round the other way
        let image: Vec<Seen> = things.iter().map(|t| t.map(|p| Point2::new(-p.x, p.y))).collect();
        let [scene, mirrored] = [&things, &image].map(|things| Scene::of_world(&world_of(things, case % 2 == 0)));
        let sensor = RangeSensor { n_rays: [7, 36, 61][case % 3], max_range: 5.0 };
        let n = sensor.n_rays as usize;
        for _ in 0..6 {
            let pose = place(4.0);
            let there = Pose2 { x: -pose.x, y: pose.y, theta: PI - pose.theta };
            let (here, there) = (sensor.scan_from(&scene, &[], &pose), sensor.scan_from(&mirrored, &[], &there));
            for (k, &a) in here.iter().enumerate() {
                let b = there[(n - k) % n];
                assert!(same(a, b), "ray {k} of {n} from {pose:?} reads {a}, in the mirror {b}: {things:?}");
            }
            rays += n;
            seen += here.iter().filter(|r| r.is_finite() && **r > 0.0).count();
        }
    }
    assert!(seen > rays / 8 && seen < rays, "{seen} of {rays}");
}

/// Checks that the scans from a pose and from its image in the line x = 6 are mirror images. Returns the number of rays
/// that hit.
fn mirrored(scene: &Scene, sensor: RangeSensor, pose: &Pose2, image: &Pose2) -> usize {
    let n = sensor.n_rays as usize;
    let (a, c) = (sensor.scan_from(scene, &[], pose), sensor.scan_from(scene, &[], image));
    for (k, &here) in a.iter().enumerate() {
        let there = c[(n - k) % n];
        assert!(same(here, there), "ray {k} of {n} from {pose} reads {here}, from {image} {there}");
    }
    a.iter().filter(|r| r.is_finite() && **r > 0.0).count()
}

/// From the two rooms' own places no ray of 37 or 359 goes through a corner. Of 360 rays one does: ray 90 in room A
/// meets the wardrobe's corner. Its image goes past the corner's image, because the heading there can't be pi but only
/// the `f64` below it.
#[test]
fn the_scan_from_room_a_is_the_reversed_scan_from_the_mirrored_place_in_room_c() {
    let (scene, world) = (apartment(), World::apartment());
    let [a, c] = ["room A", "room C"].map(|name| world.place(name).unwrap().pose);
    assert_eq!((12.0 - a.x, a.y, PI - a.theta), (c.x, c.y, c.theta), "they are mirror images");
    let mut hits = 0;
    for (n_rays, max_range) in [(37, 4.0), (359, 4.0), (359, 20.0)] {
        hits += mirrored(&scene, RangeSensor { n_rays, max_range }, &a, &c);
    }
    assert!(hits > 600, "{hits}");
    // anywhere in the two rooms, at whole multiples of 2^-10 m, whose images are exact
    let mut s = Stream::new(Seed(115), "tests/rooms");
    let (mut hits, mut zeros) = (0, 0);
    for i in 0..60 {
        let mut part = |from: f64, to: f64| (1024.0 * s.uniform(from, to)).round() / 1024.0;
        let (x, y) = (part(0.0, 4.0), part(4.75, 8.0));
        let pose = Pose2 { x, y, theta: s.uniform(-PI, PI) };
        let image = Pose2 { x: 12.0 - x, y, theta: PI - pose.theta };
        let sensor = RangeSensor { n_rays: [360, 91][i % 2], max_range: [4.0, 20.0][i / 2 % 2] };
        let seen = mirrored(&scene, sensor, &pose, &image);
        hits += seen;
        zeros += usize::from(seen == 0);
    }
    assert!(hits > 5_000 && zeros > 0, "{hits} hits, {zeros} times inside the furniture");
}

#[test]
fn the_three_worlds_are_seen_as_their_files_have_them() {
    let mut s = Stream::new(Seed(116), "tests/three worlds");
    for name in World::built_in_names() {
        let world = World::built_in(name).unwrap();
        let (things, scene) = (things_of(&world), Scene::of_world(&world));
        let (min, max) = (world.bounds.min, world.bounds.max);
        let mut tally = Tally::default();
        for max_range in [1.5, 4.0, 20.0].repeat(6) {
            let pose = Pose2::new(s.uniform(min.x, max.x), s.uniform(min.y, max.y), s.uniform(-PI, PI));
            let sensor = RangeSensor { n_rays: 180, max_range };
            check(&things, max_range, &pose, &sensor.scan_from(&scene, &[], &pose), &mut tally);
        }
        assert!(tally.hits > 180 && tally.grazed < 6, "{name}: {tally:?}");
    }
}
