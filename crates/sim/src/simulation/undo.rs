//! `Undo`, earlier versions of the run's input.

use std::sync::Arc;

use bevy::prelude::*;

use super::obstacles::roster::sync_added;
use super::{
    CommandError, History, Keyframes, PendingInput, Playback, RunConfig, Transport, restore, seek, start_run_in_order,
};
use crate::run::Script;
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;

/// Largest number of versions kept.
const MOST: usize = 200;

/// A run's input, and the tick at which the run stood.
#[derive(Clone, Debug)]
struct Version {
    config: Arc<TourConfig>,
    seed: Seed,
    script: Script,
    tick: u64,
    frontier: u64,
    /// Whether a new run began after it, which is a step even with the same input.
    ends: bool,
}

impl Version {
    fn of(world: &World) -> Option<Self> {
        let Transport { seed, tick, frontier, .. } = *world.resource::<Transport>();
        let config = Arc::clone(&world.get_resource::<RunConfig>()?.0);
        Some(Version {
            config,
            seed,
            script: world.resource::<PendingInput>().script().clone(),
            tick,
            frontier,
            ends: false,
        })
    }

    /// Whether both have the same input, at whatever tick. `false` if a new run began after `self`.
    fn is(&self, other: &Version) -> bool {
        self.has(&other.config, other.seed, &other.script)
    }

    fn has(&self, config: &Arc<TourConfig>, seed: Seed, script: &Script) -> bool {
        !self.ends && Arc::ptr_eq(&self.config, config) && self.seed == seed && self.script == *script
    }
}

/// Earlier versions of the run's input, for undo, and undone ones, for redo. Playing on adds none.
#[derive(Resource, Clone, Debug, Default)]
pub struct Undo {
    past: Vec<Version>,
    future: Vec<Version>,
}

