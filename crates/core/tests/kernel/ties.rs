//! Exact ties go to the lowest part, then to the first obstacle in file order, by every index of the scene and every
//! query.
//!
//! Every distance here comes from whole numbers: discs 5 m off by triangles with sides 3, 4 and 5, and squares of
//! distances compared as integers.

use motion_lab_core::collision::{Checker, HitBy, ObstacleId, Surroundings};
use motion_lab_core::num::sqrt;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::ConfigurationError;

use oracle::fixtures::{Body, footprint_of, placed, scene_of};

/// Points exactly 5 m from the origin. The boxes of discs about them are not all equally near.
const RING: [[i32; 2]; 12] =
    [[5, 0], [3, 4], [-4, 3], [0, -5], [4, -3], [-5, 0], [-3, -4], [0, 5], [-3, 4], [3, -4], [4, 3], [-4, -3]];

fn disc([x, y]: [i32; 2], radius: f64) -> Body {
    (Pose2 { x: f64::from(x), y: f64::from(y), theta: 0.0 }, Shape::Disc { radius })
}

/// Discs far from everything: none, few, many spread evenly, many in one place. So the scene finds the nearest in a
/// list, in a grid and in a tree.
fn fillers() -> [Vec<Body>; 4] {
    let spread = |n: i32| (0..n).map(|i| disc([60 + 10 * (i % 10), 60 + 10 * (i / 10)], 0.5)).collect();
    [vec![], spread(40), spread(90), vec![disc([80, 80], 0.5); 90]]
}

/// The scene of these bodies amid the fillers, with the number of the first of them.
fn amid(bodies: &[Body], fillers: &[Body]) -> (Scene, u32) {
    let (before, after) = fillers.split_at(fillers.len() / 2);
    (scene_of(&[before, bodies, after].concat()), before.len() as u32)
}

#[test]
fn of_equally_near_obstacles_the_first_in_file_order_is_the_witness() {
    for fillers in fillers() {
        for first in 0..RING.len() {
            let mut ring = RING;
            ring.rotate_left(first);
            let (scene, id) = amid(&ring.map(|at| disc(at, 1.0)), &fillers);
            let unit = Vector2::new(f64::from(ring[0][0]), f64::from(ring[0][1])) / 5.0;

            let apart = footprint_of(&[disc([0, 0], 1.0)]);
            let w = scene.witness(&apart).unwrap();
            assert_eq!((w.dist, w.part, w.obstacle, scene.distance(&apart)), (3.0, 0, ObstacleId(id), 3.0), "{ring:?}");
            assert!((w.on_robot.coords - unit).norm() < 1e-15 && (w.on_obstacle.coords - unit * 4.0).norm() < 4e-15);
            assert!(!scene.intersects(&apart) && scene.touched(&apart).is_empty());

            // touching all twelve at once, and overlapping them
            for radius in [4.0, 4.5] {
                let robot = footprint_of(&[disc([0, 0], radius)]);
                let w = scene.witness(&robot).unwrap();
                assert_eq!((w.dist, w.part, w.obstacle, scene.distance(&robot)), (0.0, 0, ObstacleId(id), 0.0));
                assert!(scene.intersects(&robot) && w.on_robot == w.on_obstacle);
                assert_eq!(scene.touched(&robot), (id..id + 12).map(ObstacleId).collect::<Vec<_>>());
            }
        }
    }
}

#[test]
fn of_equally_near_parts_the_lowest_is_the_witness_whatever_the_file_order() {
    // the first obstacle is as near to the second part as the second obstacle is to the first
    let bodies = [disc([25, 0], 1.0), disc([-25, 0], 1.0)];
    for fillers in fillers() {
        let (scene, id) = amid(&bodies, &fillers);
        for (radius, dist) in [(1.0, 3.0), (4.0, 0.0)] {
            let w = scene.witness(&footprint_of(&[disc([-20, 0], radius), disc([20, 0], radius)])).unwrap();
            assert_eq!((w.dist, w.part, w.obstacle), (dist, 0, ObstacleId(id + 1)));
            let w = scene.witness(&footprint_of(&[disc([20, 0], radius), disc([-20, 0], radius)])).unwrap();
            assert_eq!((w.dist, w.part, w.obstacle), (dist, 0, ObstacleId(id)));
        }
    }
}

