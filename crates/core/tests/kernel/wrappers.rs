//! Wrappers of a scene: checkers, counters, surroundings and references answer as the scene does.

use motion_lab_core::collision::{Collision, Counted, DiscChecker, ObstacleId, QueryCounts, Scene, Surroundings};
use motion_lab_core::geometry::{Footprint, Placed, Point2, Segment};
use motion_lab_core::robots::RustyDisc;

/// A wall along x = 3, from y = 0 to 3.
fn wall() -> Scene {
    Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))])
}

fn disc(x: f64) -> Footprint {
    Footprint::disc(Point2::new(x, 1.0), 0.25)
}

/// Asks every question twice, once for each answer.
#[track_caller]
fn assert_passes_on(asked: &dyn Collision) {
    // beside the wall, and touching it; the numbers are exact
    assert_eq!([1.0, 2.75].map(|x| asked.intersects(&disc(x))), [false, true]);
    assert_eq!([1.0, 2.75].map(|x| asked.distance(&disc(x))), [1.75, 0.0]);
    let witness = asked.witness(&disc(1.0)).unwrap();
    assert_eq!((witness.on_robot, witness.on_obstacle), (Point2::new(1.25, 1.0), Point2::new(3.0, 1.0)));
    assert_eq!((witness.dist, witness.part, witness.obstacle), (1.75, 0, ObstacleId(0)));
    // short of the wall, and through it from free to free
    assert_eq!([2.5, 5.0].map(|x| asked.swept(&disc(1.0), &disc(x))), [false, true]);
}

/// Asks for the distance of a hull and for a separation test, for wrappers that take any part.
#[track_caller]
fn assert_passes_on_hooks(asked: &dyn Collision) {
    let hull = |x: f64| Placed::new([Point2::new(x, 1.0), Point2::new(x, 2.0)], 0.25);
    assert_eq!([1.0, 2.75].map(|x| asked.distance_of_hull(hull(x))), [1.75, 0.0]);
    // moved to x = 2.5 the part keeps 0.25 m from the wall
    assert_eq!([0.2, 0.3].map(|reach| asked.clears(&hull(1.0), &hull(2.5), reach)), [true, false]);
}

#[test]
fn whoever_asks_a_scene_gets_its_answers() {
    assert_passes_on(&wall());
    assert_passes_on(&DiscChecker::new(wall(), RustyDisc { radius: 0.25 }));
    assert_passes_on(&Surroundings { scene: &wall(), others: &[] });
    let counted = Counted::new(wall());
    assert_passes_on(&counted);
    assert_passes_on_hooks(&counted);
    assert_passes_on_hooks(&Surroundings { scene: &wall(), others: &[] });
    let each = QueryCounts { intersects: 2, distance: 2, distance_of_hull: 2, clears: 2, witness: 1, swept: 2 };
    assert_eq!(counted.counts(), each);
}

#[test]
fn further_shapes_are_asked_as_well() {
    // the wall is another robot's part here, and the scene is empty
    let others = [Placed::new([Point2::new(3.0, 0.0), Point2::new(3.0, 3.0)], 0.0)];
    let around = Surroundings { scene: &Scene::of_walls(&[]), others: &others };
    assert_passes_on(&around);
    assert_passes_on_hooks(&around);
}

#[test]
fn a_disc_checker_takes_discs_only() {
    let checker = DiscChecker::new(wall(), RustyDisc { radius: 0.25 });
    let checker: &dyn Collision = &checker;
    let arm = Footprint::capsules([Segment::new(Point2::new(0.0, 1.0), Point2::new(1.0, 1.0))], 0.1);
    assert!(checker.intersects(&arm) && checker.distance(&arm) == 0.0 && checker.witness(&arm).is_none());
    assert!(checker.swept(&arm, &arm));
}
