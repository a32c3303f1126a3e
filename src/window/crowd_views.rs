//! `CrowdViews`, the robots of worlds of many as the view shows them, read from the simulation once a tick.

use std::sync::Arc;

use bevy::ecs::change_detection::Tick;
use bevy::prelude::*;

use crate::window::ui::{CrowdRobot, CrowdView, MAX_SHOWN_EACH, Members, Stance};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::run::RobotState;
use motion_lab_sim::simulation::{LatestFrame, Playback, RunConfig, Transport, footprint_of};
use motion_lab_sim::tour::TourConfig;

/// The crowds of the run.
#[derive(Resource, Default)]
pub struct CrowdViews {
    config: Option<Arc<TourConfig>>,
    /// The tick of the frame that was read last, and when it was written.
    read: Option<(u64, Tick, bool)>,
    /// By the number of the world; `None` where its robots are few.
    crowds: Vec<Option<CrowdView>>,
}

/// The crowd of the world with this number, a part `between` of the way from the tick before to the last one.
pub fn crowd(world: &World, number: usize, between: f64) -> Option<CrowdView> {
    let crowd = world.resource::<CrowdViews>().crowds.get(number)?.as_ref()?;
    Some(CrowdView { between, ..crowd.clone() })
}

/// Reads the crowds again if there was a tick, or another run began, since they were read last.
pub fn update_crowds(world: &mut World) {
    let Some(config) = world.get_resource::<RunConfig>().map(|config| Arc::clone(config.config())) else { return };
    let Some(written) = world.get_resource_change_ticks::<LatestFrame>() else { return };
    let playing = world.resource::<Transport>().playback == Playback::Playing;
    let read = (world.resource::<LatestFrame>().frame().tick, written.changed, playing);
    let kept = world.resource_mut::<CrowdViews>().into_inner();
    let is_same_run = kept.config.as_ref().is_some_and(|c| Arc::ptr_eq(c, &config));
    if !is_same_run {
        *kept = CrowdViews { crowds: named(&config), config: Some(config), read: None };
    } else if kept.read == Some(read) {
        return;
    }
    let follows = kept.read.is_some_and(|(tick, ..)| tick + 1 == read.0);
    kept.read = Some(read);
    let mut crowds = std::mem::take(&mut kept.crowds);
    for crowd in crowds.iter_mut().flatten() {
        // the list of two ticks ago, which nobody needs now, is written anew: megabytes of new memory are slow to come
        let oldest = std::mem::replace(&mut crowd.before, Arc::clone(&crowd.now));
        let mut bodies = Arc::try_unwrap(oldest).unwrap_or_default();
        write(&mut bodies, world, crowd);
        crowd.now = Arc::new(bodies);
        if !follows {
            crowd.before = Arc::clone(&crowd.now);
        }
    }
    world.resource_mut::<CrowdViews>().crowds = crowds;
}

/// The crowds of a run by the names of their robots.
fn named(config: &TourConfig) -> Vec<Option<CrowdView>> {
    let mut first = 0;
    let worlds = config.worlds.iter().map(|world| {
        let ids = first..first + world.robots.len() as u32;
        first = ids.end;
        let nobody = Arc::new(Vec::new());
        let mut members = Members::default();
        (world.robots.len() > MAX_SHOWN_EACH).then(|| CrowdView {
            first: ids.start,
            names: world.robots.iter().map(|robot| robot.name.clone()).collect(),
            members: {
                world.robots.iter().for_each(|robot| members.push(AnyRobot::of_resident(robot)));
                Arc::new(members)
            },
            now: Arc::clone(&nobody),
            before: nobody,
            between: 1.0,
        })
    });
    worlds.collect()
}

/// Writes the robots of a crowd as they are now. Nothing is asked of the entities of the lab's own kinds.
fn write(robots: &mut Vec<CrowdRobot>, world: &World, crowd: &CrowdView) {
    robots.clear();
    let playing = world.resource::<Transport>().playback == Playback::Playing;
    let states = world.resource::<LatestFrame>().frame().robots.get(crowd.first as usize..).unwrap_or_default();
    for (place, state) in states.iter().take(crowd.names.len()).enumerate() {
        let stance = match crowd.members.circle(place) {
            Some(_) => Stance::In(state.configuration.clone()),
            None => own_stance(world, state),
        };
        let flash = if playing { state.flash > 0 } else { state.in_contact };
        robots.push(CrowdRobot { stance, flash, contacts: state.contacts });
    }
}

/// How a robot of a kind of the program's own stands.
fn own_stance(world: &World, state: &RobotState) -> Stance {
    let footprint = footprint_of(world, state.id).unwrap_or_default();
    let is_disc = footprint.parts().len() == 1 && footprint.parts().iter().all(|p| p.placed().core().len() == 1);
    let heading = state.configuration.get(2).copied().filter(|_| is_disc);
    Stance::Over(Arc::new(footprint), heading)
}
