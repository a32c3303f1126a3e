//! Observes what others insert, replace, remove or despawn of the run's entities.

use bevy::ecs::component::ComponentId;
use bevy::ecs::world::DeferredWorld;
use bevy::prelude::*;

use super::component_name::name_of;
use super::lookup::thing_of;
use super::put_back::put_back;
use super::touched::{AtStart, ForeignTouches, Watched};
use crate::simulation::{Roster, Transport};

/// Watches components on all entities, under the names of their types.
macro_rules! watch_components {
    ($world:expr, $at_start:expr, $($component:ty),+ $(,)?) => {{
        let components = [$($crate::simulation::truth::watch::named::<$component>($world, $at_start)),+];
        $crate::simulation::truth::watch::watch($world, &components);
    }};
}
pub(crate) use watch_components;

/// Watches components on all entities. Those without a name are put back in silence.
pub(crate) fn watch(world: &mut World, components: &[ComponentId]) {
    let inserted =
        Observer::new(|on: On<Insert>, world: DeferredWorld| note(world, on.entity, on.trigger().components, true));
    let discarded =
        Observer::new(|on: On<Discard>, world: DeferredWorld| note(world, on.entity, on.trigger().components, false));
    for observer in [inserted, discarded] {
        world.spawn(observer.with_components(components.iter().copied()));
        world.resource_mut::<ForeignTouches>().observers += 1;
    }
}

/// The number of a component, which gets the name of its type in messages.
pub(crate) fn named<C: Component>(world: &mut World, at_start: AtStart) -> ComponentId {
    let (id, name) = (world.register_component::<C>(), name_of::<C>());
    world.resource_mut::<ForeignTouches>().watched.insert(id, Watched { name, at_start });
    id
}

/// Whether there are observers beside those that watch the run's components.
pub(crate) fn are_observers_of_others(world: &mut World) -> bool {
    let all = world.query_filtered::<(), With<Observer>>().iter(world).count();
    all > world.resource::<ForeignTouches>().observers
}

fn note(mut world: DeferredWorld, entity: Entity, components: &[ComponentId], is_inserted: bool) {
    let is_own = world.get_resource::<ForeignTouches>().is_none_or(|touched| touched.at_work > 0);
    if is_own {
        return;
    }
    if !world.contains_resource::<Roster>() {
        // the first run is yet to begin
        world.resource_mut::<ForeignTouches>().is_unsettled = true;
        return;
    }
    let thing = thing_of(&world, entity);
    let touched = world.resource_mut::<ForeignTouches>().into_inner();
    let touch = touched.entities.entry(entity).or_default();
    touch.thing = touch.thing.or(thing);
    touch.components.extend(components.iter().filter(|id| touched.watched.contains_key(id)));
    // the hooks of what is discarded come after its observers, those of what is inserted before: a look at the former
    // is early if something is inserted in its place
    let is_new = if is_inserted {
        !std::mem::replace(&mut touch.is_fresh, true)
    } else {
        !std::mem::replace(&mut touched.is_queued, true)
    };
    if is_new {
        world.commands().queue(move |world: &mut World| look(world, is_inserted.then_some(entity)));
    }
}

/// Puts back what was changed in a run under way, at once. What was changed at tick 0 waits for
/// [`settle`](super::settle). The hooks of what was `inserted` are done.
fn look(world: &mut World, inserted: Option<Entity>) {
    let at_start = world.resource::<Transport>().tick == 0;
    let mut touched = world.resource_mut::<ForeignTouches>();
    match inserted {
        Some(entity) => touched.entities.get_mut(&entity).into_iter().for_each(|touch| touch.is_fresh = false),
        None => touched.is_queued = false,
    }
    if at_start {
        touched.is_unsettled = true;
    } else {
        put_back(world);
    }
}
