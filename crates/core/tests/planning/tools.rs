//! Jacobians, gradients and tied witnesses, compared with the oracle's answers.

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::num::{cos, sin};
use motion_lab_core::robots::AnyRobot;

use super::*;
use oracle::plain;

/// The clearance of a robot at these coordinates, by the oracle's distances of its footprint.
fn clearance(checker: &Checker<AnyRobot>, like: &AnyConfiguration, at: &[f64]) -> f64 {
    let footprint = checker.robot().footprint(&like.with_coordinates(at).unwrap());
    let pieces = obstacles(checker.scene());
    let pairs =
        footprint.parts().iter().flat_map(|part| pieces.iter().map(|piece| plain::distance(part.placed(), piece)));
    pairs.fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

#[test]
fn the_gradient_in_the_chart_is_that_of_the_clearance() {
    const H: f64 = 1e-6;
    let mut s = Stream::new(Seed(25), "gradients");
    for (kind, count, scene) in [
        ("rusty", 3, Scene::apartment()),
        ("reach", 2, Scene::workbench()),
        ("reach3", 3, Scene::workbench()),
        ("hitch", 3, Scene::lot()),
        ("hitch", 4, Scene::lot()),
    ] {
        let (robot, _) = AnyRobot::of_kind(kind, &vec![0.0; count]).unwrap();
        let checker = Checker::new(scene, robot);
        let (bounds, mut agreed) = (checker.scene().bounds(), 0);
        for _ in 0..200 {
            let q = robot.sample(bounds.min, bounds.max, &mut s);
            let (distance, Some(gradient)) = checker.chart_gradient(&q).unwrap() else { continue };
            assert!((distance - clearance(&checker, &q, &q.coordinates())).abs() < 1e-12);
            let slope = |i: usize| {
                let at = |h: f64| {
                    let mut moved = q.coordinates();
                    moved[i] += h;
                    clearance(&checker, &q, &moved)
                };
                [(at(H) - at(0.0)) / H, (at(0.0) - at(-H)) / H]
            };
            let slopes: Vec<[f64; 2]> = (0..count).map(slope).collect();
            // where two points are as near, the clearance has a kink and no gradient
            if slopes.iter().all(|[right, left]| (right - left).abs() < 1e-3) {
                agreed += 1;
                for (i, [right, left]) in slopes.iter().enumerate() {
                    let middle = 0.5 * (right + left);
                    assert!(
                        (gradient[i] - middle).abs() < 1e-4,
                        "{kind} {q}, coordinate {i}: {} {middle}",
                        gradient[i]
                    );
                }
            }
        }
        assert!(agreed > 40, "{kind}: {agreed}");
    }
}

#[test]
fn the_jacobian_of_the_tip_is_that_of_the_written_out_kinematics() {
    let arm = Reach::<3>::redundant();
    let tip = |[a, b, c]: [f64; 3]| {
        let (x, y) = (a, a + b);
        let z = y + c;
        Point2::new(0.6 * cos(x) + 0.5 * cos(y) + 0.4 * cos(z), 0.6 * sin(x) + 0.5 * sin(y) + 0.4 * sin(z))
    };
    let mut s = Stream::new(Seed(26), "jacobian");
    for _ in 0..200 {
        let q = [0.0; 3].map(|_: f64| s.uniform(-3.0, 3.0));
        let columns = arm.tip_jacobian(&Tn(q));
        for joint in 0..3 {
            let (mut more, mut less) = (q, q);
            (more[joint], less[joint]) = (q[joint] + 1e-5, q[joint] - 1e-5);
            let difference = (tip(more) - tip(less)) / 2e-5;
            assert!((difference - columns[joint]).norm() < 1e-9, "joint {joint}");
        }
    }
}

#[test]
fn tied_witnesses_are_all_that_the_oracle_finds_as_near() {
    let mut s = Stream::new(Seed(27), "ties");
    let (mut single, mut tied) = (0, 0);
    for (kind, count, scene) in [("rusty", 3, Scene::apartment()), ("hitch", 4, Scene::lot())] {
        let (robot, _) = AnyRobot::of_kind(kind, &vec![0.0; count]).unwrap();
        let bounds = scene.bounds();
        for i in 0..150 {
            let footprint = robot.footprint(&robot.sample(bounds.min, bounds.max, &mut s));
            let slack = if i % 2 == 0 { 0.0 } else { 0.3 };
            // for every part and obstacle the distance of its nearest piece, by the oracle
            let mut all: Vec<(usize, motion_lab_core::collision::ObstacleId, f64)> = Vec::new();
            for (part, shape) in footprint.parts().iter().enumerate() {
                for (obstacle, piece) in scene.pieces() {
                    let dist = plain::distance(shape.placed(), piece);
                    match all.iter_mut().find(|known| (known.0, known.1) == (part, obstacle)) {
                        Some(known) if dist < known.2 => known.2 = dist,
                        Some(_) => {}
                        None => all.push((part, obstacle, dist)),
                    }
                }
            }
            let least = all.iter().fold(f64::INFINITY, |m, known| if known.2 < m { known.2 } else { m });
            let found = scene.witnesses(&footprint, slack);
            for tie in &found {
                let (_, _, dist) = all.iter().find(|known| (known.0, known.1) == (tie.part, tie.obstacle)).unwrap();
                assert!((tie.dist - dist).abs() < 1e-12 && *dist <= least + slack + 1e-12);
                assert!(((tie.on_robot - tie.on_obstacle).norm() - tie.dist).abs() < 1e-12);
            }
            let sure = all.iter().filter(|known| known.2 < least + slack - 1e-9).count();
            let possible = all.iter().filter(|known| known.2 < least + slack + 1e-9).count();
            assert!((sure..=possible).contains(&found.len()), "{} of {sure} to {possible}", found.len());
            assert!(found.windows(2).all(|pair| (pair[0].part, pair[0].obstacle) < (pair[1].part, pair[1].obstacle)));
            (single, tied) = (single + u32::from(found.len() == 1), tied + u32::from(found.len() > 1));
        }
    }
    assert!(single > 50 && tied > 50, "{single} {tied}");
    // half way between two walls, exactly
    let walls = [-1.0, 1.0].map(|y| Segment::new(Point2::new(-5.0, y), Point2::new(5.0, y)));
    let ties = |y: f64, slack: f64| {
        let disc = Footprint::disc(Point2::new(0.0, y), 0.25);
        Scene::of_walls(&walls).witnesses(&disc, slack).iter().map(|tie| tie.on_obstacle.y).collect::<Vec<_>>()
    };
    assert_eq!(ties(0.0, 0.0), [-1.0, 1.0]);
    assert_eq!(ties(0.125, 0.0), [1.0]);
    assert_eq!(ties(0.125, 0.25), [-1.0, 1.0], "the slack itself counts");
    assert_eq!(ties(0.125, f64::NAN), [1.0]);
    assert!(Scene::of_walls(&walls).witnesses(&Footprint::disc(Point2::new(f64::NAN, 0.0), 0.1), 1.0).is_empty());
}
