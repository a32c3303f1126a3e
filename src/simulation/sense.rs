//! The system that lets every range sensor scan.

use bevy::prelude::*;

use super::starts::others_now;
use super::{MountedOn, ResidesIn, RobotId, RobotOps, Scan, SensorModel, WorldScene};

/// Scans from where the robots are now. A sensor sees the obstacles and the other robots of its world, not its own robot.
pub(super) fn sense(world: &mut World) {
    let mut sensors = world.query::<(Entity, &SensorModel, &MountedOn)>();
    let scans: Vec<(Entity, Vec<f64>)> = sensors
        .iter(world)
        .filter_map(|(sensor, SensorModel(model), &MountedOn(robot))| {
            let pose = (world.get::<RobotOps>(robot)?.sensor_pose)(world, robot)?;
            let inhabited = world.get::<ResidesIn>(robot)?.0;
            let others = others_now(world, inhabited, *world.get::<RobotId>(robot)?);
            Some((sensor, model.scan_from(&world.get::<WorldScene>(inhabited)?.0, &others, &pose)))
        })
        .collect();
    for (sensor, ranges) in scans {
        if let Some(mut scan) = world.get_mut::<Scan>(sensor) {
            scan.0 = ranges;
        }
    }
}
