//! `PhaseStates`, what stands after each phase of a tick, for finding where two runs of one tick part.

use bevy::prelude::*;

use crate::run::Frame;
use crate::simulation::{RobotOps, Roster, SimulationSchedule, SimulationSystems, snapshot};

/// What stands after a phase of a tick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PhaseState {
    /// The phase.
    pub(crate) phase: SimulationSystems,
    /// The robots, the obstacles and the scans so far.
    pub(crate) frame: Frame,
    /// The robots' controls, as they print, by ascending id; none before the tick has given them.
    pub(crate) controls: Vec<String>,
}

/// The states after the phases of the latest tick, of an app that [`watch_phases`] has prepared.
#[derive(Resource, Default)]
pub(crate) struct PhaseStates(pub(crate) Vec<PhaseState>);

/// The phases after which something of a robot may differ that can be named, each with the next. The motion that
/// `Step` plans has no text; what differs in it is seen where the robot ends, after `Collide`.
const SEEN: [(SimulationSystems, SimulationSystems); 4] = [
    (SimulationSystems::Input, SimulationSystems::Drive),
    (SimulationSystems::Drive, SimulationSystems::Step),
    (SimulationSystems::Collide, SimulationSystems::Sense),
    (SimulationSystems::Sense, SimulationSystems::Record),
];

/// Keeps what stands after each phase of every tick. It reads only, so it may stand anywhere among other systems.
pub(crate) fn watch_phases(app: &mut App) {
    app.init_resource::<PhaseStates>();
    for (phase, next) in SEEN {
        let keep = move |world: &mut World| keep(world, phase);
        app.add_systems(SimulationSchedule, keep.after(phase).before(next).ambiguous_with_all());
    }
}

fn keep(world: &mut World, phase: SimulationSystems) {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    let control = |&robot: &Entity| (world.get::<RobotOps>(robot)?.control)(world, robot);
    let driven = if phase == SimulationSystems::Input { &[][..] } else { robots };
    let controls = driven.iter().map(|robot| control(robot).unwrap_or_default()).collect();
    let state = PhaseState { phase, frame: snapshot(world), controls };
    world.resource_mut::<PhaseStates>().0.push(state);
}
