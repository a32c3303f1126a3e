//! `SimulationPlugin`, the simulation in a Bevy app.

use bevy::app::{RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy::prelude::*;

use super::obstacles::change::RefusedChanges;
use super::obstacles::roster::ObstacleRoster;
use super::schedule::{CrowdSystems, TickPhase, simulation_schedule};
use super::tick::world_crowds::WorldCrowds;
use super::tick::{input, sense, world_crowds};
use super::truth::thing::RunThing;
use super::truth::touched::AtStart::{Followed, PutBack};
use super::truth::touched::ForeignTouches;
use super::truth::watch::{watch as watch_unnamed, watch_components};
use super::{
    CommandRefused, Door, Keyframes, LatestFrame, MountedOn, ObstacleOf, ObstacleShape, PendingInput, Placement,
    Playback, Refusals, ResidesIn, RobotId, RobotKinds, RobotName, RobotOps, RobotPlugin, RunCommand, Scan,
    SceneRevision, SensorModel, SensorMount, SensorName, SensorNoise, SensorRefused, SensorRoster, SimulatedWorld,
    SimulationSchedule, SimulationSystems, Slip, StandingWorld, Transport, Undo, WorldScene, command, play_tick,
    settle, state,
};
use crate::run::DT;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{HITCH, RUSTY, Reach};

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
            .init_resource::<WorldCrowds>()
            .init_resource::<PendingInput>()
            .init_resource::<Keyframes>()
            .insert_resource(LatestFrame::of_no_run())
            .init_resource::<state::StateTakers>()
            .init_resource::<Undo>()
            .init_resource::<ObstacleRoster>()
            .init_resource::<RefusedChanges>()
            .init_resource::<Refusals>()
            .insert_resource(SensorRoster::none())
            .init_resource::<ForeignTouches>()
            .insert_resource(Transport::new(Seed(0)))
            .insert_resource(Time::<Fixed>::from_seconds(DT))
            .add_message::<RunCommand>()
            .add_message::<CommandRefused>()
            .add_message::<SensorRefused>()
            .add_systems(
                SimulationSchedule,
                (
                    (input::advance_tick, input::apply_inputs).chain().in_set(SimulationSystems::Input),
                    world_crowds::begin.in_set(TickPhase::Begin).in_set(CrowdSystems),
                    world_crowds::index.in_set(TickPhase::Index).in_set(CrowdSystems),
                    world_crowds::meet.in_set(TickPhase::Meet).in_set(CrowdSystems),
                    sense::sense.in_set(SimulationSystems::Sense),
                    state::record.in_set(SimulationSystems::Record),
                ),
            )
            .add_systems(RunFixedMainLoop, command::carry_out.in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop))
            .add_systems(RunFixedMainLoop, command::report_changes.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop))
            .add_systems(FixedUpdate, run_while_playing)
            .add_systems(Last, settle);
        watch(app.world_mut());
        app.add_plugins((
            RobotPlugin::new(RobotKind::RUSTY.name, RUSTY),
            RobotPlugin::new(RobotKind::REACH.name, Reach::<2>::workbench()),
            RobotPlugin::new(RobotKind::REACH3.name, Reach::<3>::redundant()),
            RobotPlugin::new(RobotKind::HITCH.name, HITCH),
        ));
    }
}

/// Watches the components of the run's entities that all robots have alike.
fn watch(world: &mut World) {
    watch_components!(world, PutBack, SimulatedWorld, WorldScene, SceneRevision, StandingWorld);
    watch_components!(world, Followed, ObstacleShape, Placement, Door, ObstacleOf);
    watch_components!(world, Followed, RobotName, ResidesIn);
    watch_components!(world, PutBack, RobotId, RobotOps, Slip, Scan);
    watch_components!(world, Followed, SensorModel, SensorName, SensorMount, SensorNoise, MountedOn);
    let thing = world.register_component::<RunThing>();
    watch_unnamed(world, &[thing]);
}

/// An app without a window: Bevy's `MinimalPlugins` and the [`SimulationPlugin`]. Everything else is yours to add:
/// robots by [`RobotPlugin`], systems, observers.
///
/// The simulation runs in `FixedUpdate` while the [`Transport`] plays, and gives the frames that a
/// [`Recorder`](crate::recording::Recorder) of the same seed, configuration and script gives, at any rate of updates.
/// Commands ([`RunCommand`]) written before an update's fixed loop apply at the next tick and become part of the
/// script. `run()` plays in real time; with `TimeUpdateStrategy::ManualDuration` each `update()` is as long as you say.
///
/// ```
/// use bevy::time::TimeUpdateStrategy;
/// use motion_lab_sim::simulation::{LatestFrame, Playback, Transport, headless_app, start_run};
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
/// use std::time::Duration;
///
/// let mut app = headless_app();
/// start_run(app.world_mut(), TourConfig::default(), BOOK_SEED)?;
/// app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
/// // a tick is 50 ms; the first update is where time begins
/// app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
/// (0..=10).for_each(|_| app.update());
/// assert_eq!(app.world().resource::<LatestFrame>().frame().tick, 10);
/// # Ok::<(), motion_lab_sim::simulation::SpawnError>(())
/// ```
pub fn headless_app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin));
    app
}

fn run_while_playing(world: &mut World) {
    let &Transport { playback, speed, .. } = world.resource::<Transport>();
    if playback == Playback::Playing && speed.is_finite() {
        play_tick(world);
    }
}
