//! How much work the run of a link is: whoever opens one waits for it.

use super::error::LinkError;
use super::limits::{MAX_LINK_WORK, TICKS_AHEAD};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::Recipe;

/// Refuses a run that is more work than a reader waits for. It counts the rays of a tick, and for each robot whatever
/// it may meet, over the ticks up to the link's and at least a minute, which is played.
pub fn check(recipe: &Recipe) -> Result<(), LinkError> {
    let Recipe { config, script, .. } = recipe;
    let own = config.sensor.map_or(0, |sensor| u64::from(sensor.n_rays));
    let of_world = |world: &World| {
        let robots = world.robots.len() as u64;
        let shapes = world.obstacles.iter().map(|obstacle| obstacle.pieces.len() as u64).sum::<u64>();
        let met = shapes + world.doors.len() as u64 + script.changes.len() as u64 + robots;
        let rays = world.robots.iter().map(|robot| {
            let its_own = robot.sensors.iter().map(|sensor| u64::from(sensor.rays.sensor.n_rays)).sum::<u64>();
            if robot.kind == RobotKind::RUSTY.name { own + its_own } else { its_own }
        });
        rays.sum::<u64>().saturating_add(robots.saturating_mul(met))
    };
    let tick = config.worlds.iter().map(of_world).fold(0, u64::saturating_add);
    let work = tick.saturating_mul(config.ticks.max(TICKS_AHEAD));
    if work > MAX_LINK_WORK { Err(LinkError::Work { work }) } else { Ok(()) }
}
