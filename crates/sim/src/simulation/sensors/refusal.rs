//! `SensorRefused`, a sensor that is not in the run, and why.

use std::fmt;

use bevy::prelude::*;

use motion_lab_core::sensors::SensorError;
use motion_lab_core::worlds::{AllRaysError, MAX_SENSORS};

/// A sensor that is not taken into the run: a message to whoever shows the run, and kept in
/// [`SensorRoster::refused`](crate::simulation::SensorRoster::refused).
///
/// Prints as `robot "Rusty", sensor "front": 0 rays: there must be 1 to 100000`.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct SensorRefused {
    /// The robot's name; `None` for a sensor that is mounted on no robot of the run.
    pub robot: Option<String>,
    /// The sensor's name.
    pub sensor: String,
    /// The reason.
    pub reason: SensorRefusal,
}

/// Why a sensor is not taken into the run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SensorRefusal {
    /// A name that is padded with blanks, longer than 200 bytes, or has a control character.
    #[error("its name must be at most 200 bytes without control characters and without blanks at its ends")]
    Name,
    /// Two sensors of a robot with one name. Which of them to take would depend on the order of entities.
    #[error("another sensor of the robot has the same name: none of them is taken")]
    NameTaken,
    /// Another sensor than the one of this name that the run's configuration has on the robot.
    #[error("the run's configuration has another sensor of this name on the robot: that one is taken")]
    NameOfConfiguration,
    /// A sensor without a name that is not the run's own: on a robot to which a run gives none, or one of which the
    /// robots that sense do not all have the same, in the middle of their frames and over a full turn.
    #[error("without a name it must be the run's own sensor, which all robots that sense have alike: give it a name")]
    Unnamed,
    /// One sensor too many.
    #[error("a robot has at most {MAX_SENSORS} sensors with names")]
    TooMany,
    /// One with which the run would have too many rays in all.
    #[error(transparent)]
    AllRays(#[from] AllRaysError),
    /// A number out of range.
    #[error(transparent)]
    Numbers(#[from] SensorError),
    /// A sensor that is mounted on nothing, or on what is no robot of the run.
    #[error("it is mounted on no robot of the run")]
    NoRobot,
}

impl fmt::Display for SensorRefused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(robot) = &self.robot {
            write!(f, "robot {robot:?}, ")?;
        }
        write!(f, "sensor {:?}: {}", self.sensor, self.reason)
    }
}