#[test]
fn other_robots_come_after_the_obstacles_and_in_their_order_but_parts_first_of_all() {
    let place = |at: [i32; 2]| placed(&disc(at, 1.0));
    let (near, far) = (scene_of(&[disc([5, 0], 1.0), disc([0, 5], 1.0)]), scene_of(&[disc([50, 0], 1.0)]));
    let others = [place([30, 0]), place([-3, 4]), place([-4, -3])];
    let robot = footprint_of(&[disc([0, 0], 1.0)]);
    let ask = |scene: &Scene, robot: &Footprint| {
        let surroundings = Surroundings { scene, others: &others };
        let w = surroundings.witness(robot).unwrap();
        assert_eq!(surroundings.distance(robot), w.dist);
        assert_eq!(surroundings.intersects(robot), w.dist == 0.0);
        (w.dist, w.part, w.obstacle.0)
    };
    assert_eq!(ask(&near, &robot), (3.0, 0, 0), "as near as two others, but an obstacle");
    assert_eq!(ask(&far, &robot), (3.0, 0, 2), "the second of the others, after one obstacle");
    for (radius, dist) in [(1.0, 3.0), (4.0, 0.0)] {
        // part 0 is near an other, part 1 near an obstacle, and the reverse
        let (west, east) = (disc([-8, -6], radius), disc([10, 0], radius));
        assert_eq!(ask(&near, &footprint_of(&[west.clone(), east.clone()])), (dist, 0, 4));
        assert_eq!(ask(&near, &footprint_of(&[east, west])), (dist, 0, 0));
    }
}

#[test]
fn batches_answer_as_integers_do_in_their_order() {
    let bodies = RING.map(|at| disc(at, 1.0));
    let lattice: Vec<[i32; 2]> = (-9..=9).flat_map(|x| (-9..=9).map(move |y| [x, y])).collect();
    let qs: Vec<R2> = lattice.iter().map(|[x, y]| R2::new(f64::from(*x), f64::from(*y))).collect();
    for fillers in fillers() {
        let checker = Checker::new(amid(&bodies, &fillers).0, RustyDisc { radius: 1.0 });
        // a configuration is free exactly where no centre is within the two radii, 2 m
        let squares: Vec<i32> = lattice
            .iter()
            .map(|p| RING.iter().map(|c| (p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1])).min().unwrap())
            .collect();
        let free: Vec<bool> = squares.iter().map(|square| *square > 4).collect();
        assert!(squares.iter().filter(|square| **square == 4).count() >= 12, "touches are among them");
        assert_eq!(checker.are_free(&qs), free);
        for ((square, free), distance) in squares.iter().zip(&free).zip(checker.distances(&qs)) {
            let expected = if *free { sqrt(f64::from(*square)) - 2.0 } else { 0.0 };
            assert!((distance - expected).abs() < 1e-14 && (distance == 0.0) != *free, "{distance}, not {expected}");
        }
        let still: Vec<(R2, R2)> = qs.iter().map(|q| (*q, *q)).collect();
        assert!(checker.edges(&still).iter().map(|v| v.unwrap().is_free()).eq(free), "on the spot");
    }
    // an invalid edge gives an error at its own place
    let at = |trailer| HitchCfg { body: Pose2::IDENTITY, trailer };
    let (with, without) = (at(Some(0.0)), at(None));
    let pairs = [(with, with), (with, without), (without, without), (with, with)];
    let verdicts = Checker::new(scene_of(&[disc([50, 0], 1.0)]), HITCH.with_trailer()).edges(&pairs);
    let errors: Vec<Option<ConfigurationError>> = verdicts.iter().map(|v| v.err()).collect();
    let none_given = Some(ConfigurationError::HitchWithoutTrailer);
    assert_eq!(errors, [None, none_given, none_given, None]);
}

