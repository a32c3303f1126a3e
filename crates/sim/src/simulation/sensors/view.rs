//! `SensorView`, a sensor of the run with what it reads, for views.

use std::sync::Arc;

use bevy::prelude::*;

use super::roster::SensorRoster;
use crate::run::RobotScan;
use crate::simulation::LatestFrame;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::sensors::FanSensor;

/// A sensor of the run as a view shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorView {
    /// The robot's id.
    pub robot: u32,
    /// The name, unique on its robot; empty for the sensor that the run gives to its rovers.
    pub name: String,
    /// Its rays.
    pub rays: FanSensor,
    /// Its pose in the world now.
    pub pose: Pose2,
    /// The range of each ray at the end of the last tick, metres; infinity where nothing is in range.
    pub ranges: Arc<[f64]>,
}

/// The sensors of the run, ordered by robot, then name: one for each scan of a frame, in the same order.
pub fn sensors(world: &World) -> Vec<SensorView> {
    between(world, 0, usize::MAX)
}

/// The sensors of the robot with this id, in the order of their names.
pub fn sensors_of(world: &World, robot: u32) -> Vec<SensorView> {
    let sensors = world.get_resource::<SensorRoster>().map_or(&[][..], |roster| &roster.sensors);
    let before = |id: u32| sensors.partition_point(|sensor| sensor.id < id);
    between(world, before(robot), before(robot.saturating_add(1)))
}

/// The sensors from one place in the run's list up to another, which is left out.
fn between(world: &World, from: usize, to: usize) -> Vec<SensorView> {
    let sensors = world.get_resource::<SensorRoster>().map_or(&[][..], |roster| &roster.sensors);
    let scans = world.get_resource::<LatestFrame>().map_or(&[][..], |frame| &frame.0.scans);
    let view = |(sensor, scan): (&super::roster::RunSensor, &RobotScan)| SensorView {
        robot: sensor.id,
        name: sensor.name.clone(),
        rays: sensor.rays,
        pose: sensor.pose(world).unwrap_or_default(),
        ranges: scan.ranges.clone(),
    };
    sensors.iter().zip(scans).take(to).skip(from).map(view).collect()
}
