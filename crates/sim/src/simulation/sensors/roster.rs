//! `SensorRoster`, the sensors of the run in their order, with what they read.

use std::collections::BTreeMap;

use bevy::prelude::*;

use super::refusal::SensorRefused;
use super::scanners::Scanners;
use crate::simulation::RobotOps;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::random::Stream;
use motion_lab_core::sensors::{BeamModel, FanSensor, RangeSensor};
use motion_lab_core::worlds::{AllRaysError, RayCount};

/// Largest number of refusals that are kept.
const MAX_REFUSED: usize = 1000;

/// The sensors of the run by their robots' ids, then by the bytes of their names. They are those of the sensor entities
/// there are when the run leaves tick 0, whoever spawned them and in whatever order, and fixed from then on.
#[derive(Resource, Debug)]
pub struct SensorRoster {
    pub(crate) sensors: Vec<RunSensor>,
    /// Scanners for the sensors, which many of them share.
    pub(crate) scanners: Scanners,
    refused: Vec<SensorRefused>,
    /// The rays of the sensors.
    rays: RayCount,
}

#[derive(Debug)]
pub(crate) struct RunSensor {
    /// The sensor's entity.
    pub(crate) entity: Entity,
    pub(crate) robot: Entity,
    pub(crate) id: u32,
    pub(crate) name: String,
    pub(crate) rays: FanSensor,
    pub(crate) mount: Pose2,
    /// The noise, with the sensor's own stream.
    pub(crate) noise: Option<(BeamModel, Stream)>,
    /// The number of its rays' pattern in the roster.
    pub(crate) fan: usize,
}

impl SensorRoster {
    /// The roster of a run without sensors.
    pub(crate) fn none() -> Self {
        SensorRoster {
            sensors: Vec::new(),
            scanners: Scanners::default(),
            refused: Vec::new(),
            rays: RayCount::default(),
        }
    }

    /// The sensors' entities, in order.
    pub fn entities(&self) -> impl Iterator<Item = Entity> {
        self.sensors.iter().map(|sensor| sensor.entity)
    }

    /// The sensors that were not taken into the run, in the order they were met.
    pub fn refused(&self) -> &[SensorRefused] {
        &self.refused
    }

    /// Takes a sensor, unless the run would have too many rays with it.
    pub(super) fn take(&mut self, sensor: RunSensor) -> Result<(), AllRaysError> {
        self.rays.add(u64::from(sensor.rays.sensor.n_rays))?;
        self.sensors.push(sensor);
        Ok(())
    }

    /// Numbers the patterns of rays that the sensors have.
    pub(super) fn sort_fans(&mut self) {
        let mut fans = BTreeMap::new();
        for sensor in &mut self.sensors {
            let FanSensor { sensor: RangeSensor { n_rays, max_range }, field_of_view } = sensor.rays;
            let number = fans.len();
            sensor.fan = *fans.entry((n_rays, max_range.to_bits(), field_of_view.to_bits())).or_insert(number);
        }
    }

    /// Notes a refusal. Returns whether it is new.
    pub(super) fn refuse(&mut self, refused: &SensorRefused) -> bool {
        let new = self.refused.len() < MAX_REFUSED && !self.refused.contains(refused);
        if new {
            self.refused.push(refused.clone());
        }
        new
    }
}

impl RunSensor {
    /// The sensor's pose in the world; `None` when its robot is gone.
    pub(crate) fn pose(&self, world: &World) -> Option<Pose2> {
        let frame = (world.get::<RobotOps>(self.robot)?.mount_pose)(world, self.robot)?;
        // composed with the identity, the heading would be wrapped
        Some(if self.mount == Pose2::IDENTITY { frame } else { frame.compose(&self.mount) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_with_which_there_would_be_too_many_rays_is_not_taken() {
        let sensor = |n_rays| RunSensor {
            entity: Entity::PLACEHOLDER,
            robot: Entity::PLACEHOLDER,
            id: 0,
            name: "ahead".into(),
            rays: RangeSensor { n_rays, max_range: 1.0 }.into(),
            mount: Pose2::IDENTITY,
            noise: None,
            fan: 0,
        };
        let mut roster = SensorRoster::none();
        (0..399).for_each(|_| roster.take(sensor(100_000)).unwrap());
        assert_eq!(roster.take(sensor(100_001)), Err(AllRaysError(40_000_001)));
        roster.take(sensor(99_999)).unwrap();
        roster.take(sensor(1)).unwrap();
        assert_eq!(roster.take(sensor(1)), Err(AllRaysError(40_000_001)));
        assert_eq!(roster.sensors.len(), 401);
    }
}
