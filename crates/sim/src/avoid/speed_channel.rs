//! The speed channel that a robot had when it met something.

use super::branches::Branches;
use super::{AvoidError, NoEvasion};
use crate::run::{Frame, MAX_CHANNEL, Quantity, RobotInput, Script, SeriesGatherer};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::robots::AnyRobot;

/// The speed channel that the robot had when it met something: the one it was driven by, else the one that gives the
/// speed it had in the tick before.
pub(super) fn speed_channel(branches: &mut Branches) -> Result<Result<i16, NoEvasion>, AvoidError> {
    let first = branches.episode.first;
    let driven = branches.frame(first).map(|frame| branches.state(frame)).filter(|state| state.manual);
    if let Some(state) = driven.filter(|state| state.target.is_empty()) {
        let [speed, _] = state.channels;
        return Ok(if speed == 0 { Err(NoEvasion::Stood) } else { Ok(speed) });
    }
    let before = first.checked_sub(2).and_then(|tick| branches.frame(tick)).cloned();
    let (Some(before), Some(after)) = (before, branches.frame(first - 1).cloned()) else {
        return Ok(Err(NoEvasion::Stood));
    };
    let metres_per_second = {
        let (config, robot) = (branches.run.shared_config(), branches.episode.robot.clone());
        let before = before.clone();
        move |after: &Frame| {
            let (script, kinds) = (Script::empty(), Kinds::default());
            let mut gatherer = SeriesGatherer::new(Quantity::Speed, &config, &script, &kinds, |name| name == robot);
            gatherer.see(&before);
            gatherer.see(after);
            Some(gatherer.series().first()?.points.last()?.1)
        }
    };
    branches.begin(&before)?;
    branches.input(RobotInput::Drive(MAX_CHANNEL, 0));
    let (fastest, robot) = branches.step();
    // so near to what it meets, its greatest speed may be cut short: then its kind's own counts, without the slip
    let free = (!robot.in_contact).then(|| fastest.clone());
    let most = free.as_ref().and_then(&metres_per_second).or_else(|| greatest_speed(branches));
    let (Some(had), Some(most)) = (metres_per_second(&after), most) else {
        return Ok(Err(NoEvasion::NoSpeed));
    };
    let most_units = f64::from(MAX_CHANNEL);
    Ok(match (most_units * had / most).round() {
        units if !units.is_finite() => Err(NoEvasion::NoSpeed),
        0.0 => Err(NoEvasion::Stood),
        units => Ok(units.clamp(-most_units, most_units) as i16),
    })
}

/// The greatest speed of one of the lab's robots that drive, metres per second.
fn greatest_speed(branches: &Branches) -> Option<f64> {
    let robot = branches.run.view().into_iter().find(|robot| robot.name == branches.episode.robot)?;
    match robot.model? {
        AnyRobot::Rusty(rover) => Some(rover.max_speed),
        AnyRobot::Hitch(car) => Some(car.max_speed),
        AnyRobot::Reach(_) | AnyRobot::Reach3(_) => None,
    }
}
