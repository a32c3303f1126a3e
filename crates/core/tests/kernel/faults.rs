//! The known faults of the chapter's printed code: each naive version is written out here and seen to fail, where the
//! library does not.

use motion_lab_core::collision::{CarChecker, ChainChecker, Checker, Collision, DiscChecker, EdgeVerdict, Scene};
use motion_lab_core::configuration::{Configuration, HitchCfg, R2, T2, Tn};
use motion_lab_core::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape};
use motion_lab_core::num::hypot;
use motion_lab_core::robots::{HITCH, Reach, Robot, RustyDisc};

use oracle::fixtures::PLANE;

/// The chapter's `swept`: each part is cast from its first pose along the displacement of its frame, without turning.
/// (Sampled finely here. An exact version would miss the same.)
fn swept_by_translation(scene: &Scene, a: &Footprint, b: &Footprint) -> bool {
    (0..=1000).any(|i| {
        let s = f64::from(i) / 1000.0;
        let parts = a.parts().iter().zip(b.parts()).map(|(p, q)| {
            let along = (q.pose().position() - p.pose().position()) * s;
            Part::new(Pose2 { x: p.pose().x + along.x, y: p.pose().y + along.y, ..*p.pose() }, p.shape().clone())
        });
        scene.intersects(&Footprint::new(parts))
    })
}

/// The chapter's `edge_free`: steps of `max(d / L, step_min)` in the parameter.
fn march_with_a_minimum_step<R: Robot>(
    checker: &Checker<R>,
    a: &R::Configuration,
    b: &R::Configuration,
    lipschitz: f64,
    step_min: f64,
) -> bool {
    if !checker.is_free(a) || !checker.is_free(b) {
        return false;
    }
    let mut s = 0.0;
    while s < 1.0 {
        let d = checker.distance(&a.interpolate(b, s).unwrap());
        if d <= 0.0 {
            return false;
        }
        let step = d / lipschitz;
        s += if step > step_min { step } else { step_min };
    }
    true
}

fn square(name: &str, center: Point2, half: f64) -> Scene {
    let corner = |sign: f64| Point2::new(center.x + sign * half, center.y + sign * half);
    Scene::empty(PLANE).with_obstacle(name, Shape::try_rectangle(corner(-1.0), corner(1.0)).unwrap())
}

#[test]
fn a_rotating_link_between_two_free_poses_is_caught_where_a_translation_cast_misses_it() {
    let scene = square("the post", Point2::new(-0.6, 0.4), 0.1);
    // one link turns about its base, so that its frame does not move
    let arm = Reach { base: Point2::origin(), lengths: [1.0], link_radius: 0.03 };
    let (a, b) = (Tn([2.0]), Tn([3.1]));
    let (fa, fb) = (arm.footprint(&a), arm.footprint(&b));
    assert!(!scene.intersects(&fa) && !scene.intersects(&fb));
    assert!(!swept_by_translation(&scene, &fa, &fb), "the naive cast would see it: the test says nothing");
    assert!(scene.swept(&fa, &fb) && scene.swept(&fb, &fa));
    let checker = ChainChecker::new(scene, arm);
    assert!(matches!(checker.edge(&a, &b).unwrap(), EdgeVerdict::Hit { part: 0, .. }));
    assert!(!checker.edge_free(&b, &a));
}

#[test]
fn a_thin_wall_is_not_jumped_by_a_minimum_step() {
    // Approached at a slant, so that the naive march creeps up to the wall until its minimum step is the larger one.
    let wall = Segment::new(Point2::new(0.0, -20.0), Point2::new(0.0, 20.0));
    let checker = DiscChecker::new(Scene::of_walls(&[wall]), RustyDisc { radius: 0.01 });
    let mut naive_free = 0;
    for k in 0..20 {
        let rise = 10.0 + 0.1 * f64::from(k);
        let (a, b) = (R2::new(-10.0, -rise), R2::new(10.0, rise));
        let length = (b.0 - a.0).norm();
        naive_free += u32::from(march_with_a_minimum_step(&checker, &a, &b, length, 1.0 / 256.0));
        assert!(!checker.edge_free(&a, &b), "through the wall from {a} to {b}");
        let (from, to) = (checker.robot().footprint(&a), checker.robot().footprint(&b));
        assert!(checker.scene().swept(&from, &to), "through the wall from {a} to {b}");
    }
    assert!(naive_free > 0, "the naive march jumped none of the walls: the test says nothing");
}

#[test]
fn a_pure_trailer_rotation_is_seen_though_the_body_stands_still() {
    let towing = HITCH.with_trailer();
    // the post is behind the car, within the trailer's reach: the trailer swings from one side of it to the other
    let scene = square("a post", Point2::new(-2.4, 0.0), 0.05);
    let checker = CarChecker::new(scene, towing);
    let at = |psi: f64| HitchCfg { body: Pose2::IDENTITY, trailer: Some(psi) };
    let (a, b) = (at(-0.8), at(0.8));
    assert!(checker.is_free(&a) && checker.is_free(&b), "free on either side");
    assert!(!checker.is_free(&at(0.0)), "and not half way");
    // the chapter's bound: translation plus the body's circumscribed radius times the body's turn, which is 0 here
    let difference = a.difference(&b).unwrap();
    let bound = hypot(difference[0], difference[1]) + 3.4 * difference[2].abs();
    assert_eq!(bound, 0.0);
    assert!(march_with_a_minimum_step(&checker, &a, &b, bound, 1e-3), "the naive march would see it");
    assert!(matches!(checker.edge(&a, &b).unwrap(), EdgeVerdict::Hit { part: 1, .. }));
    let (from, to) = (checker.robot().footprint(&a), checker.robot().footprint(&b));
    assert!(checker.scene().swept(&from, &to));
}

#[test]
fn links_without_thickness_that_cross_a_wall_are_at_distance_exactly_zero_at_any_angle() {
    // The naive distance is the least over end points and segments, without a test whether they cross.
    let arm = Reach::<2>::choset();
    let wall = Segment::new(Point2::new(0.75, -3.0), Point2::new(0.75, 3.0));
    let scene = Scene::of_walls(&[wall]);
    let mut crossings = 0;
    for i in 0..2000 {
        let q = T2::new(-0.7 + 0.0007 * f64::from(i), 0.3);
        let tip = arm.tip(&q);
        if tip.x > 0.75 {
            crossings += 1;
            let footprint = arm.footprint(&q);
            assert_eq!(scene.distance(&footprint), 0.0, "{q:?}");
            let points = arm.fk(&q);
            let naive =
                points.iter().map(|p| (wall.closest_point(*p) - p).norm()).fold(1.0, |m, d| if d < m { d } else { m });
            assert!(naive > 0.0, "the naive distance would be 0, too");
        }
    }
    assert!(crossings > 1000);
}
