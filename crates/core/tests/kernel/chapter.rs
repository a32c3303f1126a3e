//! The chapter's worked numbers (table N) about kinematics, collision and the range sensor, under the chapter's names.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

use motion_lab_core::collision::{ChainChecker, Collision, Scene};
use motion_lab_core::configuration::{T2, Tn};
use motion_lab_core::geometry::{Footprint, Point2, Segment, Shape};
use motion_lab_core::num::{cos, sin};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{RUSTY, Reach, Robot};
use motion_lab_core::sensors::RangeSensor;

use oracle::fixtures::{PLANE, apartment, workbench};

/// The block alone, and the whole Workbench, in which the block is the nearest obstacle.
fn blocks() -> [Scene; 2] {
    let block = Shape::try_rectangle(Point2::new(0.5, 1.0), Point2::new(1.0, 1.5)).unwrap();
    [Scene::empty(PLANE).with_obstacle("the block", block), workbench()]
}

fn wall_scene() -> Scene {
    Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))])
}

fn assert_near(p: Point2, x: f64, y: f64, tolerance: f64) {
    assert!((p.x - x).abs() <= tolerance && (p.y - y).abs() <= tolerance, "{p} is not ({x}, {y})");
}

#[test]
fn fk_matches_choset_example() {
    let points = Reach::<2>::choset().fk(&T2::new(FRAC_PI_4, FRAC_PI_2));
    assert_near(points[1], FRAC_1_SQRT_2, FRAC_1_SQRT_2, 1e-12);
    assert_near(points[2], 0.0, SQRT_2, 1e-12);
}

#[test]
fn reach_distance_to_square() {
    let q = T2::new(FRAC_PI_4, FRAC_PI_2);
    for scene in blocks() {
        let thin = Reach::<2>::choset().footprint(&q);
        assert!(!scene.intersects(&thin));
        assert!((scene.distance(&thin) - (1.5 / SQRT_2 - 1.0)).abs() < 1e-9);
        let w = scene.witness(&thin).unwrap();
        assert_near(w.on_obstacle, 0.5, 1.0, 1e-6);
        assert_near(w.on_robot, FRAC_1_SQRT_2 - 0.25, FRAC_1_SQRT_2 + 0.25, 1e-6);
        assert_eq!((w.part, scene.obstacle_name(w.obstacle)), (1, Some("the block")));
        // thicker by the radius, nearer by exactly that
        let thick = Reach::<2>::workbench().footprint(&q);
        assert!((scene.distance(&thick) - (1.5 / SQRT_2 - 1.0 - 0.03)).abs() < 1e-9);
    }
}

#[test]
fn first_contact_with_the_block_is_where_the_link_points_at_its_corner() {
    let cases = [(Reach::<2>::choset(), 1.4008779), (Reach::<2>::workbench(), 1.4846065)];
    for scene in blocks() {
        for (arm, expected) in cases {
            let distance = |th2: f64| scene.distance(&arm.footprint(&T2::new(FRAC_PI_4, th2)));
            let (mut contact, mut free) = (1.3, FRAC_PI_2);
            assert!(distance(contact) == 0.0 && distance(free) > 0.0);
            while free - contact > 1e-12 {
                let middle = 0.5 * (contact + free);
                if distance(middle) == 0.0 {
                    contact = middle;
                } else {
                    free = middle;
                }
            }
            assert!((contact - expected).abs() < 1e-6, "first contact at {contact}");
            // from there on it stays 0, until the link has swept the whole block. The block's last corner (1, 1) lies
            // straight ahead of link 1, so the sweep ends at theta2 = 0, where a link without thickness just touches it
            let n = 20_000;
            for i in 0..n {
                let th2 = contact * f64::from(n - i) / f64::from(n);
                assert_eq!(distance(th2), 0.0, "theta2 = {th2}");
                let footprint = arm.footprint(&T2::new(FRAC_PI_4, th2));
                assert!(scene.intersects(&footprint) && scene.witness(&footprint).is_some_and(|w| w.dist == 0.0));
            }
            // before the contact it falls all the way
            let mut last = 0.0;
            for i in 1..=1000 {
                let d = distance(contact + (FRAC_PI_2 - contact) * f64::from(i) / 1000.0);
                assert!(d > last, "the distance falls towards the contact");
                last = d;
            }
        }
    }
}

