//! Which candidates a log can hold.

use crate::run::{Recipe, check_recordable};
use motion_lab_core::worlds::{Resident, World};

/// Whether a log can hold a candidate made of the recipe `best`, and no robot of it is outside its world that was not.
pub(super) fn is_recordable(candidate: &Recipe, best: &Recipe) -> bool {
    let worlds = &best.config.worlds;
    let was_outside = |robot: &Resident| {
        let is_same = |(world, was): (&World, &Resident)| was.name == robot.name && world.check_resident(was).is_err();
        worlds.iter().flat_map(|world| world.robots.iter().map(move |was| (world, was))).any(is_same)
    };
    let is_within = |world: &World| {
        let mut robots = world.robots.iter();
        robots.all(|robot| world.check_resident(robot).is_ok() || was_outside(robot))
    };
    let stays = |world: &World| worlds.contains(world);
    candidate.config.worlds.iter().all(is_within) && check_recordable(candidate, stays).is_ok()
}
