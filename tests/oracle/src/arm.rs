//! The Workbench's arm along a path, by its kinematics written out.

use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::T2;
use motion_lab_core::geometry::{Placed, Point2, Pose2, Shape};
use motion_lab_core::num::{cos, sin};

use crate::{short, sweep};

/// The obstacles of a scene, piece by piece.
pub fn obstacles(scene: &Scene) -> Vec<Placed> {
    scene.pieces().map(|(_, piece)| piece.clone()).collect()
}

/// The least clearance of the Workbench's arm along a path, by its kinematics written out and the oracle's distances.
pub fn arm_clearance(path: &[T2]) -> f64 {
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