#[test]
fn an_edge_that_meets_two_obstacles_at_once_hits_the_first_in_file_order() {
    for fillers in fillers() {
        // a disc meets two posts too close to pass between: the sum of the radii is 5 and the posts are 3 to either
        // side, so contact is 4 before them
        for posts in [[[20, 3], [20, -3]], [[20, -3], [20, 3]]] {
            let (scene, id) = amid(&posts.map(|at| disc(at, 2.5)), &fillers);
            let checker = Checker::new(scene, RustyDisc { radius: 2.5 });
            let pairs = [(R2::new(0.0, 0.0), R2::new(32.0, 0.0)); 3];
            for verdict in checker.edges(&pairs) {
                assert_hits(verdict.unwrap(), 16.0 / 32.0, 32.0, id);
            }
        }
        // the front of a car, 3.2 m ahead of its axle, against two posts: at 8.3 m
        for posts in [[0.5, -0.5], [-0.5, 0.5]] {
            let post = |y: f64| (Pose2 { x: 12.0, y, theta: 0.0 }, Shape::Disc { radius: 0.5 });
            let (scene, id) = amid(&posts.map(post), &fillers);
            let at = |x: f64| HitchCfg { body: Pose2::new(x, 0.0, 0.0), trailer: None };
            let verdicts = Checker::new(scene, HITCH).edges(&[(at(0.0), at(16.0)), (at(16.0), at(0.0))]);
            assert_hits(verdicts[0].unwrap(), 8.3 / 16.0, 16.0, id);
            // on the way back from beyond them, the rear, 0.7 m behind the axle, meets them at 13.2 m
            assert_hits(verdicts[1].unwrap(), 2.8 / 16.0, 16.0, id);
        }
    }
}

/// Fails unless the verdict is a hit of this obstacle by part 0 with the contact at `at` in a bracket of a micrometre.
#[track_caller]
fn assert_hits(verdict: EdgeVerdict, at: f64, length: f64, id: u32) {
    let EdgeVerdict::Hit { free_until, contact_at, part, by } = verdict else { panic!("{verdict:?}") };
    assert_eq!((part, by), (0, HitBy::Obstacle(ObstacleId(id))));
    assert!(free_until < at && at <= contact_at && (contact_at - free_until) * length <= 1e-6, "{verdict:?}, not {at}");
}

/// 108 points with whole coordinates lie on the circle of radius 1105 = 5 * 13 * 17 about the origin (Gauss). Pins
/// there are equally near to the bit, in any order, and more than any list of candidates holds.
#[test]
fn of_a_hundred_equally_near_the_first_in_file_order_is_the_witness() {
    let on_circle = |x: i32| (-1105..=1105).filter(move |y| x * x + y * y == 1105 * 1105).map(move |y| (x, y));
    let places: Vec<(i32, i32)> = (-1105..=1105).flat_map(on_circle).collect();
    assert_eq!(places.len(), 108);
    let (scale, radius) = (1.0 / 64.0, 0.125);
    for first in 0..places.len() {
        // every 11th from this one on; 11 has no divisor in common with 108
        let order = (0..places.len()).map(|k| places[(first + 11 * k) % places.len()]);
        let scene = order.enumerate().fold(Scene::of_walls(&[]), |scene, (k, (x, y))| {
            let pose = Pose2::new(f64::from(x) * scale, f64::from(y) * scale, 0.0);
            scene.with_obstacle_at(&format!("pin {k}"), pose, Shape::Disc { radius })
        });
        let witness = scene.witness(&Footprint::disc(Point2::origin(), 0.25)).unwrap();
        let (x, y) = places[first];
        assert_eq!(
            (witness.obstacle, witness.dist),
            (ObstacleId(0), 1105.0 * scale - radius - 0.25),
            "({x}, {y}) is first"
        );
    }
}
