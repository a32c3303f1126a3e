//! `SimulationPlugin`, the simulation in a Bevy app.

use bevy::app::{RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy::prelude::*;

use super::schedule::{Phase, simulation_schedule};
use super::tick::starts::{Starts, Sweeps, gather_starts};
use super::tick::{input, sense};
use super::{
    CommandRefused, Keyframes, LatestFrame, PendingInput, Playback, RobotKinds, RobotPlugin, RunCommand, SensorRefused,
    SensorRoster, SimulationSchedule, SimulationSystems, Transport, Undo, command, play_tick, sensors, state,
};
use crate::configuration::RobotKind;
use crate::random::Seed;
use crate::robots::{HITCH, RUSTY, Reach};
use crate::run::DT;

/// The simulation: the same in a window, without one, and on the web.
///
/// It adds the [`SimulationSchedule`] with the systems of the lab's robots, and an exclusive system in `FixedUpdate`,
/// at 20 Hz, that runs it while the [`Transport`] plays. Messages ([`RunCommand`]) are taken
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
            .init_resource::<SensorRoster>()
            .insert_resource(Transport::new(Seed(0)))
            .insert_resource(Time::<Fixed>::from_seconds(DT))
            .add_message::<RunCommand>()
            .add_message::<CommandRefused>()
            .add_message::<SensorRefused>()
            .add_observer(sensors::changed)
            .add_observer(sensors::removed)
            .add_systems(
                SimulationSchedule,
                (
                    (input::advance_tick, input::apply_inputs).chain().in_set(SimulationSystems::Input),
                    gather_starts.in_set(Phase::Gather),
                    sense::sense.in_set(SimulationSystems::Sense),
                    state::record.in_set(SimulationSystems::Record),
                ),
            )
            .add_systems(RunFixedMainLoop, command::carry_out.in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop))
            .add_systems(FixedUpdate, run_while_playing);
        app.add_plugins((
            RobotPlugin::new(RobotKind::RUSTY.name, RUSTY),
            RobotPlugin::new(RobotKind::REACH.name, Reach::<2>::workbench()),
            RobotPlugin::new(RobotKind::REACH3.name, Reach::<3>::redundant()),
            RobotPlugin::new(RobotKind::HITCH.name, HITCH),
        ));
    }
}

fn run_while_playing(world: &mut World) {
    let Transport { playback, speed, .. } = *world.resource::<Transport>();
    if playback == Playback::Playing && speed.is_finite() {
        play_tick(world);
    }
}
