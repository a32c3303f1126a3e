//! `ContactBegan` and `ContactEnded`, a robot's contacts as events for observers.

use bevy::prelude::*;

use crate::simulation::{LatestFrame, Roster};

/// A contact of a robot began: the tick before was not in contact, `tick` is.
///
/// It is triggered on the robot's entity after each tick that [`step`](crate::simulation::step) or
/// [`play_tick`](crate::simulation::play_tick) runs: in the fixed loop, by the step command, by a recorder's step.
/// That is outside the [`SimulationSchedule`](crate::simulation::SimulationSchedule): the tick is over and its frame
/// taken. The events of a tick come in the order of the robots' ids.
///
/// Moving the run triggers none: a seek (back, or ahead over ticks not run before), a restored frame, an undo or the
/// start of another run. After one of these, ask the robots' [`Contacts`](crate::simulation::Contacts).
///
/// ```
/// use bevy::prelude::*;
/// use motion_lab_sim::simulation::{ContactBegan, RobotName, headless_app};
/// let mut app = headless_app();
/// app.add_observer(|contact: On<ContactBegan>, robots: Query<&RobotName>| {
///     if let Ok(robot) = robots.get(contact.robot) {
///         println!("{} met something at tick {}", robot.name, contact.tick);
///     }
/// });
/// ```
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactBegan {
    /// The robot's entity.
    #[event_target]
    pub robot: Entity,
    /// The first tick in contact.
    pub tick: u64,
}

/// A contact of a robot ended: the tick before was in contact, `tick` is not. It is triggered as [`ContactBegan`] is.
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactEnded {
    /// The robot's entity.
    #[event_target]
    pub robot: Entity,
    /// The first tick without contact.
    pub tick: u64,
}

/// Whether each robot was in contact before the tick, by id. The memory is kept from tick to tick.
#[derive(Resource, Default)]
pub(crate) struct ContactsBefore(Vec<bool>);

/// Runs `tick` in the world, then triggers the events of the contacts that began or ended in it. Without observers it
/// compares nothing.
pub(crate) fn with_events(world: &mut World, tick: impl FnOnce(&mut World)) {
    if !are_observed(world) {
        return tick(world);
    }
    let mut before = std::mem::take(&mut world.get_resource_or_init::<ContactsBefore>().0);
    before.clear();
    before.extend(world.resource::<LatestFrame>().frame().robots.iter().map(|robot| robot.in_contact));
    tick(world);
    let frame = world.resource::<LatestFrame>().frame();
    let (number, robots) = (frame.tick, world.get_resource::<Roster>().map_or(&[][..], Roster::robots));
    let states = robots.iter().zip(frame.robots.iter().zip(&before));
    // gathered first, because an observer may start another run
    let changes: Vec<(Entity, bool)> = states
        .filter(|(_, (state, before))| state.in_contact != **before)
        .map(|(&robot, (state, _))| (robot, state.in_contact))
        .collect();
    world.resource_mut::<ContactsBefore>().0 = before;
    for (robot, in_contact) in changes {
        if world.get_entity(robot).is_err() {
            continue;
        }
        if in_contact {
            world.trigger(ContactBegan { robot, tick: number });
        } else {
            world.trigger(ContactEnded { robot, tick: number });
        }
        world.flush();
    }
}

/// Whether somebody observes contacts.
pub(crate) fn are_observed(world: &World) -> bool {
    is_observed::<ContactBegan>(world) || is_observed::<ContactEnded>(world)
}

fn is_observed<E: Event>(world: &World) -> bool {
    let observers = world.event_key::<E>().and_then(|key| world.observers().try_get_observers(key));
    observers.is_some_and(|o| !(o.global_observers().is_empty() && o.entity_observers().is_empty()))
}
