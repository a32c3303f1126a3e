//! The system that runs every range sensor's scan.

use bevy::prelude::*;

use super::crowds::{Crowds, stand};
use super::parallel::each;
use crate::run::RobotScan;
use crate::simulation::sensors::roster::RunSensor;
use crate::simulation::sensors::scanners::{Desk, Scanners};
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
    let mut roster = std::mem::take(&mut *roster);
    let SensorRoster { sensors, scanners, copies, .. } = &mut roster;
    let mut scans = std::mem::take(&mut world.resource_mut::<LatestFrame>().0.scans);
    scans.resize_with(sensors.len(), || RobotScan { robot: 0, ranges: Vec::new() });
    // the memory of the sensors' components, so that each is filled while its scan is at hand
    copies.clear();
    copies.extend(sensors.iter().map(|sensor| {
        world.get_mut::<Scan>(sensor.entity).map_or_else(Vec::new, |mut scan| std::mem::take(&mut scan.0))
    }));
    let (now, scanners): (&World, &Scanners) = (world, scanners);
    let work = sensors.iter().zip(scans.iter_mut().zip(copies.iter_mut()));
    each(
        work,
        || scanners.desk(),
        |borrowed, (sensor, (kept, copy))| {
            _ = scan(now, sensor, &mut borrowed.desk, kept);
            copy.clone_from(&kept.ranges);
        },
    );
    for (sensor, copy) in sensors.iter().zip(copies) {
        if let Some(mut scan) = world.get_mut::<Scan>(sensor.entity) {
            scan.0 = std::mem::take(copy);
        }
    }
    world.resource_mut::<LatestFrame>().0.scans = scans;
    *world.resource_mut::<SensorRoster>() = roster;
}

/// Runs one sensor's scan, into the memory of its last one. `None` where its robot is gone, which changes nothing.
fn scan(world: &World, sensor: &RunSensor, desk: &mut Desk, RobotScan { robot, ranges }: &mut RobotScan) -> Option<()> {
    let rays = sensor.rays.sensor;
    *robot = sensor.id;
    ranges.resize(rays.n_rays as usize, 0.0);
    let pose = sensor.pose(world)?;
    let scene = &world.get::<WorldScene>(world.get::<ResidesIn>(sensor.robot)?.0)?.0;
    let (scanner, room) = desk.at(sensor.fan, sensor.rays);
    match world.resource::<Crowds>().of(RobotId(sensor.id)) {
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
