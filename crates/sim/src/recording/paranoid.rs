//! `ParanoidRun`, a run that does each tick twice.

use std::fmt;
use std::slice::from_ref;

use bevy::app::App;

use super::{Recorder, RunError};
use crate::run::{Divergence, Recipe, first_divergence};
use crate::simulation::{PhaseState, SimulationSystems, watch_phases};

/// A run each of whose ticks is saved, stepped, restored and stepped again, and compared with itself.
///
/// A run is a pure function of its recipe if every tick is one of the frame before it. A robot, a tour or a system of a
/// program's own that keeps something elsewhere, in a `Local`, a static or a component that no frame holds, gives
/// another tick the second time. It takes somewhat more than twice as long as a run.
pub struct ParanoidRun {
    run: Recorder,
}

/// A tick that came out otherwise the second time.
#[derive(Clone, Debug, PartialEq)]
pub struct UnrepeatedTick {
    /// The tick.
    pub tick: u64,
    /// The first phase after which something differs. What a motion holds is seen after `Collide`.
    pub phase: SimulationSystems,
    /// The name of the robot of what differs first; `None` for what belongs to no robot.
    pub robot: Option<String>,
    /// Its control, if that differs.
    pub control: Option<UnrepeatedControl>,
    /// The first value that differs after that phase, or where a control does, in the tick's frame.
    pub value: Option<Divergence>,
}

/// A control that came out otherwise the second time.
#[derive(Clone, Debug, PartialEq)]
pub struct UnrepeatedControl {
    /// The control at first, as it prints.
    pub first: String,
    /// The control the second time.
    pub second: String,
}

impl fmt::Display for UnrepeatedTick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}, phase {:?}", self.tick, self.phase)?;
        self.robot.as_ref().map_or(Ok(()), |robot| write!(f, ", robot {robot:?}"))?;
        write!(f, ": it differs when it is stepped again from the frame before it")?;
        if let Some(UnrepeatedControl { first, second }) = &self.control {
            write!(f, "\ncontrol: first {first}, then {second}")?;
        }
        self.value.as_ref().map_or(Ok(()), |value| write!(f, "\n{value}"))
    }
}

impl ParanoidRun {
    /// The run of a recipe at tick 0, as [`Recorder::of_with_robots`].
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn of(recipe: &Recipe, add: impl FnOnce(&mut App)) -> Result<Self, RunError> {
        let watched = |app: &mut App| {
            add(app);
            watch_phases(app);
        };
        Ok(ParanoidRun { run: Recorder::of_with_robots(recipe, watched)?.without_keyframes() })
    }

    /// The run.
    pub fn recorder(&self) -> &Recorder {
        &self.run
    }

    /// Runs one tick twice. Returns where the second differs, if it does; the run goes on from the second.
    ///
    /// # Errors
    /// [`RunError::Restore`] where a frame does not fit its own run.
    pub fn step(&mut self) -> Result<Option<UnrepeatedTick>, RunError> {
        let before = self.run.frame().clone();
        let first = self.states();
        self.run.restore(&before)?;
        let second = self.states();
        let found = first.iter().zip(&second).find(|(a, b)| a.controls != b.controls || value(a, b).is_some());
        Ok(found.map(|(a, b)| self.difference([a, b], [&first, &second])))
    }

    /// Runs one tick and returns what stood after its phases.
    fn states(&mut self) -> Vec<PhaseState> {
        self.run.step();
        self.run.take_phases()
    }

    /// What differs after a phase, the first after which something does, of a tick whose last states are these.
    fn difference(&self, [a, b]: [&PhaseState; 2], [first, second]: [&[PhaseState]; 2]) -> UnrepeatedTick {
        let config = self.run.config();
        let differing = a.controls.iter().zip(&b.controls).position(|(a, b)| a != b);
        let control = |i: usize| UnrepeatedControl { first: a.controls[i].clone(), second: b.controls[i].clone() };
        let at_end = || first.last().zip(second.last()).and_then(|(a, b)| value(a, b));
        let value = value(a, b).or_else(at_end).map(|value| value.named(config));
        let id = differing.or_else(|| value.as_ref()?.robot.map(|id| id as usize));
        UnrepeatedTick {
            tick: a.frame.tick,
            phase: a.phase,
            robot: id.and_then(|id| config.robot_names().nth(id)).map(str::to_owned),
            control: differing.map(control),
            value,
        }
    }
}

/// The first value of the frames that differs.
fn value(a: &PhaseState, b: &PhaseState) -> Option<Divergence> {
    first_divergence(from_ref(&a.frame), from_ref(&b.frame))
}
