//! `ContactEpisode`, a contact of a robot in a run.

use super::ContactPartner;
use super::simulated_again::{AddKinds, recorder, without_sensors};
use crate::recording::RunError;
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
        let changed = wanted.iter().copied().filter(|&id| states[id].in_contact != open[id].is_some());
        let changed: Vec<(usize, u32)> = changed.map(|id| (id, states[id].contacts)).collect();
        if changed.is_empty() {
            continue;
        }
        let all = run.view();
        for (id, number) in changed {
            if let Some(episode) = open[id].take() {
                episodes[episode].ended = Some(tick);
                continue;
            }
            let robot = &all[id];
            open[id] = Some(episodes.len());
            episodes.push(ContactEpisode {
                robot: robot.name.clone(),
                world: recipe.config.worlds[robot.world as usize].name.clone(),
                number,
                first: tick,
                ended: None,
                with: ContactPartner::of(&run, robot, &all),
            });
        }
    }
    Ok(Some(episodes))
}
