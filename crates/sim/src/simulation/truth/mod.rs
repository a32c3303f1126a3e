//! The entities as the truth: before tick 0 the run follows them, later what others change is put back.

pub(crate) mod component_name;
pub(super) mod follow;
pub(super) mod foreign_change;
pub(crate) mod last_values;
pub(crate) mod lookup;
pub(super) mod put_back;
mod residents;
pub(super) mod robot_refusal;
pub(super) mod run_config;
mod script_fit;
pub(crate) mod thing;
pub(crate) mod touched;
pub(crate) mod watch;
mod worlds;

use bevy::prelude::World;

use super::{Roster, Transport};

pub(super) use follow::leave_start;

/// Makes entities and run agree after others have changed entities. [`step`](crate::simulation::step),
/// [`seek`](crate::simulation::seek()) and the plugin call it; whoever changes entities and reads frame 0 right after
/// it calls it first.
///
/// While the run stands at tick 0 the entities are the truth: the run's configuration, its script and frame 0 follow
/// them. Later the run is, and what was changed is put back. What can't be followed, and what is put back, is refused
/// by a [`CommandRefused`](crate::simulation::CommandRefused).
///
/// What observers change in answer to the simulation's own changes of an entity is not told from these. It is followed
/// at the start of a run. Later what was despawned so, and values that were written, are put back all the same; other
/// components that such an observer takes or replaces are not.
pub fn settle(world: &mut World) {
    if !world.contains_resource::<Roster>() {
        return;
    }
    if world.resource::<Transport>().tick == 0 {
        follow::follow(world);
    } else {
        put_back::put_back(world);
        put_back::put_values_back(world);
    }
}
