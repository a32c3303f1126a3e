//! `ForeignTouches`, what others have changed of the run's entities since it was last looked at.

use std::collections::{BTreeMap, BTreeSet};

use bevy::ecs::component::ComponentId;
use bevy::prelude::*;

use super::thing::RunThing;

/// What others have changed of one entity.
#[derive(Debug, Default)]
pub(crate) struct Touch {
    /// What the entity was in the run when it was first changed.
    pub(super) thing: Option<RunThing>,
    pub(super) components: BTreeSet<ComponentId>,
}

/// The components of the run's entities that others have inserted, replaced or removed since they were last settled,
/// also by despawning.
#[derive(Resource, Default)]
pub(crate) struct ForeignTouches {
    /// The names of the components that are watched.
    pub(super) names: BTreeMap<ComponentId, String>,
    pub(in crate::simulation) entities: BTreeMap<Entity, Touch>,
    /// How many pieces of the simulation's own work are under way, one within the other.
    pub(super) at_work: u32,
    /// Whether a command that puts things back is under way already.
    pub(super) is_queued: bool,
    /// Whether something was changed while the run stood at tick 0.
    pub(crate) is_unsettled: bool,
}

impl ForeignTouches {
    /// The name of a component that is watched.
    pub(super) fn name(&self, component: ComponentId) -> &str {
        self.names.get(&component).map_or("", String::as_str)
    }
}

/// Runs the simulation's own work, whose changes of entities are no one else's.
pub(crate) fn at_work<T>(world: &mut World, work: impl FnOnce(&mut World) -> T) -> T {
    world.resource_mut::<ForeignTouches>().at_work += 1;
    let done = work(world);
    world.resource_mut::<ForeignTouches>().at_work -= 1;
    done
}
