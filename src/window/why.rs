//! Why a contact came about: the last chance of the run on the screen, and the way out as a branch of it.

use std::sync::Arc;

use bevy::prelude::*;

use super::background;
use crate::window::ui::{Interface, Notice, ShownChance};
use motion_lab_sim::avoid::{AddKinds, EvasionSet, Explaining, Explanation, LastChance};
use motion_lab_sim::run::{Recipe, seconds};
use motion_lab_sim::simulation::{
    Happening, History, Playback, RobotKinds, RunConfig, TickMark, Transport, recipe, take_script,
};
use motion_lab_sim::tour::TourConfig;

/// The contact that is asked about when the run stands at a tick: the last that has begun, else the next.
pub fn contact_at(history: &History, tick: u64) -> Option<TickMark> {
    let marks = history.marks();
    let (before, after) = marks.split_at(marks.partition_point(|mark| mark.tick <= tick));
    let is_contact = |mark: &&TickMark| mark.what == Happening::Contact;
    before.iter().rev().find(is_contact).or_else(|| after.iter().find(is_contact)).copied()
}

/// Begins to explain the contact at the present tick, in the background.
pub fn explain(world: &mut World) {
    background::stop(world);
    let (tick, frontier) = (world.resource::<Transport>().tick(), world.resource::<Transport>().frontier());
    let mark = contact_at(world.resource::<History>(), tick);
    let (Some(mark), Some(now)) = (mark, recipe(world)) else {
        return say(world, "No robot has touched anything yet.".into(), false);
    };
    let Some(robot) = now.config.robot_names().nth(mark.robot as usize).map(str::to_owned) else { return };
    // the run goes as far as it has come, and no farther than the contact's end
    let config = Arc::new(TourConfig { ticks: frontier, ..TourConfig::clone(&now.config) });
    let kinds = world.resource::<RobotKinds>().clone();
    let add: AddKinds = Arc::new(move |app: &mut App| kinds.add_to(app));
    let run = Recipe { config, ..now };
    match Explaining::with_robots(&run, (&robot, mark.tick), &EvasionSet::default(), Some(add)) {
        Ok(explaining) => background::explain(world, explaining, &robot),
        Err(error) => say(world, error.to_string(), true),
    }
}

/// Keeps what is known of a contact: the time line shows it, and a notice says it.
pub fn explained(world: &mut World, why: &Explanation) {
    let config = world.resource::<RunConfig>().config();
    let robot = config.robot_names().position(|name| name == why.episode.robot).unwrap_or_default() as u32;
    let way_out = why.going_on.evasion().or_else(|| why.stopping.evasion()).cloned();
    let text = words(why);
    let first = why.episode.first;
    let config = Arc::clone(config);
    let chance = ShownChance { robot, contact: first, way_out, text, config, is_asked: false };
    world.resource_mut::<Interface>().0.chance = Some(chance);
}

/// Plays the way out of the contact that was explained last: a branch of the run, which an undo takes back.
pub fn play_way_out(world: &mut World) {
    background::stop(world);
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let Some(way_out) = ui.chance.take().and_then(|chance| chance.way_out) else { return };
    (ui.armed, ui.held) = (None, (0, 0));
    match take_script(world, way_out.script, way_out.tick - 1) {
        Ok(()) => {
            world.resource_mut::<Transport>().playback = Playback::Playing;
            let text = format!("The way out from {:.2} s on. Undo brings back the run.", seconds(way_out.tick));
            say(world, text, false);
        }
        Err(error) => say(world, error.to_string(), true),
    }
}

/// Forgets what was explained once the run on the screen is another.
pub fn forget_if_other(world: &mut World) {
    let Some(chance) = &world.resource::<Interface>().0.chance else { return };
    let is_there = Arc::ptr_eq(&chance.config, world.resource::<RunConfig>().config())
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

/// What is known of a contact, in a sentence or two.
fn words(why: &Explanation) -> String {
    let (episode, at) = (&why.episode, seconds(why.episode.first));
    let before = |tick: u64| seconds(episode.first - tick);
    let met = format!("{} meets {} at {at:.2} s.", episode.robot, episode.with);
    let stops = match &why.stopping {
        LastChance::At(stop) if stop.tick == episode.first => "It could stop until then".to_owned(),
        LastChance::At(stop) => format!("It could stop until {:.2} s before", before(stop.tick)),
        LastChance::None(_) => "Stopping did not help".to_owned(),
    };
    let goes_on = match &why.going_on {
        LastChance::At(evasion) if evasion.tick == episode.first => "and go round it until then, too.".to_owned(),
        LastChance::At(evasion) => {
            format!("and steer away until {:.2} s before, not later.", before(evasion.tick))
        }
        LastChance::None(none) => format!("; on its way: {none}."),
    };
    let joint = if goes_on.starts_with(';') { "" } else { " " };
    format!("{met} {stops}{joint}{goes_on}")
}
