//! `SensorView`, a sensor of the run with what it reads, for views.

use bevy::prelude::*;

use super::roster::SensorRoster;
use crate::geometry::Pose2;
use crate::run::RobotScan;
use crate::sensors::FanSensor;
use crate::simulation::LatestFrame;

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
    pub ranges: Vec<f64>,
}

/// The sensors of the run, ordered by robot, then name: one for each scan of a frame, in the same order.
pub fn sensors(world: &World) -> Vec<SensorView> {
    let sensors = world.get_resource::<SensorRoster>().map_or(&[][..], |roster| &roster.sensors);
    let scans = world.get_resource::<LatestFrame>().map_or(&[][..], |frame| &frame.0.scans);
    let view = |(sensor, scan): (&super::roster::RunSensor, &RobotScan)| SensorView {
        robot: sensor.id,
        name: sensor.name.clone(),
        rays: sensor.rays,
        pose: sensor.pose(world).unwrap_or_default(),
        ranges: scan.ranges.clone(),
    };
    sensors.iter().zip(scans).map(view).collect()
}
