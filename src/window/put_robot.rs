//! The teleport in the run under way: a robot is put where another widget has it.

use bevy::prelude::*;

use super::error::SessionError;
use motion_lab_core::worlds::World as WorldModel;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::run::{Quantized, RobotInput};
use motion_lab_sim::simulation::{RobotCommand, RobotKinds, Roster, RunCommand, StandingWorld, TransportCommand, view};

/// Puts a robot of the run at these chart coordinates, as an input of the run that can be undone.
///
/// # Errors
/// [`SessionError`] when no robot of the run has this name in a world of this name, or when it has no room there among
/// the obstacles and the robots as they stand.
pub fn put_robot(world: &mut World, of: &str, robot: &str, coordinates: Vec<Quantized>) -> Result<(), SessionError> {
    let unknown = || SessionError::NoRobot(robot.to_owned());
    let standing = standing(world, of, robot).ok_or_else(unknown)?;
    let rounded: Vec<f64> = coordinates.iter().map(|c| c.value()).collect();
    let mut atlas = Atlas::new(standing).knowing(world.resource::<RobotKinds>().known());
    let index = atlas.robots().iter().position(|r| r.name == robot).ok_or_else(unknown)?;
    let wanted = atlas.robots()[index].q.with_coordinates(&rounded).ok_or_else(unknown)?;
    atlas.teleport(index, wanted).ok_or_else(unknown)?.map_err(SessionError::Refused)?;
    world.write_message(RunCommand::from(TransportCommand::Checkpoint));
    let input = RobotInput::Teleport(coordinates);
    world.write_message(RunCommand::from(RobotCommand { robot: robot.to_owned(), input }));
    Ok(())
}

/// The run's world of this name as it stands, with its robots where they are; `None` if this robot does not live in
/// one.
fn standing(world: &World, of: &str, robot: &str) -> Option<WorldModel> {
    let robots = view(world);
    let number = robots.iter().find(|r| r.name == robot)?.world;
    let entity = *world.get_resource::<Roster>()?.worlds().get(number as usize)?;
    let mut standing = WorldModel::clone(&world.get::<StandingWorld>(entity)?.0);
    for resident in &mut standing.robots {
        if let Some(now) = robots.iter().find(|r| r.name == resident.name) {
            resident.start = now.coordinates.to_vec();
        }
    }
    (standing.name == of).then_some(standing)
}
