//! `Undo`, earlier versions of the run's input.

use std::sync::Arc;

use bevy::prelude::*;

use super::obstacles::sync::sync_added;
use super::{
    CommandError, History, Keyframes, PendingInput, Playback, RunConfig, Transport, is_under_way, recipe, restore,
    seek, start_recipe,
};
use crate::run::{Recipe, Script};

/// Largest number of checkpoints.
const MAX_CHECKPOINTS: usize = 200;

/// A run, and the tick at which it stood.
#[derive(Clone, Debug)]
struct Checkpoint {
    recipe: Recipe,
    tick: u64,
    frontier: u64,
    /// Whether a new run began after it, which is a step even with the same input.
    ends: bool,
}

impl Checkpoint {
    fn of(world: &World) -> Option<Self> {
        let &Transport { tick, frontier, .. } = world.resource::<Transport>();
        Some(Checkpoint { recipe: recipe(world)?, tick, frontier, ends: false })
    }

    /// Whether the run under way has the same input, at whatever tick. `false` if a new run began after `self`.
    fn is_now(&self, world: &World) -> bool {
        !self.ends && is_under_way(world, &self.recipe)
    }
}

/// Earlier inputs of the run, for undo, and undone ones, for redo. Playing on adds none.
#[derive(Resource, Clone, Debug, Default)]
pub struct Undo {
    past: Vec<Checkpoint>,
    future: Vec<Checkpoint>,
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
    let Some(undo) = world.get_resource::<Undo>() else { return false };
    !undo.past.iter().rev().all(|checkpoint| checkpoint.is_now(world))
}

/// Remembers the present input before a change: what follows, up to the next checkpoint, is undone as one.
pub fn checkpoint(world: &mut World) {
    push(world, false);
}

/// [`checkpoint`] before a new run in place of this one.
pub(super) fn checkpoint_before_new_run(world: &mut World) {
    push(world, true);
}

/// Takes another script for the run, and goes to a tick, up to which the run goes then. An undo brings back the run as
/// it was. The run is paused.
///
/// # Errors
/// [`CommandError::Script`] of a script that no run of this configuration could have; it changes nothing.
pub fn take_script(world: &mut World, script: Script, tick: u64) -> Result<(), CommandError> {
    let Some(now) = recipe(world) else { return Ok(()) };
    let names: Vec<&str> = now.config.robot_names().collect();
    script.check()?;
    script.check_robots(&names)?;
    script.check_worlds(&now.config.worlds)?;
    checkpoint(world);
    apply(world, Checkpoint { recipe: Recipe { script, ..now.clone() }, tick, frontier: tick, ends: false })
}

fn push(world: &mut World, ends: bool) {
    let Some(now) = Checkpoint::of(world).map(|now| Checkpoint { ends, ..now }) else { return };
    let changed_nothing = world.resource::<Undo>().past.last().is_some_and(|last| last.is_now(world));
    let mut undo = world.resource_mut::<Undo>();
    undo.future.clear();
    // a gesture that changed nothing leaves none, only the later tick
    if changed_nothing {
        undo.past.pop();
    }
    undo.past.push(now);
    if undo.past.len() > MAX_CHECKPOINTS {
        undo.past.remove(0);
    }
}

/// Restores the input and the tick of the last checkpoint that a change followed. The run is paused.
///
/// # Errors
/// [`CommandError`] when a start or a seek is refused. It does not occur for a run that has run before.
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
    from: fn(&mut Undo) -> &mut Vec<Checkpoint>,
    to: fn(&mut Undo) -> &mut Vec<Checkpoint>,
) -> Result<(), CommandError> {
    let Some(now) = Checkpoint::of(world) else { return Ok(()) };
    loop {
        let Some(then) = from(&mut world.resource_mut::<Undo>()).pop() else { return Ok(()) };
        if !then.is_now(world) {
            to(&mut world.resource_mut::<Undo>()).push(Checkpoint { ends: then.ends, ..now });
            return apply(world, then);
        }
    }
}

fn apply(world: &mut World, then: Checkpoint) -> Result<(), CommandError> {
    let Checkpoint { recipe, tick, frontier, .. } = then;
    let &Transport { seed: present, speed, looping, .. } = world.resource::<Transport>();
    let same_run =
        world.get_resource::<RunConfig>().is_some_and(|c| Arc::ptr_eq(&c.0, &recipe.config)) && recipe.seed == present;
    if same_run {
        // the run is the same up to the tick where the scripts differ
        let shared = shared_ticks(world.resource::<PendingInput>().script(), &recipe.script);
        let keep = if shared < tick { shared } else { tick };
        sync_added(world, &recipe.script.changes);
        world.insert_resource(PendingInput::new(recipe.script));
        world.resource_mut::<Keyframes>().truncate_after(shared);
        if let Some(mut history) = world.get_resource_mut::<History>() {
            history.truncate_after(shared);
        }
        let start = world.resource::<Keyframes>().before(keep).cloned();
        if let Some(frame) = start {
            restore(world, &frame)?;
        }
    } else {
        start_recipe(world, recipe)?;
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
    use crate::run::{Event, RobotInput};
    use crate::simulation::{
        HistoryPlugin, LatestFrame, RobotCommand, RunCommand, SimulationPlugin, TransportCommand, snapshot, start_run,
        step,
    };
    use crate::tour::{BOOK_SEED, TourConfig};
    use motion_lab_core::random::Seed;

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
    fn another_script_is_a_branch_that_an_undo_takes_back() {
        let mut app = app();
        drive(&mut app, 128);
        advance(&mut app, 60);
        let before = state(&mut app);
        let event = |tick, v| Event { tick, robot: "Rusty".into(), input: RobotInput::Drive(v, 0) };
        let script = Script::new(vec![before.0.events[0].clone(), event(31, 0), event(35, 64)], vec![]);
        take_script(app.world_mut(), script.clone(), 30).unwrap();
        let (taken, frame, frontier) = state(&mut app);
        assert_eq!((taken, frame.tick, frontier), (script.clone(), 30, 30));
        advance(&mut app, 3);
        let there = snapshot(app.world()).robots[0].configuration[0];
        advance(&mut app, 1);
        assert_eq!(snapshot(app.world()).robots[0].configuration[0], there, "it stands from tick 31 to 34");
        advance(&mut app, 4);
        assert_ne!(snapshot(app.world()).robots[0].configuration[0], there, "what comes later in the script comes");
        command(&mut app, TransportCommand::Undo);
        assert_eq!(state(&mut app), before);
        let unknown = Script::new(vec![Event { robot: "Nobody".into(), ..event(31, 0) }], vec![]);
        assert!(take_script(app.world_mut(), unknown, 30).is_err());
        assert_eq!(state(&mut app), before);
    }

    #[test]
    fn a_reset_and_a_new_seed_can_be_undone() {
        let mut app = app();
        advance(&mut app, 40);
        let before = state(&mut app);
        for new in [TransportCommand::Reset, TransportCommand::ReRoll, TransportCommand::SetSeed(Seed(7))] {
            command(&mut app, new);
            assert_eq!(app.world().resource::<LatestFrame>().frame().tick, 0);
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
