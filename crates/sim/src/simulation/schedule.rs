//! The one schedule that is the simulation.

use bevy::ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use bevy::prelude::*;

use super::tick::world_crowds::WorldCrowds;

/// One tick of the simulation, whoever runs it: the fixed loop of a window, the recorder, a replay, the step button, a
/// seek.
///
/// Single-threaded, and two systems that could run in either order are an error. Inside it there is no `Time`, no
/// `Local`, no message, no spawning and no reliance on the order of entities.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SimulationSchedule;

/// The parts of a tick, in this order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SimulationSystems {
    /// The tick begins, and its inputs apply.
    Input,
    /// Each robot's tour or driver gives its control.
    Drive,
    /// The control gives the tick's motion; robots of one world get their bodies, and an index of who is near whom.
    Step,
    /// The motions are cut where they would hit, contacts are counted, configurations advance.
    Collide,
    /// The range sensors scan.
    Sense,
    /// The frame is taken.
    Record,
}

/// The order of a phase's generic systems: one robot type after the other, in the order of registration.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum KindSystems {
    Drive(usize),
    Plan(usize),
    Cut(usize),
    Settle(usize),
}

/// The finer order within [`SimulationSystems::Step`] and [`SimulationSystems::Collide`]: every motion is planned,
/// every motion is cut, those that meet are found, and only then do robots advance.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum TickPhase {
    Begin,
    Plan,
    Index,
    Cut,
    Meet,
    Settle,
}

/// What a tick does only where some world has more than one robot.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct CrowdSystems;

/// The empty schedule with its sets in order.
pub(super) fn simulation_schedule() -> Schedule {
    let mut schedule = Schedule::new(SimulationSchedule);
    schedule.set_executor(SingleThreadedExecutor::new());
    schedule.set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..default() });
    schedule.configure_sets(
        (
            SimulationSystems::Input,
            SimulationSystems::Drive,
            SimulationSystems::Step,
            SimulationSystems::Collide,
            SimulationSystems::Sense,
            SimulationSystems::Record,
        )
            .chain(),
    );
    schedule
        .configure_sets((TickPhase::Begin, TickPhase::Plan, TickPhase::Index).chain().in_set(SimulationSystems::Step));
    schedule.configure_sets(
        (TickPhase::Cut, TickPhase::Meet, TickPhase::Settle).chain().in_set(SimulationSystems::Collide),
    );
    schedule.configure_sets(CrowdSystems.run_if(WorldCrowds::are_there));
    schedule
}
