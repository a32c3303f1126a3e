//! The frames of reference, by name: the lab, its worlds side by side, the robots in them, the robots' parts.

use crate::simulation::RobotView;
use motion_lab_core::geometry::{Pose2, Shape};
use motion_lab_core::worlds::World;

use super::message::FrameTransform;

/// The frame that all others lie in.
const LAB: &str = "lab";
/// Gap between two worlds, metres.
const GAP: f64 = 1.0;

/// A world's frame.
pub fn of_world(world: &World) -> String {
    format!("world/{}", world.name)
}

/// A robot's frame.
pub fn of_robot(name: &str) -> String {
    format!("robot/{name}")
}

/// The frame of a robot's part.
pub fn of_part(name: &str, part: usize) -> String {
    format!("part/{part}/{name}")
}

/// Where the worlds lie in the lab: in a row, bottoms level.
pub fn worlds(tick: u64, worlds: &[World]) -> Vec<FrameTransform> {
    let mut left = 0.0;
    let mut place = |world: &World| {
        let (min, max) = (world.bounds.min, world.bounds.max);
        let pose = Pose2 { x: left - min.x, y: -min.y, theta: 0.0 };
        left += max.x - min.x + GAP;
        FrameTransform::of(tick, LAB.to_owned(), of_world(world), &pose)
    };
    worlds.iter().map(&mut place).collect()
}

/// Where a robot and its parts lie in their world.
pub fn robot(tick: u64, world: &World, robot: &RobotView) -> Vec<FrameTransform> {
    let transform = |child, pose: &Pose2| FrameTransform::of(tick, of_world(world), child, pose);
    let parts = robot.footprint.parts();
    let parts_frames = parts.iter().enumerate().map(|(k, part)| transform(of_part(&robot.name, k), part.pose()));
    let base = base(robot).map(|pose| transform(of_robot(&robot.name), &pose));
    base.into_iter().chain(parts_frames).collect()
}

/// Whether a robot has the parts that it had, wherever they are.
pub fn same_parts(before: &RobotView, now: &RobotView) -> bool {
    let (before, now) = (before.footprint.parts(), now.footprint.parts());
    before.len() == now.len() && before.iter().zip(now).all(|(old, new)| old.shape() == new.shape())
}

/// The pose of a robot's body: that of its first part. A disc looks the same from all sides, so its heading is taken
/// from the configuration.
fn base(robot: &RobotView) -> Option<Pose2> {
    let part = robot.footprint.parts().first()?;
    let theta = match (part.shape(), robot.coordinates.get(2)) {
        (Shape::Disc { .. }, Some(theta)) => *theta,
        _ => part.pose().theta,
    };
    Some(Pose2 { theta, ..*part.pose() })
}
