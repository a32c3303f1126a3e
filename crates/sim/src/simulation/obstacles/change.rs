//! Changes of a world in a run: refused where a robot stands.

use std::collections::BTreeMap;

use bevy::prelude::*;

use super::roster::{ObstacleRoster, WorldObstacles, place, wanted, with_roster};
use super::standing::refresh;
use super::standing_parts::StandingParts;
use crate::run::WorldEvent;
use crate::simulation::{Placement, RobotName};

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

/// Why a change would be refused now; `None` if it would not.
pub(crate) fn refusal(world: &World, event: &WorldEvent) -> Option<ChangeRefused> {
    let roster = world.resource::<ObstacleRoster>();
    let ground = roster.grounds.get(roster.world(&event.world)?)?;
    refused(world, ground, &StandingParts::of(world, ground.entity()), event, wanted(ground, &event.change)?)
}

/// Why a change would be refused that asks for this placement of the obstacle of this number.
fn refused(
    world: &World,
    ground: &WorldObstacles,
    standing: &StandingParts,
    event: &WorldEvent,
    (number, placement): (usize, Placement),
) -> Option<ChangeRefused> {
    if ground.placement(number) == Some(placement) {
        return None;
    }
    let robot = standing.first_touching(ground.placed(number, &placement)?.placed())?;
    let robot = world.get::<RobotName>(robot)?.name.clone();
    let (world, obstacle) = (event.world.clone(), event.change.name().to_owned());
    Some(ChangeRefused { tick: event.tick, world, obstacle, robot })
}

/// Makes the changes of a tick, in their order: each meets what those before it have made. A refused one changes
/// nothing, and is reported. The scenes follow once, for no change asks them.
pub(crate) fn make(world: &mut World, events: &[WorldEvent]) {
    if events.is_empty() {
        return;
    }
    with_roster(world, |world, roster| {
        // robots stand where they are while worlds change
        let mut standing = BTreeMap::new();
        for event in events {
            let Some(w) = roster.world(&event.world) else { continue };
            let Some(ground) = roster.grounds.get_mut(w) else { continue };
            let Some((number, placement)) = wanted(ground, &event.change) else { continue };
            let parts = standing.entry(w).or_insert_with(|| StandingParts::of(world, ground.entity()));
            match refused(world, ground, parts, event, (number, placement)) {
                Some(refused) => world.resource_mut::<RefusedChanges>().0.push(refused),
                None => place(ground, number, placement),
            }
        }
        refresh(world, roster);
    });
}
