//! `SpawnRequest`, one robot to be spawned.

use bevy::prelude::*;

use crate::simulation::RobotId;
use crate::tour::RouteTours;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// One robot to be spawned.
pub(crate) struct SpawnRequest<'a> {
    /// Its entity; `None` where one is to be spawned.
    pub(crate) entity: Option<Entity>,
    /// Whether its sensors are to be spawned too.
    pub(crate) with_sensors: bool,
    pub(crate) seed: Seed,
    pub(crate) id: RobotId,
    pub(crate) world: Entity,
    pub(crate) model: &'a WorldModel,
    pub(crate) resident: &'a Resident,
    pub(crate) sensor: Option<RangeSensor>,
    pub(crate) routes: &'a RouteTours,
    pub(crate) about: Option<&'static RobotKind>,
}
