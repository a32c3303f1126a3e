//! The trail of a robot: where it was in the last seconds.

use crate::window::ui::CockpitRobot;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::simulation::History;

/// Length of the trail, ticks: ten seconds.
pub const TRAIL: u64 = 200;

/// Where a robot was in the ten seconds up to a tick, oldest first, since it was last put somewhere.
pub fn trail(history: &History, robot: &CockpitRobot, tick: u64) -> Vec<AnyConfiguration> {
    let since = tick.saturating_sub(TRAIL).max(robot.put);
    let known = |coordinates: &[f64]| Some(AnyRobot::of_kind(&robot.kind, coordinates)?.1);
    history.span(robot.id, since..=tick).filter_map(|trail| known(&trail.coordinates)).collect()
}
