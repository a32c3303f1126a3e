//! `SimulationPlugin`, the simulation in a Bevy app.

use bevy::app::{RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy::prelude::*;

use super::schedule::{Phase, simulation_schedule};
use super::tick::starts::{Starts, Sweeps, gather_starts};
use super::tick::{input, sense};
use super::transport::re_rolled;
use super::{
    History, Keyframes, LatestFrame, PendingInput, Playback, RobotCommand, RobotKinds, RobotName, RobotPlugin,
    RunConfig, SimulationSchedule, SimulationSystems, SpawnError, Transport, TransportCommand, Undo, play_tick, seek,
    start_run_in_order, state, step, undo,
};
use crate::random::Seed;
use crate::robots::{HITCH, RUSTY, Reach};
use crate::run::{DT, Event, Script};

/// The simulation: the same in a window, without one, and on the web.
///
/// It adds the [`SimulationSchedule`] with the systems of the lab's robots, and an exclusive system in `FixedUpdate`,
/// at 20 Hz, that runs it while the [`Transport`] plays. Messages ([`TransportCommand`], [`RobotCommand`]) are taken
/// before the fixed loop. A run begins with [`start_run`](super::start_run).
#[derive(Clone, Copy, Debug, Default)]
pub struct SimulationPlugin;

impl Plugin for SimulationPlugin {
    fn build(&self, app: &mut App) {
        app.add_schedule(simulation_schedule())
            .init_resource::<RobotKinds>()
            .init_resource::<Starts>()
            .init_resource::<Sweeps>()
            .init_resource::<PendingInput>()
            .init_resource::<Keyframes>()
            .init_resource::<LatestFrame>()
            .init_resource::<Undo>()
            .insert_resource(Transport::new(Seed(0)))
            .insert_resource(Time::<Fixed>::from_seconds(DT))
            .add_message::<TransportCommand>()
            .add_message::<RobotCommand>()
            .add_systems(
                SimulationSchedule,
                (
                    (input::advance_tick, input::apply_inputs).chain().in_set(SimulationSystems::Input),
                    gather_starts.in_set(Phase::Gather),
                    sense::sense.in_set(SimulationSystems::Sense),
                    state::record.in_set(SimulationSystems::Record),
                ),
            )
            .add_systems(
                RunFixedMainLoop,
                (take_checkpoints, take_robot_commands, take_transport_commands)
                    .chain()
                    .in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop),
            )
            .add_systems(FixedUpdate, run_while_playing);
        app.add_plugins((
            RobotPlugin::new("rusty", RUSTY),
            RobotPlugin::new("reach", Reach::<2>::workbench()),
            RobotPlugin::new("reach3", Reach::<3>::redundant()),
            RobotPlugin::new("hitch", HITCH),
        ));
    }
}

/// Forgets all input after the present tick.
fn continue_from_here(world: &mut World) {
    let tick = world.resource::<Transport>().tick;
    world.resource_mut::<PendingInput>().truncate_after(tick);
    world.resource_mut::<Keyframes>().truncate_after(tick);
    if let Some(mut history) = world.get_resource_mut::<History>() {
        history.truncate_after(tick);
    }
    let mut transport = world.resource_mut::<Transport>();
    (transport.frontier, transport.looping) = (tick, false);
}

/// Starts a new run of the present configuration. Playback, speed and looping stay.
fn restart(world: &mut World, seed: Seed) -> Result<(), SpawnError> {
    let Some(RunConfig(config)) = world.get_resource::<RunConfig>().cloned() else { return Ok(()) };
    undo::checkpoint_before_new_run(world);
    let Transport { playback, speed, looping, .. } = *world.resource::<Transport>();
    let order: Vec<usize> = (0..config.worlds.iter().map(|w| w.robots.len()).sum()).collect();
    start_run_in_order(world, config, (seed, Script::empty()).into(), &order)?;
    let mut transport = world.resource_mut::<Transport>();
    *transport = Transport { playback, speed, looping, ..*transport };
    Ok(())
}

