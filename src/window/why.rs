//! Why a contact came about: the last chance of the run on the screen, and the way out as a branch of it.

use std::sync::Arc;

use bevy::prelude::*;

use super::background;
use crate::window::ui::{Interface, Notice, ScriptMark, ShownDashboard, front};
use motion_lab_sim::avoid::{AddKinds, EvasionSet, Explaining};
use motion_lab_sim::run::{Recipe, seconds};
use motion_lab_sim::simulation::{
    Happening, History, PendingInput, Playback, RobotKinds, RunConfig, TickMark, Transport, recipe, take_script,
};
use motion_lab_sim::tour::TourConfig;

/// The contact that is asked about when a run stands at a tick: the last that has begun of a robot that is in front,
/// else of any robot, else the next.
fn contact_at(history: &History, tick: u64, is_in_front: impl Fn(u32) -> bool) -> Option<TickMark> {
    let marks = history.marks();
    let (before, after) = marks.split_at(marks.partition_point(|mark| mark.tick <= tick));
    let is_contact = |mark: &&TickMark| mark.what == Happening::Contact;
    let begun = || before.iter().rev().filter(is_contact);
    let found = begun().find(|mark| is_in_front(mark.robot)).or_else(|| begun().next());
    found.or_else(|| after.iter().find(is_contact)).copied()
}

/// The contact that is asked about now: of the world in front before those of the others.
fn contact_now(world: &World) -> Option<TickMark> {
    let cockpits = &world.resource::<ShownDashboard>().0.cockpits;
    let in_front = front(cockpits, &world.resource::<Interface>().0).map(|(_, cockpit)| &cockpit.robots);
    let is_in_front = |id| in_front.is_some_and(|robots| robots.iter().any(|robot| robot.id == id));
    contact_at(world.resource::<History>(), world.resource::<Transport>().tick(), is_in_front)
}

/// Plays the way out of the contact at the present tick, where that was explained; else begins to explain it.
pub fn ask(world: &mut World) {
    let here = contact_now(world).map(|mark| (mark.robot, mark.tick));
    let known = world.resource::<Interface>().0.chance.as_ref().filter(|chance| chance.way_out.is_some());
    if known.is_some_and(|chance| Some((chance.robot, chance.contact)) == here) {
        play_way_out(world);
    } else {
        explain(world);
    }
}

/// Begins to explain the contact at the present tick, in the background.
pub fn explain(world: &mut World) {
    background::stop(world);
    let frontier = world.resource::<Transport>().frontier();
    let (Some(mark), Some(now)) = (contact_now(world), recipe(world)) else {
        return say(world, "No robot has touched anything yet.".into(), false);
    };
    let Some(robot) = now.config.robot_names().nth(mark.robot as usize).map(str::to_owned) else { return };
    // what lies ahead of the run is not known: it ends where it has come to
    let config = Arc::new(TourConfig { ticks: frontier, ..TourConfig::clone(&now.config) });
    let kinds = world.resource::<RobotKinds>().clone();
    let add: AddKinds = Arc::new(move |app: &mut App| kinds.add_to(app));
    let run = Recipe { config, ..now };
    match Explaining::with_robots(&run, (&robot, mark.tick), &EvasionSet::default(), Some(add)) {
        Ok(explaining) => background::explain(world, explaining, &robot),
        Err(error) => say(world, error.to_string(), true),
    }
}

/// Plays the way out of the contact that was explained last: a branch of the run, which an undo takes back.
pub fn play_way_out(world: &mut World) {
    background::stop(world);
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let Some(way_out) = ui.chance.take().and_then(|chance| chance.way_out) else { return };
    (ui.hand.armed, ui.hand.held) = (None, (0, 0));
    match take_script(world, way_out.script, way_out.tick - 1) {
        Ok(()) => {
            world.resource_mut::<Transport>().playback = Playback::Playing;
            let [from, until] = [way_out.tick, way_out.free_until].map(seconds);
            let text = format!("The way out from {from:.2} s on, free until {until:.2} s. Undo brings back the run.");
            say(world, text, false);
        }
        Err(error) => say(world, error.to_string(), true),
    }
}

/// Forgets what was explained once the run on the screen is another.
pub fn forget_if_other(world: &mut World) {
    let Some(chance) = &world.resource::<Interface>().0.chance else { return };
    let is_there = Arc::ptr_eq(&chance.config, world.resource::<RunConfig>().config())
        && chance.script == ScriptMark::of(world.resource::<PendingInput>().script())
        && world
            .resource::<History>()
            .marks()
            .iter()
            .any(|mark| (mark.tick, mark.robot, mark.what) == (chance.contact, chance.robot, Happening::Contact));
    if !is_there {
        world.resource_mut::<Interface>().0.chance = None;
    }
}

fn say(world: &mut World, text: String, is_error: bool) {
    world.resource_mut::<Interface>().0.say(Notice { text, is_error });
}
