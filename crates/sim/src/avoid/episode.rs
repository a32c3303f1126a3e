//! `ContactEpisode`, a contact of a robot in a run.

use super::ContactPartner;
use super::simulated_again::{AddKinds, recorder, without_sensors};
use crate::recording::{Recorder, RunError};
use crate::run::Recipe;

/// A contact episode of a robot: ticks in contact, one after the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContactEpisode {
    /// The robot.
    pub robot: String,
    /// Its world.
    pub world: String,
    /// Its number among those of the robot, from 1.
    pub number: u32,
    /// The first tick in contact.
    pub first: u64,
    /// The first tick after it that is not; `None` where the run ends in contact.
    pub ended: Option<u64>,
    /// What the robot meets.
    pub with: ContactPartner,
}

impl ContactEpisode {
    /// The contact of the robot with this id that begins in the tick at which a run stands.
    pub(super) fn begun(run: &Recorder, id: usize) -> Self {
        let all = run.view();
        let robot = &all[id];
        ContactEpisode {
            robot: robot.name.clone(),
            world: run.config().worlds[robot.world as usize].name.clone(),
            number: robot.contacts,
            first: run.frame().tick,
            ended: None,
            with: ContactPartner::of(run, robot, &all),
        }
    }
}

/// The contact episodes of those robots of a run that `wants` takes, in the order in which they begin.
///
/// # Errors
/// [`RunError`] of a run that cannot start.
pub fn contact_episodes(recipe: &Recipe, wants: impl Fn(&str) -> bool) -> Result<Vec<ContactEpisode>, RunError> {
    Ok(contact_episodes_with(recipe, None, wants, |_| true)?.unwrap_or_default())
}

/// [`contact_episodes`] with further kinds of robots. `go_on` gets each tick, and says whether to go on; `None` where
/// it does not.
///
/// # Errors
/// [`RunError`] of a run that cannot start.
pub fn contact_episodes_with(
    recipe: &Recipe,
    add: Option<&AddKinds>,
    wants: impl Fn(&str) -> bool,
    mut go_on: impl FnMut(u64) -> bool,
) -> Result<Option<Vec<ContactEpisode>>, RunError> {
    let recipe = without_sensors(recipe);
    let mut run = recorder(&recipe, add)?.without_keyframes();
    let names: Vec<String> = run.view().into_iter().map(|robot| robot.name).collect();
    let wanted: Vec<usize> = (0..names.len()).filter(|&id| names.get(id).is_some_and(|name| wants(name))).collect();
    let mut episodes: Vec<ContactEpisode> = Vec::new();
    let mut open: Vec<Option<usize>> = vec![None; names.len()];
    for tick in 1..=recipe.config.ticks {
        if !go_on(tick) {
            return Ok(None);
        }
        run.step();
        let states = &run.frame().robots;
        let has_changed = |id: &usize| states[*id].in_contact != open[*id].is_some();
        let changed: Vec<usize> = wanted.iter().copied().filter(has_changed).collect();
        for id in changed {
            if let Some(episode) = open[id].take() {
                episodes[episode].ended = Some(tick);
            } else {
                open[id] = Some(episodes.len());
                episodes.push(ContactEpisode::begun(&run, id));
            }
        }
    }
    Ok(Some(episodes))
}
