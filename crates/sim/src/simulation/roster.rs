//! `Roster`, the robots and worlds of a run by their numbers.

use std::collections::BTreeMap;

use bevy::prelude::*;

use super::{RobotOps, RobotView};
use motion_lab_core::geometry::Footprint;

/// The robots and worlds of the run by their numbers; fixed from tick 0 on.
#[derive(Resource, Clone, Debug, Default)]
pub struct Roster {
    pub(super) worlds: Vec<Entity>,
    pub(super) robots: Vec<Entity>,
    pub(super) names: BTreeMap<String, Entity>,
}

impl Roster {
    /// The robots' entities by id.
    pub fn robots(&self) -> &[Entity] {
        &self.robots
    }

    /// The entity of the robot with this name.
    pub fn named(&self, name: &str) -> Option<Entity> {
        self.names.get(name).copied()
    }

    /// The worlds' entities by number.
    pub fn worlds(&self) -> &[Entity] {
        &self.worlds
    }
}

/// All robots of the run, by ascending id; none before a run was started.
pub fn view(world: &World) -> Vec<RobotView> {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    robots.iter().filter_map(|&e| (world.get::<RobotOps>(e)?.view)(world, e)).collect()
}

/// The robot of the run with this id; `None` for an id that no robot has.
pub fn view_of(world: &World, id: u32) -> Option<RobotView> {
    let entity = entity_of(world, id)?;
    (world.get::<RobotOps>(entity)?.view)(world, entity)
}

/// The footprint of the robot with this id, as it is now; `None` for an id that no robot has.
pub fn footprint_of(world: &World, id: u32) -> Option<Footprint> {
    let entity = entity_of(world, id)?;
    (world.get::<RobotOps>(entity)?.footprint)(world, entity)
}

fn entity_of(world: &World, id: u32) -> Option<Entity> {
    world.get_resource::<Roster>()?.robots().get(id as usize).copied()
}
