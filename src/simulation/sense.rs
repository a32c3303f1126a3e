//! The system that lets every range sensor scan.

use bevy::prelude::*;

use super::starts::others_now;
use super::{MountedOn, ResidesIn, RobotId, RobotOps, Scan, SensorModel, SensorNoise, Transport, WorldScene};

/// Scans from where the robots are now. A sensor sees the obstacles and the other robots of its world, not its own robot.
/// A noisy sensor's readings are drawn anew for the tick, from its own stream.
pub(super) fn sense(world: &mut World) {
    let tick = world.resource::<Transport>().tick;
    let mut sensors = world.query::<(Entity, &SensorModel, &MountedOn, Option<&SensorNoise>)>();
    let scans: Vec<(Entity, Vec<f64>)> = sensors
        .iter(world)
        .filter_map(|(sensor, SensorModel(model), &MountedOn(robot), noise)| {
            let pose = (world.get::<RobotOps>(robot)?.sensor_pose)(world, robot)?;
            let inhabited = world.get::<ResidesIn>(robot)?.0;
            let others = others_now(world, inhabited, *world.get::<RobotId>(robot)?);
            let exact = model.scan_from(&world.get::<WorldScene>(inhabited)?.0, &others, &pose);
            let ranges = match noise {
                Some(SensorNoise { model: noise, stream }) => noise.apply(model, &exact, stream, tick),
                None => exact,
            };
            Some((sensor, ranges))
        })
        .collect();
    for (sensor, ranges) in scans {
        if let Some(mut scan) = world.get_mut::<Scan>(sensor) {
            scan.0 = ranges;
        }
    }
}
