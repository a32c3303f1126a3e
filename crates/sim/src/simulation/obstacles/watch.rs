//! Watches obstacle entities for changes from outside: before tick 0 they count, in a run they are refused.

use bevy::ecs::world::DeferredWorld;
use bevy::prelude::*;

use super::change::name_of;
use super::roster::ObstacleRoster;
use crate::simulation::{CommandError, CommandRefused, Door, ObstacleShape, Placement, Roster, Transport};

pub(crate) fn watch(app: &mut App) {
    app.add_observer(|on: On<Insert, (ObstacleShape, Placement, Door)>, mut world: DeferredWorld| {
        note(&mut world, on.entity);
    });
    app.add_observer(|on: On<Remove, (ObstacleShape, Door)>, mut world: DeferredWorld| note(&mut world, on.entity));
}

/// An obstacle was inserted, replaced or removed.
fn note(world: &mut DeferredWorld, obstacle: Entity) {
    if world.resource::<ObstacleRoster>().is_at_work || !world.contains_resource::<Roster>() {
        return;
    }
    if world.resource::<Transport>().tick == 0 {
        world.resource_mut::<ObstacleRoster>().is_unsettled = true;
        return;
    }
    let refused = CommandError::ObstacleInRun { name: name_of(world, obstacle) };
    world.write_message(CommandRefused(refused));
}
