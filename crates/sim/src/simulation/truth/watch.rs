//! Observes what others insert, replace, remove or despawn of the run's entities.

use bevy::ecs::component::ComponentId;
use bevy::ecs::world::DeferredWorld;
use bevy::prelude::*;

use super::component_name::name_of;
use super::lookup::thing_of;
use super::put_back::put_back;
use super::touched::ForeignTouches;
use crate::simulation::{Roster, Transport};

/// Watches components on all entities, under the names of their types.
macro_rules! watch_components {
    ($world:expr, $($component:ty),+ $(,)?) => {{
        $($crate::simulation::truth::watch::name::<$component>($world);)+
        $crate::simulation::truth::watch::watch::<($($component,)+)>($world);
    }};
}
pub(crate) use watch_components;

/// Watches the components of a bundle on all entities.
pub(crate) fn watch<B: Bundle>(world: &mut World) {
    world.add_observer(|on: On<Insert, B>, world: DeferredWorld| note(world, on.entity, on.trigger().components));
    world.add_observer(|on: On<Discard, B>, world: DeferredWorld| note(world, on.entity, on.trigger().components));
}

/// Gives a component the name that it has in messages.
pub(crate) fn name<C: Component>(world: &mut World) {
    let (id, name) = (world.register_component::<C>(), name_of::<C>());
    world.resource_mut::<ForeignTouches>().names.insert(id, name);
}

fn note(mut world: DeferredWorld, entity: Entity, components: &[ComponentId]) {
    let is_own = world.get_resource::<ForeignTouches>().is_none_or(|touched| touched.at_work > 0);
    if is_own || !world.contains_resource::<Roster>() {
        return;
    }
    let thing = thing_of(&world, entity);
    let touched = world.resource_mut::<ForeignTouches>().into_inner();
    let touch = touched.entities.entry(entity).or_default();
    touch.thing = touch.thing.or(thing);
    touch.components.extend(components.iter().filter(|id| touched.names.contains_key(id)));
    if !std::mem::replace(&mut touched.is_queued, true) {
        world.commands().queue(look);
    }
}

/// Puts back what was changed in a run under way, at once. What was changed at tick 0 waits for
/// [`settle`](super::settle).
fn look(world: &mut World) {
    let at_start = world.resource::<Transport>().tick == 0;
    let mut touched = world.resource_mut::<ForeignTouches>();
    touched.is_queued = false;
    if at_start {
        touched.is_unsettled = true;
    } else {
        put_back(world);
    }
}
