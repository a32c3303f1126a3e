//! Undecidable queries count as contact, and a scene without obstacles is never hit.

use motion_lab_core::collision::{Collision, DiscChecker, Scene};
use motion_lab_core::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape};
use motion_lab_core::robots::RustyDisc;

use motion_lab_core::random::{Seed, Stream};
use oracle::fixtures::{KINDS, PLANE, footprint_of, lattice_shape, scene_of};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Footprints of each kind of shape with one number that is not finite, in the pose or in the shape.
fn bad_footprints() -> Vec<Footprint> {
    let mut s = Stream::new(Seed(41), "tests/failsafe");
    let mut all = Vec::new();
    for kind in KINDS {
        let (pose, shape) = lattice_shape(&mut s, kind, 5).body(1.0);
        for bad in BAD {
            for pose in [Pose2 { x: bad, ..pose }, Pose2 { y: bad, ..pose }, Pose2 { theta: bad, ..pose }] {
                all.push(Footprint::new([Part::new(pose, shape.clone())]));
            }
        }
    }
    let o = Point2::origin();
    for bad in BAD {
        let (p, x) = (Point2::new(bad, 0.0), Point2::new(1.0, bad));
        let shapes = [
            Shape::Disc { radius: bad },
            Shape::Segment { a: o, b: p },
            Shape::Capsule { a: x, b: o, radius: 0.1 },
            Shape::Capsule { a: o, b: Point2::new(1.0, 0.0), radius: bad },
            Shape::Rectangle { min: o, max: x },
        ];
        all.extend(shapes.map(|shape| Footprint::new([Part::new(Pose2::IDENTITY, shape)])));
    }
    all.push(Footprint::disc(o, -0.5));
    // one bad part spoils the whole footprint, wherever it is in the list
    let good = Part::new(Pose2::IDENTITY, Shape::Disc { radius: 0.1 });
    let bad = Part::new(Pose2 { x: f64::NAN, y: 0.0, theta: 0.0 }, Shape::Disc { radius: 0.1 });
    all.push(Footprint::new([good.clone(), bad.clone()]));
    all.push(Footprint::new([bad, good]));
    all
}

fn far_away() -> Scene {
    Scene::of_walls(&[Segment::new(Point2::new(400.0, 0.0), Point2::new(400.0, 3.0))])
}

#[test]
fn a_footprint_that_is_not_finite_is_in_contact_in_every_answer() {
    let fine = Footprint::disc(Point2::origin(), 0.1);
    let checker = DiscChecker::new(far_away(), RustyDisc::default());
    for scene in [far_away(), Scene::empty(PLANE)] {
        assert!(!scene.intersects(&fine), "the finite one is free, so the answers below say something");
        for footprint in bad_footprints() {
            for collision in [&scene as &dyn Collision, &checker] {
                assert!(collision.intersects(&footprint), "{footprint:?}");
                assert_eq!(collision.distance(&footprint), 0.0, "{footprint:?}");
                assert_eq!(collision.witness(&footprint), None, "{footprint:?}");
                assert!(collision.swept(&footprint, &footprint), "{footprint:?}");
                assert!(collision.swept(&footprint, &fine) && collision.swept(&fine, &footprint), "{footprint:?}");
            }
        }
    }
}

#[test]
fn an_obstacle_that_is_not_a_shape_is_in_contact_with_everything() {
    let far = Footprint::disc(Point2::new(-30.0, 20.0), 0.1);
    for bad in BAD {
        let shapes = [
            Shape::Disc { radius: bad },
            Shape::Segment { a: Point2::new(bad, 0.0), b: Point2::origin() },
            Shape::Rectangle { min: Point2::origin(), max: Point2::new(1.0, bad) },
        ];
        for shape in shapes {
            for scene in
                [far_away().with_obstacle("broken", shape.clone()), Scene::empty(PLANE).with_obstacle("b", shape)]
            {
                assert!(scene.intersects(&far) && scene.distance(&far) == 0.0 && scene.swept(&far, &far));
                assert_eq!(scene.witness(&far).map(|w| w.dist), Some(0.0));
            }
        }
    }
}

#[test]
fn sweeps_between_different_part_lists_are_hits() {
    let scene = far_away();
    let disc = |r| Footprint::disc(Point2::origin(), r);
    let wall = [Segment::new(Point2::origin(), Point2::new(1.0, 0.0))];
    let two = Footprint::capsules([wall[0], wall[0]], 0.1);
    assert!(!scene.swept(&disc(0.1), &disc(0.1)));
    assert!(scene.swept(&disc(0.1), &disc(0.2)), "another radius");
    assert!(scene.swept(&disc(0.1), &Footprint::capsules(wall, 0.1)), "another kind");
    assert!(scene.swept(&Footprint::capsules(wall, 0.1), &two) && scene.swept(&two, &Footprint::capsules(wall, 0.1)));
}

#[test]
fn nothing_is_ever_hit_in_an_empty_scene() {
    let scene = Scene::empty(PLANE);
    let mut s = Stream::new(Seed(42), "tests/empty");
    for kind in KINDS {
        let a = footprint_of(&[lattice_shape(&mut s, kind, 5).body(1.0)]);
        let b = {
            let (pose, shape) = (a.parts()[0].pose(), a.parts()[0].shape().clone());
            Footprint::new([Part::new(Pose2::new(pose.x + 3.0, pose.y - 90.0, 2.0), shape)])
        };
        assert!(!scene.intersects(&a) && !scene.swept(&a, &a) && !scene.swept(&a, &b));
        assert_eq!(scene.distance(&a), f64::INFINITY);
        assert_eq!(scene.witness(&a), None);
        assert_eq!(scene.depth(&a), 0.0);
    }
    // the bounds are no obstacle: a sweep goes across them and beyond
    assert!(!scene.swept(&Footprint::disc(Point2::origin(), 1.0), &Footprint::disc(Point2::new(900.0, 0.0), 1.0)));
}

#[test]
fn a_footprint_without_parts_is_nowhere() {
    let (scene, nothing) = (scene_of(&[(Pose2::IDENTITY, Shape::Disc { radius: 1.0 })]), Footprint::default());
    assert!(!scene.intersects(&nothing) && !scene.swept(&nothing, &nothing));
    assert_eq!((scene.distance(&nothing), scene.witness(&nothing)), (f64::INFINITY, None));
}
