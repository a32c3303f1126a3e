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
    /// Whether a component was inserted whose hooks may have work to do yet. What was inserted is put back after that.
    pub(super) is_fresh: bool,
}

/// What becomes of a component that others change while the run stands at tick 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AtStart {
    /// The run follows it.
    Followed,
    /// The run follows it: it is the model of a robot.
    Model,
    /// It is put back.
    PutBack,
    /// It comes and goes with the model of a robot. Without a change of that it is put back.
    WithModel,
}

/// A component that is watched.
pub(super) struct Watched {
    /// The name of its type.
    pub(super) name: String,
    pub(super) at_start: AtStart,
}

/// The components of the run's entities that others have inserted, replaced or removed since they were last settled,
/// also by despawning.
#[derive(Resource, Default)]
pub(crate) struct ForeignTouches {
    /// The components that are watched and have a name in messages.
    pub(super) watched: BTreeMap<ComponentId, Watched>,
    /// How many observers watch them.
    pub(super) observers: usize,
    pub(in crate::simulation) entities: BTreeMap<Entity, Touch>,
    /// How many pieces of the simulation's own work are under way, one within the other.
    pub(super) at_work: u32,
    /// Whether a command that puts things back is under way already.
    pub(super) is_queued: bool,
    /// Whether something was changed, or may have been, before the run left tick 0.
    pub(crate) is_unsettled: bool,
    /// Whether observers of placements were called since the last tick, who may have changed anything.
    pub(crate) has_shown: bool,
}

impl ForeignTouches {
    /// The name of a component that is watched.
    pub(super) fn name(&self, component: ComponentId) -> &str {
        self.watched.get(&component).map_or("", |watched| &watched.name)
    }

    /// The names of the components of a touch at tick 0 that are put back.
    pub(super) fn put_back_at_start(&self, touch: &Touch) -> Vec<String> {
        let watched = || touch.components.iter().filter_map(|component| self.watched.get(component));
        let has_other_model = watched().any(|component| component.at_start == AtStart::Model);
        let is_put_back = |component: &&Watched| match component.at_start {
            AtStart::Followed | AtStart::Model => false,
            AtStart::PutBack => true,
            AtStart::WithModel => !has_other_model,
        };
        watched().filter(is_put_back).map(|component| component.name.clone()).collect()
    }
}

/// Runs the simulation's own work, whose changes of entities are no one else's.
pub(crate) fn at_work<T>(world: &mut World, work: impl FnOnce(&mut World) -> T) -> T {
    world.resource_mut::<ForeignTouches>().at_work += 1;
    let done = work(world);
    world.resource_mut::<ForeignTouches>().at_work -= 1;
    done
}
