//! The trail of a robot: where it was in the last seconds.

use crate::configuration::AnyConfiguration;
use crate::robots::AnyRobot;
use crate::simulation::History;
use crate::ui::CockpitRobot;

/// Length of the trail, ticks: ten seconds.
const TRAIL: u64 = 200;

/// Farthest that a robot on wheels goes in a tick, metres. One that moved farther was put there.
const LEAP: f64 = 0.5;

/// Where a robot was in the ten seconds up to a tick, oldest first; of one on wheels since it was last put somewhere.
pub fn trail(history: &History, robot: &CockpitRobot, tick: u64) -> Vec<AnyConfiguration> {
    let span = tick.saturating_sub(TRAIL)..=tick;
    let known = |coordinates: &[f64]| Some(AnyRobot::of_kind(&robot.kind, coordinates)?.1);
    let been = history.span(robot.id, span).filter_map(|trail| known(&trail.coordinates)).collect();
    match robot.model.filter(|_| !robot.is_arm) {
        Some(model) => since_leap(&model, been),
        None => been,
    }
}

/// What comes after the last leap.
fn since_leap(model: &AnyRobot, mut been: Vec<AnyConfiguration>) -> Vec<AnyConfiguration> {
    let is_leap = |pair: &[AnyConfiguration]| (model.reference(&pair[1]) - model.reference(&pair[0])).norm() > LEAP;
    if let Some(last) = been.windows(2).rposition(is_leap) {
        been.drain(..=last);
    }
    been
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;
    use crate::robots::RUSTY;

    #[test]
    fn a_trail_begins_anew_where_the_robot_was_put() {
        // at most 0.05 m in a tick by driving, and two leaps
        let xs = [0.0, 0.05, 0.1, 3.0, 3.05, 1.0, 1.05, 1.1];
        let at = |x: f64| AnyConfiguration::Pose(Pose2::new(x, 2.0, 0.0));
        let rest = since_leap(&AnyRobot::Rusty(RUSTY), xs.map(at).to_vec());
        assert_eq!(rest, [1.0, 1.05, 1.1].map(at));
        let driven = [0.0, 0.05, 0.1].map(at).to_vec();
        assert_eq!(since_leap(&AnyRobot::Rusty(RUSTY), driven.clone()), driven);
        // the fastest tick of a car: 2 m/s for 0.05 s, and far beyond it what is no leap yet
        let fast = [0.0, 0.1, 0.2, 0.6].map(at).to_vec();
        assert_eq!(since_leap(&AnyRobot::Rusty(RUSTY), fast.clone()), fast);
    }
}
