//! `InputTarget`, what an input may change about a robot.

use super::simulated::canonical;
use crate::run::{Quantized, RobotInput, check_target};
use crate::simulation::{DriveMode, Extra, SimulatedRobot};
use motion_lab_core::collision::{Collision, Surroundings};
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::Point2;
use motion_lab_core::robots::Robot;

/// Why an input is refused, of a robot with configurations `C`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum InputRefused<C> {
    /// Its kind takes no such input.
    NotTaken,
    /// A channel is out of range.
    Channel,
    /// There is no configuration with this number of coordinates that it can be put in.
    Coordinates(usize),
    /// It would be put at this point, outside its world.
    Outside(Point2),
    /// It would be beyond its own limits.
    Limits,
    /// It would touch something there.
    Touches(C),
}

/// The driver's new state after an accepted input, and the configuration that the robot is put in, if any.
type Accepted<R> = (DriveMode<R>, Option<<R as Robot>::Configuration>);

/// What an input may change about a robot.
#[derive(Clone, Debug)]
pub(crate) struct InputTarget<R: SimulatedRobot> {
    pub(crate) q: R::Configuration,
    pub(crate) mode: DriveMode<R>,
    pub(crate) extra: Extra,
}

impl<R: SimulatedRobot> InputTarget<R> {
    /// The robot after an input, and why the input was refused, if it was. A refused one is counted.
    pub(crate) fn after<'a>(
        self,
        robot: &R,
        tour: &R::Tour,
        input: &RobotInput,
        surroundings: impl Fn() -> Surroundings<'a>,
    ) -> (Self, Option<InputRefused<R::Configuration>>) {
        let InputTarget { q, mode, mut extra } = self;
        let fits = |q: &R::Configuration| {
            let robot = robot.fitted(q);
            if let (RobotInput::Teleport(_), Some(at)) = (input, robot.position(q)) {
                check_target(at, &surroundings().scene.bounds()).map_err(|_| InputRefused::Outside(at))?;
            }
            if !robot.is_within_limits(q) {
                return Err(InputRefused::Limits);
            }
            if surroundings().intersects(&robot.footprint(q)) { Err(InputRefused::Touches(*q)) } else { Ok(()) }
        };
        let (after, put, refused) = match accepted(robot, &q, &mode, input, fits) {
            Ok((after, put)) => (after, put, None),
            Err(why) => (DriveMode { refusals: mode.refusals.saturating_add(1), ..mode }, None, Some(why)),
        };
        if mode.manual && !after.manual {
            robot.resume(tour, &q, &surroundings(), &mut extra);
        }
        (InputTarget { q: put.unwrap_or(q), mode: after, extra }, refused)
    }
}

/// Whether a robot that tours at `q` takes all of these inputs, none of which puts it elsewhere.
pub(crate) fn are_taken<R: SimulatedRobot>(robot: &R, q: &R::Configuration, inputs: &[RobotInput]) -> bool {
    let after = |mode, input| Some(accepted(robot, q, &mode, input, |_| Ok(())).ok()?.0);
    inputs.iter().try_fold(DriveMode::default(), after).is_some()
}

/// What an accepted input makes of the driver and of the robot.
fn accepted<R: SimulatedRobot>(
    robot: &R,
    q: &R::Configuration,
    mode: &DriveMode<R>,
    input: &RobotInput,
    fits: impl Fn(&R::Configuration) -> Result<(), InputRefused<R::Configuration>>,
) -> Result<Accepted<R>, InputRefused<R::Configuration>> {
    let values = |c: &[Quantized]| c.iter().map(|c| c.value()).collect::<Coordinates>();
    let configuration_at = |c: &[Quantized]| {
        let there = robot.configuration_at(q, &values(c)).ok_or(InputRefused::Coordinates(c.len()))?;
        Ok(canonical(&there))
    };
    let taken_over = DriveMode { manual: true, ..*mode };
    let put = |q: R::Configuration| {
        fits(&q)?;
        Ok((DriveMode { target: None, ..taken_over }, Some(q)))
    };
    match input {
        RobotInput::Drive(a, b) => {
            let channels = [*a, *b];
            if channels.iter().any(|c| !(-128..=128).contains(c)) {
                return Err(InputRefused::Channel);
            }
            robot.driven([0.0; 2]).ok_or(InputRefused::NotTaken)?;
            Ok((DriveMode { channels, target: None, ..taken_over }, None))
        }
        RobotInput::MoveTo(target) => {
            // one that goes nowhere says so, whatever the coordinates
            robot.toward(q, q).ok_or(InputRefused::NotTaken)?;
            let target = configuration_at(target)?;
            robot.toward(q, &target).ok_or(InputRefused::NotTaken)?;
            Ok((DriveMode { target: Some(target), ..taken_over }, None))
        }
        RobotInput::Teleport(to) => put(configuration_at(to)?),
        RobotInput::SetTrailer(on) => {
            let to = canonical(&robot.with_trailer_set(q, *on).ok_or(InputRefused::NotTaken)?);
            if to == *q { Ok((taken_over, None)) } else { put(to) }
        }
        RobotInput::Release => Ok((DriveMode { refusals: mode.refusals, ..DriveMode::default() }, None)),
    }
}