/// Carries out a transport command.
///
/// # Errors
/// The refusal of [`seek`] or of a new run, as text. Neither occurs in a run that was started.
pub fn obey(world: &mut World, command: TransportCommand) -> Result<(), String> {
    let Transport { seed, tick, .. } = *world.resource::<Transport>();
    let pause = |world: &mut World| world.resource_mut::<Transport>().playback = Playback::Paused;
    let to = |world: &mut World, tick| seek(world, tick).map_err(|e| e.to_string());
    let anew = |world: &mut World, seed| restart(world, seed).map_err(|e| e.to_string());
    match command {
        TransportCommand::Play => world.resource_mut::<Transport>().playback = Playback::Playing,
        TransportCommand::Pause => pause(world),
        TransportCommand::Step => {
            pause(world);
            step(world);
        }
        TransportCommand::StepBack => {
            pause(world);
            to(world, tick.saturating_sub(1))?;
        }
        TransportCommand::Seek(tick) => to(world, tick)?,
        TransportCommand::ContinueFromHere => {
            undo::checkpoint(world);
            continue_from_here(world);
        }
        TransportCommand::Reset => anew(world, seed)?,
        TransportCommand::ReRoll => anew(world, re_rolled(seed))?,
        TransportCommand::SetSeed(seed) => anew(world, seed)?,
        TransportCommand::SetSpeed(speed) => {
            if (1.0 / 64.0..=64.0).contains(&speed) || speed == f64::INFINITY {
                world.resource_mut::<Transport>().speed = speed;
                if let Some(mut time) = world.get_resource_mut::<Time<Virtual>>() {
                    // "as fast as possible" is not run by the fixed loop
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

/// Stamps incoming inputs with the next tick. Input at a tick before the frontier, and any input to a looping run,
/// continues the run from there. An input that no script could hold (an unknown robot, a channel out of range) is
/// ignored.
fn take_robot_commands(world: &mut World) {
    let commands: Vec<RobotCommand> = world.resource_mut::<Messages<RobotCommand>>().drain().collect();
    if commands.is_empty() {
        return;
    }
    let Transport { tick, frontier, looping, .. } = *world.resource::<Transport>();
    let names: Vec<String> = world.query::<&RobotName>().iter(world).map(|n| n.name.clone()).collect();
    let event = |RobotCommand { robot, input }| Event { tick: tick + 1, robot, input };
    let holds = |event: &Event| {
        names.contains(&event.robot) && (Script { events: vec![event.clone()], ..Script::empty() }).check().is_ok()
    };
    let events: Vec<Event> = commands.into_iter().map(event).filter(holds).collect();
    // an ignored input leaves the later ticks alone
    if (tick < frontier || looping) && !events.is_empty() {
        continue_from_here(world);
    }
    let mut pending = world.resource_mut::<PendingInput>();
    events.into_iter().for_each(|event| pending.capture(event));
}

/// Sets a checkpoint before this update's input, whatever order the messages came in.
fn take_checkpoints(world: &mut World) {
    let commands: Vec<TransportCommand> = world.resource_mut::<Messages<TransportCommand>>().drain().collect();
    let (checkpoints, others): (Vec<_>, Vec<_>) =
        commands.into_iter().partition(|command| *command == TransportCommand::Checkpoint);
    if !checkpoints.is_empty() {
        undo::checkpoint(world);
    }
    others.into_iter().for_each(|command| _ = world.write_message(command));
}

fn take_transport_commands(world: &mut World) {
    let commands: Vec<TransportCommand> = world.resource_mut::<Messages<TransportCommand>>().drain().collect();
    for command in commands {
        // a command that cannot be obeyed leaves the run where it was
        let _ = obey(world, command);
    }
}

fn run_while_playing(world: &mut World) {
    let Transport { playback, speed, .. } = *world.resource::<Transport>();
    if playback == Playback::Playing && speed.is_finite() {
        play_tick(world);
    }
}
