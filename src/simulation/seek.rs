//! Moving a run: a tick on, or to any tick.

use bevy::prelude::*;

use super::sensors::start::fix_sensors;
use super::{Keyframes, RestoreError, SimulationSchedule, Transport, restore};

/// Runs one tick. The first tick of a run fixes its sensors.
pub fn step(world: &mut World) {
    fix_sensors(world);
    world.run_schedule(SimulationSchedule);
}

/// Moves the run to `tick`. It restores the last keyframe at or before `tick` if the run stands
/// after `tick` or before that keyframe, and simulates the rest.
///
/// # Errors
/// [`RestoreError`] when the keyframe does not fit the run. Only a frame from elsewhere could cause that.
pub fn seek(world: &mut World, tick: u64) -> Result<(), RestoreError> {
    let now = world.resource::<Transport>().tick;
    let keyframe = world.resource::<Keyframes>().before(tick).cloned();
    if let Some(frame) = keyframe.filter(|f| tick < now || f.tick > now) {
        restore(world, &frame)?;
    }
    while world.resource::<Transport>().tick < tick {
        step(world);
    }
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
