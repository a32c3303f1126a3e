//! From a link to the lab's run, and back.

use bevy::ecs::world::World;

use super::error::PageError;
use super::report::LinkedTheme;
use crate::web::link::{Link, LinkedAnatomy, LinkedPlan, ReadLink, requoted};
use crate::window::for_page::{Interface, SessionError, new_run, shown_run};
use crate::window::ui::{AnatomyState, Notice};
use motion_lab_sim::anatomy::Anatomy;
use motion_lab_sim::manifest::{ThemeChoice, Widget};
use motion_lab_sim::plans::PlannerName;
use motion_lab_sim::run::Digest;
use motion_lab_sim::simulation::{Playback, Transport, recipe, seek};
use motion_lab_sim::tour::BOOK_SEED;

/// The run that is there before an address is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunBefore {
    /// The book's at its first tick, which an address without a run asks for.
    Books,
    /// Another.
    Other,
}

/// Shows what an address holds: what is in front of the lab, and the run. The lab says what of it is refused.
pub fn show_address(world: &mut World, address: ReadLink, before: RunBefore) {
    let ReadLink { link, run, view } = address;
    let mut refused = run.and(view).err().map(|error| error.to_string());
    let refusal = show_view(world, &link);
    refused = refused.or(refusal);
    let Link { widget, lesson, anatomy, plan, theme, .. } = link.clone();
    let has_run = link != (Link { widget, lesson, anatomy, plan, theme, ..Link::default() });
    if has_run || before == RunBefore::Other {
        let told = open_link(world, &link);
        let notice = told.unwrap_or_else(|error| Some(refusal_of(&requoted(&error))));
        notice.into_iter().for_each(|notice| world.resource_mut::<Interface>().0.say(notice));
    }
    if let Some(why) = refused {
        world.resource_mut::<Interface>().0.say(refusal_of(&why));
    }
    if world.resource::<Interface>().0.widget != Widget::Dashboard {
        world.resource_mut::<Transport>().playback = Playback::Paused;
    }
}

fn refusal_of(why: &str) -> Notice {
    Notice { text: format!("the link: {why}"), is_error: true }
}

/// Puts in front what a link names. Returns what Query's robot does not take of it and why, if anything.
fn show_view(world: &mut World, link: &Link) -> Option<String> {
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let implied = link.anatomy.tab.map(|_| Widget::Anatomy).or(link.plan.as_ref().map(|_| Widget::Plan));
    ui.widget = link.widget.or(implied).unwrap_or_default();
    ui.lesson = None;
    if let Some(lesson) = link.lesson {
        ui.begin(lesson);
    }
    // an address is about Query's usual robot
    if link.anatomy != LinkedAnatomy::default() && !is_books(&ui.anatomy.anatomy) {
        ui.anatomy = AnatomyState::default();
    }
    let query = &mut ui.anatomy.anatomy;
    let refusal = link.anatomy.show_in(query).err();
    if let Some(lesson) = ui.lesson.as_mut().filter(|_| !link.anatomy.q.is_empty()) {
        lesson.start = Some(query.q());
    }
    if ui.widget == Widget::Plan && link.plan.is_none() {
        // another figure's is none of this one's
        ui.plan.begin_anew();
    }
    // it was read, so its robot is there
    if let Some((plan, Ok(planned))) = link.plan.as_ref().map(|plan| (plan, plan.planned())) {
        ui.plan.show((&plan.robot, planned.robot), planned.world.into(), planned.start, planned.goal);
        ui.plan.set_planner(plan.planner.unwrap_or(PlannerName::default_for(&planned.robot)));
        ui.plan.set_seed(plan.seed.unwrap_or(BOOK_SEED));
        ui.plan.set_sensor_lies(plan.lies);
    }
    if let Some(theme) = link.theme {
        let shown = std::mem::replace(&mut ui.settings.theme, theme);
        let own = world.get_resource::<LinkedTheme>().map_or(shown, |linked| linked.own);
        world.insert_resource(LinkedTheme { theme, own });
    }
    refusal
}

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
        link.anatomy = LinkedAnatomy::of(&ui.anatomy.anatomy);
        link.anatomy.tab = link.anatomy.tab.filter(|_| ui.widget == Widget::Anatomy);
    }
    if ui.widget == Widget::Plan && link.lesson.is_none() {
        link.plan = LinkedPlan::of(ui.plan.task(), ui.plan.planner(), ui.plan.seed());
    }
    link.theme = Some(ui.settings.theme).filter(|t| *t != ThemeChoice::System);
    Ok(link)
}

/// Whether Query's robot and world are those that it begins with: an address can't name others.
fn is_books(query: &Anatomy) -> bool {
    let (usual, mut bare) = (AnatomyState::default().anatomy, query.clone());
    bare.set_thick_links(false);
    bare.checker().robot() == usual.checker().robot() && query.world() == usual.world()
}
