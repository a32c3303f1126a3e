//! `SensorRefused`, a sensor that is not in the run, and why.

use std::fmt;

use bevy::prelude::*;

use crate::sensors::SensorError;

/// A sensor that is not taken into the run, or a change of one that has no effect: a message to whoever shows the run,
/// and kept in [`SensorRoster::refused`](crate::simulation::SensorRoster::refused).
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
    /// A number out of range.
    #[error(transparent)]
    Numbers(#[from] SensorError),
    /// A sensor that is mounted on nothing, or on what is no robot of the run.
    #[error("it is mounted on no robot of the run")]
    NoRobot,
    /// A sensor that was added, changed or removed after the run had begun.
    #[error("the sensors of a run are fixed from its first tick on: this change has no effect")]
    Fixed,
}

impl fmt::Display for SensorRefused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(robot) = &self.robot {
            write!(f, "robot {robot:?}, ")?;
        }
        write!(f, "sensor {:?}: {}", self.sensor, self.reason)
    }
}
