//! `RunCommand`, by which whatever shows a run changes it: a queue, drained in order once an update.
//!
//! What else changes a run is a function on the whole world, for code that has it: [`start_run`](super::start_run) and
//! [`start_recipe`] begin another run, [`seek()`], [`step()`] and
//! [`play_tick`](super::play_tick) move it, [`restore`](super::restore) puts a frame back. The queue calls the same.

use std::sync::Arc;

use bevy::prelude::*;

use super::obstacles::change::{RefusedChanges, refusal};
use super::obstacles::sync::{add_obstacle, sync_added};
use super::transport::re_rolled;
use super::truth::settle;
use super::{
    CommandError, CommandRefused, History, Keyframes, PendingInput, Playback, Refusals, RefusedEvent, RobotCommand,
    Roster, RunConfig, SpawnError, Transport, TransportCommand, recipe, seek, start_recipe, step, undo,
};
use crate::run::{Event, MAX_EVENTS, Recipe, Script, ScriptError, ScriptProblem, WorldChange, WorldEvent};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// A command to the run, as a message. Commands are carried out in the order in which they were written, before the
/// fixed loop.
#[derive(Message, Clone, Debug, PartialEq)]
pub enum RunCommand {
    /// Move the run through time, or begin another.
    Transport(TransportCommand),
    /// Give a robot an input, which applies at the next tick.
    Robot(RobotCommand),
    /// Change a world, before the next tick's step.
    World(WorldCommand),
}

/// A change of a world from its user, sent as a [`RunCommand`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldCommand {
    /// The world's name.
    pub world: String,
    /// The change.
    pub change: WorldChange,
}

impl From<WorldCommand> for RunCommand {
    fn from(command: WorldCommand) -> Self {
        RunCommand::World(command)
    }
}

impl From<TransportCommand> for RunCommand {
    fn from(command: TransportCommand) -> Self {
        RunCommand::Transport(command)
    }
}

impl From<RobotCommand> for RunCommand {
    fn from(command: RobotCommand) -> Self {
        RunCommand::Robot(command)
    }
}

/// What becomes of what the script has for later ticks.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Later {
    /// It is forgotten: a hand takes over.
    Forgotten,
    /// It stays: a program says one thing more.
    Kept,
}

/// Carries out the commands written since the last update, in their order.
pub(super) fn carry_out(world: &mut World) {
    settle(world);
    let commands: Vec<RunCommand> = world.resource_mut::<Messages<RunCommand>>().drain().collect();
    for command in commands {
        let done = match command {
            RunCommand::Robot(command) => give_input(world, command, Later::Forgotten),
            RunCommand::World(command) => give_change(world, command, Later::Forgotten),
            RunCommand::Transport(command) => obey(world, command),
        };
        if let Err(error) = done {
            world.write_message(CommandRefused(error));
        }
    }
}

/// Reports the changes of worlds that were refused in the ticks since.
pub(super) fn report_changes(mut refused: ResMut<RefusedChanges>, mut messages: MessageWriter<CommandRefused>) {
    for change in refused.0.drain(..) {
        messages.write(CommandRefused(CommandError::Change(change)));
    }
}

/// Stamps a change of a world with the next tick. One that would be refused now is refused, and stays out of the
/// script. What it takes grows with the script only where the run does not go on from the script's end.
pub(crate) fn give_change(world: &mut World, command: WorldCommand, later: Later) -> Result<(), CommandError> {
    let WorldCommand { world: name, change } = command;
    let &Transport { tick, frontier, looping, .. } = world.resource::<Transport>();
    let Some(config) = world.get_resource::<RunConfig>().map(|config| Arc::clone(config.config())) else {
        return Ok(());
    };
    let event = WorldEvent { tick: tick + 1, world: name, change };
    let continues = tick < frontier || looping;
    check_count(world)?;
    let is_last = !continues && world.resource::<PendingInput>().is_last(event.tick);
    if is_last {
        world.resource_mut::<PendingInput>().check_last(&config, &event)?;
    } else {
        check_among(world, &config, &event, |c| {
            // those of the next tick are forgotten where the run continues from here
            if continues { c.tick <= tick } else { later == Later::Kept || c.tick <= event.tick }
        })?;
    }
    if let Some(refused) = refusal(world, &event) {
        return Err(CommandError::Change(refused));
    }
    if continues {
        continue_from_here(world);
    }
    if is_last {
        add_obstacle(world, &event);
    }
    let mut pending = world.resource_mut::<PendingInput>();
    match later {
        Later::Forgotten => pending.capture_change(event),
        Later::Kept => pending.add_change(event),
    }
    if !is_last {
        let changes = pending.script().changes.clone();
        sync_added(world, &changes);
    }
    Ok(())
}

