//! `InputRefusal`, why a robot refused an input.

use super::driven::InputRefused;
use crate::simulation::SimulatedRobot;
use motion_lab_core::collision::{Collision, Surroundings};
use motion_lab_core::configuration::InputKind;
use motion_lab_core::worlds::OutsideError;

/// Why a robot refused an input.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InputRefusal {
    /// Its kind takes no such input.
    #[error("it takes no {0}")]
    NotTaken(InputKind),
    /// A control channel is out of range.
    #[error("a channel is outside -128 to 128")]
    Channel,
    /// There is no configuration with this number of coordinates that it can be put in.
    #[error("it can be put in no configuration of {0} coordinates")]
    Coordinates(usize),
    /// It would be outside its world there: the place and the bounds, in the words of [`OutsideError`].
    #[error("{0}")]
    Outside(String),
    /// It would be beyond its own limits there.
    #[error("it would be beyond its own limits there")]
    Limits,
    /// It would touch this obstacle there, or another robot.
    #[error("it would touch {0} there")]
    Touches(String),
}

impl InputRefusal {
    /// The reason, with the name of what the robot would touch among its surroundings.
    pub(crate) fn of<R: SimulatedRobot>(
        why: InputRefused<R::Configuration>,
        input: InputKind,
        robot: &R,
        surroundings: &Surroundings<'_>,
    ) -> Self {
        match why {
            InputRefused::NotTaken => InputRefusal::NotTaken(input),
            InputRefused::Channel => InputRefusal::Channel,
            InputRefused::Coordinates(given) => InputRefusal::Coordinates(given),
            InputRefused::Outside(at) => {
                let reason = OutsideError::check("target", at, &surroundings.scene.bounds()).err();
                InputRefusal::Outside(reason.map_or_else(String::new, |reason| reason.to_string()))
            }
            InputRefused::Limits => InputRefusal::Limits,
            InputRefused::Touches(q) => {
                let touched = surroundings.witness(&robot.fitted(&q).footprint(&q)).filter(|w| w.dist == 0.0);
                let name = touched.and_then(|w| surroundings.scene.obstacle_name(w.obstacle));
                InputRefusal::Touches(name.unwrap_or("another robot").to_owned())
            }
        }
    }
}
