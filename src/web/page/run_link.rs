//! From a link to the lab's run, and back.

use bevy::ecs::world::World;

use super::error::PageError;
use crate::web::link::Link;
use crate::window::for_page::{Interface, SessionError, new_run, shown_run};
use crate::window::ui::{AnatomyState, Notice};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_sim::anatomy::Anatomy;
use motion_lab_sim::manifest::{ThemeChoice, Widget};
use motion_lab_sim::run::Digest;
use motion_lab_sim::simulation::{Playback, Transport, recipe, seek};

/// Starts a link's run, simulates it up to its tick, and compares the digest with that of the link.
pub fn open_link(world: &mut World, link: &Link) -> Result<Option<Notice>, SessionError> {
    new_run(world, link.recipe())?;
    world.resource_mut::<Transport>().playback = if link.tick == 0 { Playback::Playing } else { Playback::Paused };
    seek(world, link.tick)?;
    if link.tick == 0 {
        return Ok(None);
    }
    let digest = digest_at(world, link.tick)?.to_string();
    Ok(Some(match &link.digest {
        None => Notice { text: format!("tick {}, digest {digest}", link.tick), is_error: false },
        Some(expected) if *expected == digest => Notice {
            text: format!("the same run to the last bit: tick {}, digest {digest}", link.tick),
            is_error: false,
        },
        Some(expected) => Notice {
            text: format!("this run differs from the link's: digest {digest}, expected {expected}"),
            is_error: true,
        },
    }))
}

/// The digest of the run up to `ticks`, recorded again from its recipe.
fn digest_at(world: &World, ticks: u64) -> Result<Digest, SessionError> {
    shown_run(world, ticks).record()?.digest().ok_or(SessionError::NotRun)
}

/// The link of what is shown.
pub fn link_of(world: &World) -> Result<Link, PageError> {
    let tick = world.resource::<Transport>().tick();
    let run = shown_run(world, tick);
    let mut link = Link::of(&run.recipe)?;
    if let Some(present) = recipe(world) {
        // with the inputs to come: without them it would be another run that goes on from here
        link.script = present.script;
    }
    if tick > 0 {
        link.digest = Some(digest_at(world, tick)?.to_string());
    }
    let ui = &world.resource::<Interface>().0;
    link.widget = Some(ui.widget).filter(|w| *w != Widget::Dashboard);
    link.lesson = ui.lesson.as_ref().map(|under_way| under_way.lesson).filter(|lesson| lesson.widget == ui.widget);
    if matches!(ui.widget, Widget::Anatomy | Widget::Cspace) && is_books(&ui.anatomy.anatomy) {
        link.tab = Some(ui.anatomy.anatomy.tab).filter(|_| ui.widget == Widget::Anatomy);
        link.q = ui.anatomy.anatomy.q().coordinates().to_vec();
    }
    link.theme = Some(ui.settings.theme).filter(|t| *t != ThemeChoice::System);
    Ok(link)
}

/// Whether Query's robot and world are those that it begins with: an address can't name others.
fn is_books(query: &Anatomy) -> bool {
    let usual = AnatomyState::default().anatomy;
    query.checker().robot() == usual.checker().robot() && query.world() == usual.world()
}
