//! The system that runs every range sensor's scan.

use bevy::prelude::*;

use super::starts::others_now;
use crate::simulation::sensors::roster::RunSensor;
use crate::simulation::{ResidesIn, RobotId, Scan, SensorRoster, Transport, WorldScene};

/// Scans from where the robots are now. A sensor sees the obstacles and the other robots of its world, not its own
/// robot. A noisy sensor's readings are drawn anew for the tick, from its own stream.
pub(crate) fn sense(world: &mut World) {
    let Some(mut roster) = world.get_resource_mut::<SensorRoster>() else { return };
    let mut roster = std::mem::take(&mut *roster);
    for sensor in &mut roster.sensors {
        scan(world, sensor);
    }
    *world.resource_mut::<SensorRoster>() = roster;
}

/// Runs one sensor's scan, into the memory of its last one.
fn scan(world: &mut World, sensor: &mut RunSensor) -> Option<()> {
    let pose = sensor.pose(world)?;
    let inhabited = world.get::<ResidesIn>(sensor.robot)?.0;
    let others = others_now(world, inhabited, *world.get::<RobotId>(sensor.robot)?);
    let RunSensor { rays, noise, scanner, ranges, .. } = sensor;
    scanner.scan_into(&world.get::<WorldScene>(inhabited)?.0, &others, &pose, ranges);
    if let Some((noise, stream)) = noise {
        *ranges = noise.apply(&rays.sensor, ranges, stream, world.resource::<Transport>().tick);
    }
    world.get_mut::<Scan>(sensor.entity)?.0.clone_from(&sensor.ranges);
    Some(())
}
