//! The speed channel that a robot had when it met something.

use super::branches::Branches;
use super::{AvoidError, NoEvasion};
use crate::run::{Frame, MAX_CHANNEL, Quantity, RobotInput, Script, SeriesGatherer};
use motion_lab_core::configuration::Kinds;

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
    branches.begin(&before)?;
    branches.input(RobotInput::Drive(MAX_CHANNEL, 0));
    let fastest = branches.step().0.clone();
    let (config, robot) = (branches.run.shared_config(), &branches.episode.robot);
    let metres_per_second = |after: &Frame| {
        let (script, kinds) = (Script::empty(), Kinds::default());
        let mut gatherer = SeriesGatherer::new(Quantity::Speed, &config, &script, &kinds, |name| name == robot);
        gatherer.see(&before);
        gatherer.see(after);
        Some(gatherer.series().first()?.points.last()?.1)
    };
    let (Some(had), Some(most)) = (metres_per_second(&after), metres_per_second(&fastest)) else {
        return Ok(Err(NoEvasion::NoSpeed));
    };
    let most_units = f64::from(MAX_CHANNEL);
    Ok(match (most_units * had / most).round() {
        units if !units.is_finite() => Err(NoEvasion::NoSpeed),
        0.0 => Err(NoEvasion::Stood),
        units => Ok(units.clamp(-most_units, most_units) as i16),
    })
}
