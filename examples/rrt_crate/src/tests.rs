//! The program's output is pinned, and its paths are checked by other means than the library's.

use motion_lab_core::prelude::*;

use oracle::arm::{arm_clearance, obstacles};
use oracle::plain;

use crate::{reach, report, rusty, solve};

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