#[test]
fn rusty_wall_distance() {
    let rusty = Footprint::disc(Point2::new(2.0, 1.0), RUSTY.body_radius);
    assert!((wall_scene().distance(&rusty) - 0.89).abs() < 1e-12);
    let w = wall_scene().witness(&rusty).unwrap();
    assert_eq!(w.on_obstacle, Point2::new(3.0, 1.0));
    assert_near(w.on_robot, 2.11, 1.0, 1e-12);
}

#[test]
fn scan_is_rho_r() {
    let least = |scan: &[f64]| scan.iter().fold(f64::INFINITY, |m, &r| if r < m { r } else { m });
    let scan = RangeSensor { n_rays: 360, max_range: 4.0 }.scan(&wall_scene(), Point2::new(2.0, 1.0));
    assert_eq!(scan.len(), 360);
    assert!((least(&scan) - 1.0).abs() < 1e-9);
    assert!((scan[0] - 1.0).abs() < 1e-9, "ray 0 points at the nearest point");
    // no ray from any point reads less than the point's distance
    let mut s = Stream::new(Seed(91), "tests/rho");
    for scene in [wall_scene(), apartment()] {
        for _ in 0..200 {
            let p = Point2::new(s.uniform(0.0, 12.0), s.uniform(0.0, 8.0));
            let scan = RangeSensor { n_rays: 360, max_range: 20.0 }.scan(&scene, p);
            let point = scene.distance(&Footprint::disc(p, 0.0));
            assert!(least(&scan) >= point - 1e-12, "{} < {point} at {p}", least(&scan));
        }
    }
}

#[test]
fn ik_roundtrip() {
    let arm = Reach::<2>::choset();
    let mut s = Stream::new(Seed(92), "tests/ik");
    for _ in 0..1000 {
        let q = T2::new(s.uniform(-PI, PI), s.uniform(-PI, PI));
        let tip = arm.tip(&q);
        for solution in arm.ik(tip) {
            let solution = solution.expect("strictly inside the annulus");
            assert!((arm.tip(&solution) - tip).norm() < 1e-9, "{q} {solution}");
        }
    }
}

#[test]
fn swept_catches_midpoint() {
    let checker = ChainChecker::new(workbench(), Reach::<2>::workbench());
    let (a, b) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
    assert!(checker.is_free(&a) && checker.is_free(&b));
    assert!(!checker.edge_free(&a, &b) && !checker.edge_free(&b, &a));
}

#[test]
fn exercise_3_predicts_a_witness() {
    let square = Shape::try_rectangle(Point2::new(0.9, 0.9), Point2::new(1.1, 1.1)).unwrap();
    let scene = Scene::empty(PLANE).with_obstacle("the square", square);
    let arm = Reach::<2>::choset();
    let inside = arm.footprint(&T2::new(0.0, FRAC_PI_2));
    assert_eq!((scene.distance(&inside), scene.intersects(&inside)), (0.0, true));
    let turned = arm.footprint(&T2::new(0.0, FRAC_PI_2 + 0.3));
    let expected = 0.9 * sin(0.3) - 0.1 * cos(0.3);
    assert!((expected - 0.170434537).abs() < 1e-9);
    assert!((scene.distance(&turned) - expected).abs() < 1e-9);
    assert_near(scene.witness(&turned).unwrap().on_obstacle, 0.9, 0.9, 1e-6);
}

#[test]
fn exercise_5_the_tip_stays_while_the_arm_moves() {
    let arm = Reach::<3>::redundant();
    let mut s = Stream::new(Seed(95), "tests/null space");
    let start = Tn([0.3, 0.9, 0.8]);
    let tip = arm.tip(&start);
    let mut walk = vec![start];
    while walk.len() < 200 {
        let th1 = walk[walk.len() - 1].0[0] + s.uniform(-0.2, 0.2);
        // a step out of reach is not taken
        let elbow = s.below(2) as usize;
        walk.extend(arm.with_tip_at(tip, th1)[elbow]);
    }
    for q in &walk {
        assert!((arm.tip(q) - tip).norm() < 1e-9, "{q}");
    }
    let (low, high) = walk
        .iter()
        .fold((PI, -PI), |(l, h), q| (if q.0[0] < l { q.0[0] } else { l }, if q.0[0] > h { q.0[0] } else { h }));
    assert!(high - low > 0.5, "theta1 varies: from {low} to {high}");
}
