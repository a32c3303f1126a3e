//! Moving a run: a tick on, or to any tick.

use bevy::prelude::*;

use super::obstacles::change::RefusedChanges;
use super::obstacles::start::settle_start;
use super::robot::contact;
use super::sensors::start::fix_sensors;
use super::{Keyframes, RestoreError, SimulationSchedule, Transport, restore};

/// Runs one tick. Before the first, obstacles that were changed from outside become those of the run, and its sensors
/// are fixed. After it, the contacts that began or ended in it are triggered as [`ContactBegan`](super::ContactBegan)
/// and [`ContactEnded`](super::ContactEnded).
pub fn step(world: &mut World) {
    contact::with_events(world, advance);
}

/// Runs one tick and triggers nothing.
fn advance(world: &mut World) {
    settle_start(world);
    fix_sensors(world);
    world.run_schedule(SimulationSchedule);
}

/// Moves the run to `tick`. It restores the last keyframe at or before `tick` if the run stands
/// after `tick` or before that keyframe, and simulates the rest. No contact is triggered.
///
/// # Errors
/// [`RestoreError`] when the keyframe does not fit the run. Only a frame from elsewhere could cause that.
pub fn seek(world: &mut World, tick: u64) -> Result<(), RestoreError> {
    settle_start(world);
    let now = world.resource::<Transport>().tick;
    let keyframe = world.resource::<Keyframes>().before(tick).filter(|f| tick < now || f.tick > now);
    if let Some(frame) = keyframe.cloned() {
        restore(world, &frame)?;
    }
    while world.resource::<Transport>().tick < tick {
        advance(world);
    }
    // those on the way there were reported when they were first refused
    world.resource_mut::<RefusedChanges>().0.clear();
    Ok(())
}

/// Runs the next tick of a run that plays. A looping run at its frontier begins again at tick 0.
pub fn play_tick(world: &mut World) {
    let Transport { tick, frontier, looping, .. } = *world.resource::<Transport>();
    if looping && tick >= frontier && frontier > 0 {
        // tick 0 is always kept
        let _ = seek(world, 0);
    }
    step(world);
}
