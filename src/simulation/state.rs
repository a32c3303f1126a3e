//! The state of the whole simulation as a `Frame`: taken and put back.

use bevy::prelude::*;

use super::obstacles::roster::ObstacleRoster;
use super::{Keyframes, LatestFrame, RestoreError, RobotId, RobotOps, Roster, SensorRoster, Transport};
use crate::run::{Frame, RobotScan};

/// The state of the simulation now: the canonical form, the same for equal states.
pub fn snapshot(world: &World) -> Frame {
    let mut frame = LatestFrame::default().0;
    snapshot_into(world, &mut frame);
    frame
}

/// As [`snapshot`], into the memory of an earlier frame.
fn snapshot_into(world: &World, frame: &mut Frame) {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    frame.tick = world.get_resource::<Transport>().map_or(0, |t| t.tick);
    frame.robots.clear();
    frame.robots.extend(robots.iter().filter_map(|&e| (world.get::<RobotOps>(e)?.encode)(world, e)));
    let sensors = world.get_resource::<SensorRoster>().map_or(&[][..], |roster| &roster.sensors);
    frame.scans.resize_with(sensors.len(), || RobotScan { robot: 0, ranges: Vec::new() });
    for (scan, sensor) in frame.scans.iter_mut().zip(sensors) {
        scan.robot = sensor.id;
        scan.ranges.clone_from(&sensor.ranges);
    }
    frame.obstacles.clear();
    frame.obstacles.extend(world.get_resource::<ObstacleRoster>().into_iter().flat_map(ObstacleRoster::states));
}

/// Takes the frame of the tick.
pub(super) fn record(world: &mut World) {
    let mut frame = std::mem::take(&mut *world.resource_mut::<LatestFrame>()).0;
    snapshot_into(world, &mut frame);
    world.resource_mut::<Keyframes>().keep(&frame);
    world.resource_mut::<LatestFrame>().0 = frame;
    super::history::note_where_kept(world);
}

/// Puts the simulation into the state of `frame`, overwriting components; nothing is spawned. The ticks after it repeat
/// bit for bit. The scans are taken anew, which gives the frame's own.
///
/// # Errors
/// [`RestoreError`] when the frame is not one of this run. The robots before the one named are overwritten
/// all the same.
pub fn restore(world: &mut World, frame: &Frame) -> Result<(), RestoreError> {
    let robots: Vec<Entity> = world.get_resource::<Roster>().map_or_else(Vec::new, |r| r.robots().to_vec());
    let tick = frame.tick;
    if robots.len() != frame.robots.len() {
        return Err(RestoreError::Robots { tick, found: frame.robots.len(), expected: robots.len() });
    }
    for (&robot, state) in robots.iter().zip(&frame.robots) {
        let refused = RestoreError::Robot { tick, id: state.id };
        let (Some(id), Some(ops)) = (world.get::<RobotId>(robot), world.get::<RobotOps>(robot).copied()) else {
            return Err(refused);
        };
        if id.0 != state.id || (ops.decode)(world, robot, state).is_none() {
            return Err(refused);
        }
    }
    super::obstacles::roster::restore(world, tick, &frame.obstacles)?;
    world.resource_mut::<Transport>().tick = tick;
    super::tick::sense::sense(world);
    record(world);
    Ok(())
}
