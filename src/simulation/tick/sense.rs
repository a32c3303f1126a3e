//! The system that runs every range sensor's scan.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::starts::others_now;
use crate::simulation::{
    ResidesIn, RobotId, RobotOps, Roster, Scan, SensorModel, SensorNoise, SensorScanner, Sensors, Transport, WorldScene,
};

/// Scans from where the robots are now. A sensor sees the obstacles and the other robots of its world, not its own
/// robot. A noisy sensor's readings are drawn anew for the tick, from its own stream.
pub(crate) fn sense(world: &mut World) {
    let robots: SmallVec<[Entity; 8]> =
        world.get_resource::<Roster>().map_or_else(SmallVec::new, |r| r.robots().into());
    for robot in robots {
        let Some(sensors) = world.get::<Sensors>(robot) else { continue };
        for sensor in sensors.iter().collect::<SmallVec<[Entity; 4]>>() {
            scan(world, robot, sensor);
        }
    }
}

/// Runs one sensor's scan, into the memory of its last one.
fn scan(world: &mut World, robot: Entity, sensor: Entity) -> Option<()> {
    let mut scanner = world.get_mut::<SensorScanner>(sensor)?.0.take()?;
    let mut ranges = world.get_mut::<Scan>(sensor).map(|mut scan| std::mem::take(&mut scan.0)).unwrap_or_default();
    let model = world.get::<SensorModel>(sensor)?.0;
    ranges.resize(model.n_rays as usize, 0.0);
    let seen = (|| {
        let pose = (world.get::<RobotOps>(robot)?.sensor_pose)(world, robot)?;
        let inhabited = world.get::<ResidesIn>(robot)?.0;
        let others = others_now(world, inhabited, *world.get::<RobotId>(robot)?);
        scanner.scan_into(&world.get::<WorldScene>(inhabited)?.0, &others, &pose, &mut ranges);
        if let Some(SensorNoise { model: noise, stream }) = world.get::<SensorNoise>(sensor) {
            ranges = noise.apply(&model, &ranges, stream, world.resource::<Transport>().tick);
        }
        Some(())
    })();
    if seen.is_some() {
        world.get_mut::<Scan>(sensor)?.0 = ranges;
    }
    world.get_mut::<SensorScanner>(sensor)?.0 = Some(scanner);
    Some(())
}