/// Checks a change among those of the script that stay.
fn check_among(
    world: &World,
    config: &TourConfig,
    event: &WorldEvent,
    stays: impl Fn(&WorldEvent) -> bool,
) -> Result<(), ScriptError> {
    let mut changes = world.resource::<PendingInput>().script().changes.clone();
    changes.retain(stays);
    changes.insert(changes.partition_point(|c| c.tick <= event.tick), event.clone());
    let script = Script::new(Vec::new(), changes);
    script.check().and_then(|()| script.check_worlds(&config.worlds))
}

/// Stamps an input with the next tick. Input at a tick before the frontier, and any input to a looping run, continues
/// the run from there. An input that no script could hold (an unknown robot, a channel out of range) is refused and
/// counted, and forgets nothing.
pub(crate) fn give_input(world: &mut World, command: RobotCommand, later: Later) -> Result<(), CommandError> {
    let RobotCommand { robot, input } = command;
    let &Transport { tick, frontier, looping, .. } = world.resource::<Transport>();
    let known = world.get_resource::<Roster>().is_some_and(|roster| roster.named(&robot).is_some());
    let event = Event { tick: tick + 1, robot, input };
    let script = Script { events: vec![event.clone()], ..Script::empty() };
    let names = if known { vec![event.robot.as_str()] } else { Vec::new() };
    if let Err(error) = script.check().and_then(|()| script.check_robots(&names)) {
        world.resource_mut::<Refusals>().note(|| RefusedEvent::Command(Box::new(error.clone())));
        return Err(error.into());
    }
    check_count(world)?;
    if tick < frontier || looping {
        continue_from_here(world);
    }
    let mut pending = world.resource_mut::<PendingInput>();
    match later {
        Later::Forgotten => pending.capture(event),
        Later::Kept => pending.add(event),
    }
    Ok(())
}

/// Refuses one input more than a script may have.
fn check_count(world: &World) -> Result<(), ScriptError> {
    let Script { events, changes, .. } = world.resource::<PendingInput>().script();
    let count = events.len() + changes.len() + 1;
    if count > MAX_EVENTS { Err(ScriptProblem::TooMany(count).anywhere()) } else { Ok(()) }
}

/// Forgets all input after the present tick.
fn continue_from_here(world: &mut World) {
    let tick = world.resource::<Transport>().tick;
    world.resource_mut::<PendingInput>().truncate_after(tick);
    let changes = world.resource::<PendingInput>().script().changes.clone();
    sync_added(world, &changes);
    world.resource_mut::<Keyframes>().truncate_after(tick);
    if let Some(mut history) = world.get_resource_mut::<History>() {
        history.truncate_after(tick);
    }
    let mut transport = world.resource_mut::<Transport>();
    (transport.frontier, transport.looping) = (tick, false);
}

/// Starts a new run of the present configuration. Playback, speed and looping stay.
fn restart(world: &mut World, seed: Seed) -> Result<(), SpawnError> {
    let Some(now) = recipe(world) else { return Ok(()) };
    undo::checkpoint_before_new_run(world);
    let &Transport { playback, speed, looping, .. } = world.resource::<Transport>();
    start_recipe(world, Recipe { seed, script: Script::empty(), ..now })?;
    let mut transport = world.resource_mut::<Transport>();
    *transport = Transport { playback, speed, looping, ..*transport };
    Ok(())
}

/// Carries out a transport command.
pub(super) fn obey(world: &mut World, command: TransportCommand) -> Result<(), CommandError> {
    let &Transport { seed, tick, .. } = world.resource::<Transport>();
    let pause = |world: &mut World| world.resource_mut::<Transport>().playback = Playback::Paused;
    match command {
        TransportCommand::Play => world.resource_mut::<Transport>().playback = Playback::Playing,
        TransportCommand::Pause => pause(world),
        TransportCommand::Step => {
            pause(world);
            step(world);
        }
        TransportCommand::StepBack => {
            pause(world);
            seek(world, tick.saturating_sub(1))?;
        }
        TransportCommand::Seek(tick) => seek(world, tick)?,
        TransportCommand::ContinueFromHere => {
            undo::checkpoint(world);
            continue_from_here(world);
        }
        TransportCommand::Reset => restart(world, seed)?,
        TransportCommand::ReRoll => restart(world, re_rolled(seed))?,
        TransportCommand::SetSeed(seed) => restart(world, seed)?,
        TransportCommand::SetSpeed(speed) => {
            if (1.0 / 64.0..=64.0).contains(&speed) || speed == f64::INFINITY {
                world.resource_mut::<Transport>().speed = speed;
                if let Some(mut time) = world.get_resource_mut::<Time<Virtual>>() {
                    // as fast as possible is not the fixed loop's business
                    time.set_relative_speed_f64(if speed.is_finite() { speed } else { 1.0 });
                }
            }
        }
        TransportCommand::SetLooping(looping) => world.resource_mut::<Transport>().looping = looping,
        TransportCommand::Checkpoint => undo::checkpoint(world),
        TransportCommand::Undo => undo::undo(world)?,
        TransportCommand::Redo => undo::redo(world)?,
    }
    Ok(())
}
