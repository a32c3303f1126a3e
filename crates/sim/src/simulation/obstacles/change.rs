//! Changes of a world in a run: refused where a robot stands.

use bevy::prelude::*;

use super::roster::{ObstacleRoster, WorldObstacles, place, refresh, wanted, with_roster};
use crate::run::WorldEvent;
use crate::simulation::{Placement, Residents, ResidesIn, RobotId, RobotName, RobotOps};
use motion_lab_core::collision::touch;
use motion_lab_core::geometry::Placed;

/// A change of a world that was refused. The world stays as it was.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("tick {tick}: {obstacle:?} in world {world:?} stays as it is: robot {robot:?} stands there")]
pub struct ChangeRefused {
    /// The tick of the change.
    pub tick: u64,
    /// The world's name.
    pub world: String,
    /// The name of the obstacle or the door.
    pub obstacle: String,
    /// The first robot, by id, that stands where the obstacle would be. One that would touch it stands there.
    pub robot: String,
}

/// The changes refused since they were last reported.
#[derive(Resource, Default, Debug)]
pub(crate) struct RefusedChanges(pub(crate) Vec<ChangeRefused>);

/// The first robot that stands where an obstacle would be.
fn in_the_way(world: &World, ground: &WorldObstacles, number: usize, placement: &Placement) -> Option<String> {
    if ground.placement(number) == Some(*placement) {
        return None;
    }
    let pieces: Vec<Placed> = ground.placed(number, placement)?.placed().collect();
    let mut robots: Vec<(RobotId, Entity)> = world
        .get::<Residents>(ground.entity())?
        .iter()
        .filter(|robot| world.get::<ResidesIn>(*robot).is_some_and(|of| of.0 == ground.entity()))
        .filter_map(|robot| Some((*world.get::<RobotId>(robot)?, robot)))
        .collect();
    robots.sort_unstable();
    let stands = |robot: Entity| {
        let footprint = world.get::<RobotOps>(robot).and_then(|ops| (ops.footprint)(world, robot));
        footprint.is_some_and(|f| f.parts().iter().any(|part| pieces.iter().any(|piece| touch(part.placed(), piece))))
    };
    let (_, robot) = robots.into_iter().find(|(_, robot)| stands(*robot))?;
    Some(world.get::<RobotName>(robot)?.name.clone())
}

/// Why a change would be refused now; `None` if it would not.
pub(crate) fn refusal(world: &World, event: &WorldEvent) -> Option<ChangeRefused> {
    let roster = world.resource::<ObstacleRoster>();
    let ground = roster.grounds.get(roster.world(&event.world)?)?;
    let (number, placement) = wanted(ground, &event.change)?;
    let robot = in_the_way(world, ground, number, &placement)?;
    let (world, obstacle) = (event.world.clone(), event.change.name().to_owned());
    Some(ChangeRefused { tick: event.tick, world, obstacle, robot })
}

/// Makes the changes of a tick, in their order. A refused one changes nothing, and is reported.
pub(crate) fn make(world: &mut World, events: &[WorldEvent]) {
    for event in events {
        if let Some(refused) = refusal(world, event) {
            world.resource_mut::<RefusedChanges>().0.push(refused);
            continue;
        }
        with_roster(world, |world, roster| {
            let number = roster.world(&event.world);
            if let Some(ground) = number.and_then(|w| roster.grounds.get_mut(w))
                && let Some((number, placement)) = wanted(ground, &event.change)
            {
                place(ground, number, placement);
            }
            refresh(world, roster);
        });
    }
}
