//! What is known of a contact that was explained, kept for the screen.

use std::sync::Arc;

use bevy::prelude::*;

use crate::window::ui::{Interface, ShownChance};
use motion_lab_sim::avoid::{Explanation, LastChance};
use motion_lab_sim::run::seconds;
use motion_lab_sim::simulation::RunConfig;

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

/// What is known of a contact, in a sentence or two.
fn words(why: &Explanation) -> String {
    let (episode, at) = (&why.episode, seconds(why.episode.first));
    let before = |tick: u64| seconds(episode.first - tick);
    let met = format!("{} meets {} at {at:.2} s.", episode.robot, episode.with);
    let stops = match &why.stopping {
        LastChance::At(stop) if stop.tick == episode.first => "It could stop until then,".to_owned(),
        LastChance::At(stop) => format!("It could stop until {:.2} s before,", before(stop.tick)),
        LastChance::None(_) => "Stopping did not help,".to_owned(),
    };
    let goes_on = match &why.going_on {
        LastChance::At(evasion) if evasion.tick == episode.first => "and go round it until then, too.".to_owned(),
        LastChance::At(evasion) => {
            format!("and steer away until {:.2} s before, not later.", before(evasion.tick))
        }
        LastChance::None(none) => format!("and not go on: {none}."),
    };
    format!("{met} {stops} {goes_on}")
}
