//! What is known of a contact that was explained, kept for the screen.

use std::sync::Arc;

use bevy::prelude::*;

use crate::window::ui::{Interface, ScriptMark, ShownChance};
use motion_lab_sim::avoid::{Evasion, EvasionMeans, Explanation, LastChance};
use motion_lab_sim::run::seconds;
use motion_lab_sim::simulation::{PendingInput, RunConfig};

/// Keeps what is known of a contact: the time line shows it, and a notice says it.
pub fn explained(world: &mut World, why: &Explanation) {
    let config = world.resource::<RunConfig>().config();
    let robot = config.robot_names().position(|name| name == why.episode.robot).unwrap_or_default() as u32;
    let way_out = why.going_on.evasion().or_else(|| why.stopping.evasion()).cloned();
    let text = words(why);
    let first = why.episode.first;
    let config = Arc::clone(config);
    let script = ScriptMark::of(world.resource::<PendingInput>().script());
    let chance = ShownChance { robot, contact: first, way_out, text, config, script, is_asked: false };
    world.resource_mut::<Interface>().0.chance = Some(chance);
}

/// What is known of a contact, in a sentence or two.
fn words(why: &Explanation) -> String {
    let (episode, at) = (&why.episode, seconds(why.episode.first));
    let before = |tick: u64| seconds(episode.first - tick);
    let met = format!("{} meets {} at {at:.2} s.", episode.robot, episode.with);
    let stops = match &why.stopping {
        LastChance::At(stop) if stop.tick == episode.first => "It could stop until then".to_owned(),
        LastChance::At(stop) => format!("It could stop until {:.2} s before", before(stop.tick)),
        LastChance::None(_) => "No stop helps".to_owned(),
    };
    let goes_on = match &why.going_on {
        LastChance::At(Evasion { tick, means: EvasionMeans::Path { .. }, .. }) => match before(*tick) {
            0.0 => "a way round begins then, too".to_owned(),
            before => format!("a way round begins {before:.2} s before"),
        },
        LastChance::At(evasion) if evasion.tick == episode.first => "it could steer away until then, too".to_owned(),
        LastChance::At(evasion) => {
            format!("it could steer away until {:.2} s before, not later", before(evasion.tick))
        }
        LastChance::None(none) => none.to_string(),
    };
    let ways = || [&why.stopping, &why.going_on].into_iter().filter_map(LastChance::evasion);
    let still = if ways().any(|way| way.is_still_met) { " The other one is in contact all the same." } else { "" };
    format!("{met} {stops}; {goes_on}.{still}")
}
