//! Moving a run: a tick on, or to any tick.

use bevy::prelude::*;

use super::obstacles::change::RefusedChanges;
use super::obstacles::dress::show;
use super::robot::contact;
use super::truth::leave_start;
use super::truth::put_back::put_values_back;
use super::truth::settle;
use super::truth::touched::{ForeignTouches, at_work};
use super::{Keyframes, RestoreError, SimulationSchedule, Transport, state::put_frame};
use crate::run::Frame;

/// Runs one tick. Before the first, the run becomes that of its entities; before a later one, what others have changed
/// of them is put back ([`settle`]). After it, the contacts that began or ended in it are triggered as
/// [`ContactBegan`](super::ContactBegan) and [`ContactEnded`](super::ContactEnded).
pub fn step(world: &mut World) {
    settle(world);
    contact::with_events(world, advance_and_show);
}

/// [`step`] of a world that nobody but the simulation has had in hand since the last tick: its values need no look.
/// Where somebody observes contacts, or obstacles were moved, or the run stands at tick 0, others may have had it, and
/// it is a step.
pub(crate) fn step_alone(world: &mut World) {
    let has_shown = std::mem::take(&mut world.resource_mut::<ForeignTouches>().has_shown);
    if has_shown || world.resource::<Transport>().tick == 0 || contact::are_observed(world) {
        step(world)
    } else {
        run_tick(world);
        show(world);
    }
}

fn advance_and_show(world: &mut World) {
    advance(world);
    show(world);
}

/// Runs one tick and triggers nothing.
fn advance(world: &mut World) {
    if world.resource::<Transport>().tick == 0 {
        leave_start(world);
    }
    run_tick(world);
}

/// Runs one tick of a run that has left its start.
fn run_tick(world: &mut World) {
    at_work(world, |world| world.run_schedule(SimulationSchedule));
}

/// Moves the run to `tick`. It restores the last keyframe at or before `tick` if the run stands
/// after `tick` or before that keyframe, and simulates the rest. No contact is triggered.
///
/// # Errors
/// [`RestoreError`] when the keyframe does not fit the run. Only a frame from elsewhere could cause that.
pub fn seek(world: &mut World, tick: u64) -> Result<(), RestoreError> {
    settle(world);
    let now = world.resource::<Transport>().tick;
    let keyframe = world.resource::<Keyframes>().before(tick).filter(|f| tick < now || f.tick > now);
    if let Some(frame) = keyframe.cloned() {
        put_frame_at_work(world, &frame)?;
    }
    while world.resource::<Transport>().tick < tick {
        advance(world);
    }
    show(world);
    // those on the way there were reported when they were first refused
    world.resource_mut::<RefusedChanges>().0.clear();
    Ok(())
}

/// Says that the run is known to have reached a tick before, as one that is brought back from a file: it lies within
/// its frontier.
pub fn extend_frontier(world: &mut World, tick: u64) {
    let mut transport = world.resource_mut::<Transport>();
    transport.frontier = std::cmp::max(transport.frontier, tick);
}

/// Puts the simulation into the state of `frame`, overwriting components. The ticks after it repeat
/// bit for bit. The scans are taken anew, which gives the frame's own.
///
/// # Errors
/// [`RestoreError`] when the frame is not one of this run. The robots before the one named are overwritten
/// all the same.
pub fn restore(world: &mut World, frame: &Frame) -> Result<(), RestoreError> {
    settle(world);
    put_frame_at_work(world, frame)?;
    show(world);
    Ok(())
}

/// Puts the simulation into the state of a frame, whatever observers make of it.
fn put_frame_at_work(world: &mut World, frame: &Frame) -> Result<(), RestoreError> {
    at_work(world, |world| put_frame(world, frame))?;
    put_values_back(world);
    Ok(())
}

/// Runs the next tick of a run that plays. A looping run at its frontier begins again at tick 0.
pub fn play_tick(world: &mut World) {
    let &Transport { tick, frontier, looping, .. } = world.resource::<Transport>();
    if looping && tick >= frontier && frontier > 0 {
        // tick 0 is always kept
        let _ = seek(world, 0);
    }
    step(world);
}