impl Undo {
    /// Whether something can be undone.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether something undone can be done again.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

/// Whether an undo changes the run: whether a change followed a checkpoint.
pub fn undoes(world: &World) -> bool {
    let (Some(config), Some(past)) = (world.get_resource::<RunConfig>(), world.get_resource::<Undo>()) else {
        return false;
    };
    let (seed, script) = (world.resource::<Transport>().seed, world.resource::<PendingInput>().script());
    !past.past.iter().rev().all(|version| version.has(&config.0, seed, script))
}

/// Remembers the present input before a change: what follows, up to the next checkpoint, is undone as one.
pub fn checkpoint(world: &mut World) {
    push(world, false);
}

/// [`checkpoint`] before a new run in place of this one.
pub(super) fn checkpoint_before_new_run(world: &mut World) {
    push(world, true);
}

fn push(world: &mut World, ends: bool) {
    let Some(now) = Version::of(world).map(|version| Version { ends, ..version }) else { return };
    let mut undo = world.resource_mut::<Undo>();
    undo.future.clear();
    // a gesture that changed nothing leaves no version, only the later tick
    if undo.past.last().is_some_and(|last| last.is(&now)) {
        undo.past.pop();
    }
    undo.past.push(now);
    if undo.past.len() > MOST {
        undo.past.remove(0);
    }
}

/// Restores the input and the tick of the last checkpoint that a change followed. The run is paused.
///
/// # Errors
/// [`CommandError`] when a start or a seek is refused. It does not occur for a version that has run.
pub(super) fn undo(world: &mut World) -> Result<(), CommandError> {
    travel(world, |undo| &mut undo.past, |undo| &mut undo.future)
}

/// The reverse of [`undo`].
///
/// # Errors
/// As [`undo`].
pub(super) fn redo(world: &mut World) -> Result<(), CommandError> {
    travel(world, |undo| &mut undo.future, |undo| &mut undo.past)
}

fn travel(
    world: &mut World,
    from: fn(&mut Undo) -> &mut Vec<Version>,
    to: fn(&mut Undo) -> &mut Vec<Version>,
) -> Result<(), CommandError> {
    let Some(now) = Version::of(world) else { return Ok(()) };
    loop {
        let Some(version) = from(&mut world.resource_mut::<Undo>()).pop() else { return Ok(()) };
        if !version.is(&now) {
            to(&mut world.resource_mut::<Undo>()).push(Version { ends: version.ends, ..now });
            return apply(world, version);
        }
    }
}

fn apply(world: &mut World, version: Version) -> Result<(), CommandError> {
    let Version { config, seed, script, tick, frontier, .. } = version;
    let Transport { seed: present, speed, looping, .. } = *world.resource::<Transport>();
    let same_run = world.get_resource::<RunConfig>().is_some_and(|c| Arc::ptr_eq(&c.0, &config)) && seed == present;
    if same_run {
        // the run is the same up to the tick where the scripts differ
        let shared = shared_ticks(world.resource::<PendingInput>().script(), &script);
        let keep = if shared < tick { shared } else { tick };
        sync_added(world, &script.changes);
        world.insert_resource(PendingInput::new(script));
        world.resource_mut::<Keyframes>().truncate_after(shared);
        if let Some(mut history) = world.get_resource_mut::<History>() {
            history.truncate_after(shared);
        }
        let start = world.resource::<Keyframes>().before(keep).cloned();
        if let Some(frame) = start {
            restore(world, &frame)?;
        }
    } else {
        let count = config.worlds.iter().map(|w| w.robots.len()).sum();
        let order: Vec<usize> = (0..count).collect();
        start_run_in_order(world, config, (seed, script).into(), &order)?;
    }
    // first to the frontier, so that the history ahead is known; then back to the tick
    for to in [frontier, tick] {
        seek(world, to)?;
    }
    let mut transport = world.resource_mut::<Transport>();
    *transport = Transport { playback: Playback::Paused, speed, looping, frontier, ..*transport };
    Ok(())
}

/// The last tick up to which two scripts have the same input.
fn shared_ticks(a: &Script, b: &Script) -> u64 {
    let same = a.events.iter().zip(&b.events).take_while(|(a, b)| a == b).count();
    let same_changes = a.changes.iter().zip(&b.changes).take_while(|(a, b)| a == b).count();
    let events = [a.events.get(same), b.events.get(same)].into_iter().flatten().map(|e| e.tick);
    let changes = [a.changes.get(same_changes), b.changes.get(same_changes)].into_iter().flatten().map(|c| c.tick);
    events.chain(changes).min().map_or(u64::MAX, |tick| tick.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::super::command::obey;
    use super::*;
    use crate::run::RobotInput;
    use crate::simulation::{
        HistoryPlugin, LatestFrame, RobotCommand, RunCommand, SimulationPlugin, TransportCommand, snapshot, start_run,
        step,
    };
    use crate::tour::BOOK_SEED;

    fn app() -> App {
        let mut app = App::new();
        app.add_plugins((bevy::time::TimePlugin, SimulationPlugin, HistoryPlugin));
        start_run(app.world_mut(), TourConfig::default(), BOOK_SEED).unwrap();
        app.update();
        app
    }

    fn drive(app: &mut App, v: i16) {
        let input = RobotInput::Drive(v, 0);
        app.world_mut().write_message(RunCommand::from(RobotCommand { robot: "Rusty".into(), input }));
        app.update();
    }

    fn advance(app: &mut App, ticks: u64) {
        (0..ticks).for_each(|_| step(app.world_mut()));
    }

    fn state(app: &mut App) -> (Script, crate::run::Frame, u64) {
        let world = app.world_mut();
        (world.resource::<PendingInput>().script().clone(), snapshot(world), world.resource::<Transport>().frontier)
    }

    fn command(app: &mut App, command: TransportCommand) {
        obey(app.world_mut(), command).unwrap();
    }

    #[test]
    fn a_gesture_that_changed_nothing_is_nothing_to_undo() {
        let mut app = app();
        advance(&mut app, 50);
        assert!(!undoes(app.world()));
        command(&mut app, TransportCommand::Checkpoint);
        assert!(app.world().resource::<Undo>().can_undo() && !undoes(app.world()));
        drive(&mut app, 128);
        assert!(undoes(app.world()));
    }

    #[test]
    fn an_undo_restores_the_script_and_the_place_and_a_redo_does_it_again() {
        let mut app = app();
        advance(&mut app, 150);
        let touring = state(&mut app);
        // one gesture: two changes after one checkpoint
        app.world_mut().write_message(RunCommand::from(TransportCommand::Checkpoint));
        drive(&mut app, 128);
        advance(&mut app, 30);
        drive(&mut app, 0);
        advance(&mut app, 20);
        let driven = state(&mut app);
        assert_eq!(driven.0.events.len(), 2);
        command(&mut app, TransportCommand::Undo);
        assert_eq!(state(&mut app), touring);
        assert!(app.world().resource::<Undo>().can_redo() && !app.world().resource::<Undo>().can_undo());
        command(&mut app, TransportCommand::Redo);
        assert_eq!(state(&mut app), driven);
        let trail = app.world().resource::<History>().at(200, 0).unwrap().clone();
        assert!(trail.manual, "the history went along");
    }

    #[test]
    fn a_reset_and_a_new_seed_can_be_undone() {
        let mut app = app();
        advance(&mut app, 40);
        let before = state(&mut app);
        for new in [TransportCommand::Reset, TransportCommand::ReRoll, TransportCommand::SetSeed(Seed(7))] {
            command(&mut app, new);
            assert_eq!(app.world().resource::<LatestFrame>().0.tick, 0);
            command(&mut app, TransportCommand::Undo);
            assert_eq!(state(&mut app), before, "{new:?}");
        }
    }

    #[test]
    fn a_gesture_that_came_to_nothing_is_no_step() {
        let mut app = app();
        advance(&mut app, 10);
        app.world_mut().write_message(RunCommand::from(TransportCommand::Checkpoint));
        drive(&mut app, 128);
        advance(&mut app, 10);
        command(&mut app, TransportCommand::Checkpoint);
        command(&mut app, TransportCommand::Checkpoint);
        command(&mut app, TransportCommand::Undo);
        assert_eq!(state(&mut app).0, Script::empty());
    }
}
