//! The resident of a world that a robot's entity is.

use bevy::prelude::*;

use super::spawn::{SpawnableRobot, tour};
use crate::simulation::{Configuration, RobotModel, RobotRefusal, SimulatedRobot, Transport};
use crate::tour::RouteTours;
use motion_lab_core::configuration::{Configuration as _, Sizes};
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// The resident that an entity of a kind with this model is: `base` with the entity's start and sizes. One that is as
/// `base` says is `base` itself.
pub(crate) fn describe<R: SimulatedRobot>(
    world: &World,
    entity: Entity,
    model: &R,
    base: Resident,
    (of_world, routes): (&WorldModel, &RouteTours),
) -> Result<Resident, RobotRefusal> {
    let robot = world.get::<RobotModel<R>>(entity).ok_or(RobotRefusal::Model)?.0.clone();
    let q = world.get::<Configuration<R>>(entity).ok_or(RobotRefusal::Configuration)?.0;
    let is_it = |made: &SpawnableRobot<R>| {
        let same =
            made.q.coordinates().iter().map(|c| c.to_bits()).eq(q.coordinates().iter().map(|c| (c + 0.0).to_bits()));
        same && made.robot.fitted(&q) == robot.fitted(&q)
    };
    let seed = world.resource::<Transport>().seed;
    let starts = |made: &SpawnableRobot<R>, resident: &Resident| {
        tour(&made.robot, seed, (of_world, routes), resident, &made.q).map(|_| ())
    };
    if let Ok(made) = SpawnableRobot::new(model, &base, of_world)
        && is_it(&made)
    {
        starts(&made, &base)?;
        return Ok(base);
    }
    let sizes = sizes(model, &robot, &q, base.sizes.as_ref())?;
    let resident = Resident { start: q.coordinates().to_vec(), sizes, ..base };
    let made = SpawnableRobot::new(model, &resident, of_world)?;
    if made.robot.fitted(&made.q) != robot.fitted(&made.q) {
        return Err(RobotRefusal::Model);
    }
    starts(&made, &resident)?;
    Ok(resident)
}

/// The sizes that make this robot from its kind's model: none, those that it had, or its own.
fn sizes<R: SimulatedRobot>(
    model: &R,
    robot: &R,
    q: &R::Configuration,
    old: Option<&Sizes>,
) -> Result<Option<Sizes>, RobotRefusal> {
    let is_it = |made: &R| made.fitted(q) == robot.fitted(q);
    if is_it(model) {
        return Ok(None);
    }
    let own = robot.sizes();
    let mut tried = old.into_iter().chain(own.as_ref());
    let sizes = tried.find(|sizes| model.with_sizes(sizes).is_some_and(|made| is_it(&made)));
    sizes.cloned().map(Some).ok_or(RobotRefusal::Model)
}
