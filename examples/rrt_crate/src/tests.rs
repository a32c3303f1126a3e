//! What the program prints is pinned, and its paths are checked by other means than the library's.

use std::f64::consts::{PI, TAU};

use motion_lab::geometry::Placed;
use motion_lab::num::{cos, sin};
use motion_lab::prelude::*;

use crate::{plain, reach, report, rusty, solve, sweep};

/// The short way from `a` to `b`, radians.
fn short(a: f64, b: f64) -> f64 {
    let d = (b - a) % TAU;
    if d > PI {
        d - TAU
    } else if d <= -PI {
        d + TAU
    } else {
        d
    }
}

fn obstacles(scene: &Scene) -> Vec<Placed> {
    scene.pieces().map(|(_, piece)| piece.clone()).collect()
}

/// The least clearance of the Workbench's arm along a path, by its kinematics written out and the oracle's distances.
fn arm_clearance(path: &[T2]) -> f64 {
    let at = |a: T2, b: T2, s: f64| {
        let (th1, th2) = (a.0[0] + s * short(a.0[0], b.0[0]), a.0[1] + s * short(a.0[1], b.0[1]));
        let elbow = Point2::new(cos(th1), sin(th1));
        let tip = Point2::new(elbow.x + cos(th1 + th2), elbow.y + sin(th1 + th2));
        [(Point2::origin(), elbow), (elbow, tip)]
            .map(|(a, b)| Shape::Capsule { a, b, radius: 0.03 }.place(&Pose2::IDENTITY))
            .to_vec()
    };
    let scene = obstacles(&Scene::workbench());
    let edge = |ends: &[T2]| {
        let speed = 2.0 * short(ends[0].0[0], ends[1].0[0]).abs() + short(ends[0].0[1], ends[1].0[1]).abs();
        sweep::clearance(|s| at(ends[0], ends[1], s), speed, &scene, sweep::MICROMETRE).at_most
    };
    path.windows(2).map(edge).fold(f64::INFINITY, |m, c| if c < m { c } else { m })
}

#[test]
fn the_crate_rrt() {
    let (text, figure) = report().unwrap();
    assert_eq!(text, include_str!("../printed.txt"));
    assert_eq!(report().unwrap(), (text, figure.clone()), "every draw comes from a seeded stream");
    assert!(figure.starts_with("<svg") && figure.contains("the goal"));

    let reach = solve(reach().unwrap(), 0.8).unwrap();
    assert_eq!((reach.path[0], *reach.path.last().unwrap()), (T2::new(2.0, 0.0), T2::new(-3.0, 0.0)));
    let found = arm_clearance(&reach.path);
    assert!(found > 0.0 && found >= reach.clearance - 1e-9, "{found} is below the proven {}", reach.clearance);

    let rusty = solve(rusty().unwrap(), 0.8).unwrap();
    let place = |name| World::apartment().place(name).unwrap().pose.position();
    assert_eq!((rusty.path[0].0, rusty.path.last().unwrap().0), (place("room A"), place("room E")));
    let scene = obstacles(&Scene::apartment());
    for ends in rusty.path.windows(2) {
        // a disc on a straight edge is a capsule
        let swept = Shape::Capsule { a: ends[0].0, b: ends[1].0, radius: 0.11 }.place(&Pose2::IDENTITY);
        let found =
            scene.iter().map(|o| plain::distance(&swept, o)).fold(f64::INFINITY, |m, d| if d < m { d } else { m });
        assert!(found > 0.0 && found >= rusty.clearance - 1e-9, "{found} is below the proven {}", rusty.clearance);
    }
}
