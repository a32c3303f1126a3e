//! `Driven`, what an input may change about a robot.

use super::simulated::canonical;
use crate::collision::{Collision, Surroundings};
use crate::configuration::Coordinates;
use crate::run::{Quantized, RobotInput};
use crate::simulation::{DriveMode, Extra, SimulatedRobot};

/// What an input may change about a robot.
#[derive(Clone, Debug)]
pub(crate) struct Driven<R: SimulatedRobot> {
    pub(crate) q: R::Configuration,
    pub(crate) mode: DriveMode<R>,
    /// Its own state.
    pub(crate) extra: Extra,
}

impl<R: SimulatedRobot> Driven<R> {
    /// The robot after an input, which is counted if it is refused.
    pub(crate) fn after<'a>(
        self,
        robot: &R,
        tour: &R::Tour,
        input: &RobotInput,
        surroundings: impl Fn() -> Surroundings<'a>,
    ) -> Self {
        let Driven { q, mode, mut extra } = self;
        let is_free = |q: &R::Configuration| {
            let robot = robot.fitted(q);
            robot.is_within_limits(q) && !surroundings().intersects(&robot.footprint(q))
        };
        let (after, put) = accepted(robot, &q, &mode, input, is_free)
            .unwrap_or((DriveMode { refusals: mode.refusals.saturating_add(1), ..mode }, None));
        if mode.manual && !after.manual {
            robot.resume(tour, &q, &surroundings(), &mut extra);
        }
        Driven { q: put.unwrap_or(q), mode: after, extra }
    }
}

/// The driver's new state after an accepted input, and the configuration that the robot is put in, if any. `None`
/// for a refused input.
fn accepted<R: SimulatedRobot>(
    robot: &R,
    q: &R::Configuration,
    mode: &DriveMode<R>,
    input: &RobotInput,
    is_free: impl Fn(&R::Configuration) -> bool,
) -> Option<(DriveMode<R>, Option<R::Configuration>)> {
    let values = |c: &[Quantized]| c.iter().map(|c| c.value()).collect::<Coordinates>();
    let taken_over = DriveMode { manual: true, ..*mode };
    let put = |q: R::Configuration| is_free(&q).then_some((DriveMode { target: None, ..taken_over }, Some(q)));
    match input {
        RobotInput::Drive(a, b) => {
            let channels = [*a, *b];
            let in_range = channels.iter().all(|c| (-128..=128).contains(c));
            (in_range && robot.driven([0.0; 2]).is_some())
                .then_some((DriveMode { channels, target: None, ..taken_over }, None))
        }
        RobotInput::MoveTo(target) => {
            let target = canonical(&robot.configuration_at(q, &values(target))?);
            robot.toward(q, &target)?;
            Some((DriveMode { target: Some(target), ..taken_over }, None))
        }
        RobotInput::Teleport(to) => put(canonical(&robot.configuration_at(q, &values(to))?)),
        RobotInput::SetTrailer(on) => {
            let to = canonical(&robot.with_trailer_set(q, *on)?);
            if to == *q { Some((taken_over, None)) } else { put(to) }
        }
        RobotInput::Release => Some((DriveMode { refusals: mode.refusals, ..DriveMode::default() }, None)),
    }
}
