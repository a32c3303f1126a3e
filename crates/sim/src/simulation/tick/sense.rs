//! The system that runs every range sensor's scan.

use std::sync::Arc;

use bevy::prelude::*;

use super::parallel::each;
use super::world_crowds::{WorldCrowds, stand};
use crate::run::RobotScan;
use crate::simulation::sensors::roster::RunSensor;
use crate::simulation::sensors::scanners::{ScanMemory, Scanners};
use crate::simulation::{LatestFrame, ResidesIn, RobotId, Scan, SensorRoster, Transport, WorldScene};

/// Scans from where the robots are now, outside a tick.
pub(crate) fn sense_now(world: &mut World) {
    stand(world);
    sense(world);
}

/// Scans from where the robots are at the end of the tick, into the frame. A sensor sees the obstacles and the other
/// robots of its world, not its own robot. A noisy sensor's readings are drawn anew for the tick, from its own stream.
pub(crate) fn sense(world: &mut World) {
    let Some(mut roster) = world.get_resource_mut::<SensorRoster>() else { return };
    let mut roster = std::mem::replace(&mut *roster, SensorRoster::none());
    let SensorRoster { sensors, scanners, .. } = &mut roster;
    let mut scans = std::mem::take(&mut world.resource_mut::<LatestFrame>().0.scans);
    scans.resize_with(sensors.len(), || RobotScan { robot: 0, ranges: Arc::default() });
    // the components let go of the ranges that they share with the frame, which are then overwritten in place
    for sensor in &*sensors {
        hand_over(world, sensor, Arc::default());
    }
    let (now, scanners): (&World, &Scanners) = (world, scanners);
    each(
        sensors.iter().zip(&mut scans),
        || scanners.desk(),
        |borrowed, (sensor, kept)| _ = scan(now, sensor, &mut borrowed.desk, kept),
    );
    for (sensor, kept) in sensors.iter().zip(&scans) {
        hand_over(world, sensor, kept.ranges.clone());
    }
    world.resource_mut::<LatestFrame>().0.scans = scans;
    *world.resource_mut::<SensorRoster>() = roster;
}

/// Gives a sensor's component its ranges.
fn hand_over(world: &mut World, sensor: &RunSensor, ranges: Arc<[f64]>) {
    if let Some(mut scan) = world.get_mut::<Scan>(sensor.entity) {
        scan.0 = ranges;
    }
}

/// Runs one sensor's scan, into the memory of its last one unless another frame holds it. `None` where its robot is
/// gone, which changes nothing.
fn scan(
    world: &World,
    sensor: &RunSensor,
    desk: &mut ScanMemory,
    RobotScan { robot, ranges }: &mut RobotScan,
) -> Option<()> {
    let rays = sensor.rays.sensor;
    *robot = sensor.id;
    if ranges.len() != rays.n_rays as usize {
        *ranges = vec![0.0; rays.n_rays as usize].into();
    }
    let pose = sensor.pose(world)?;
    let scene = &world.get::<WorldScene>(world.get::<ResidesIn>(sensor.robot)?.0)?.0;
    let ranges = Arc::make_mut(ranges);
    let (scanner, room) = desk.at(sensor.fan, sensor.rays);
    match world.resource::<WorldCrowds>().of(RobotId(sensor.id)) {
        Some(crowd) => {
            let others = crowd.seen(sensor.id, pose.position(), rays.max_range, room);
            scanner.scan_among(scene, others, &pose, ranges);
        }
        None => scanner.scan_into(scene, &[], &pose, ranges),
    }
    if let Some((noise, stream)) = &sensor.noise {
        noise.apply_to(&rays, ranges, stream, world.resource::<Transport>().tick);
    }
    Some(())
}
