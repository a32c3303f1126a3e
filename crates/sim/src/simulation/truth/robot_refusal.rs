//! `RobotRefusal`, why an entity is not taken into the run as the robot that it says it is.

use crate::simulation::SpawnError;

/// Why an entity that was spawned or changed at tick 0 is not taken into the run as the robot that it says it is.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotRefusal {
    /// It has no [`RobotName`](crate::simulation::RobotName), or one that no world file could hold.
    #[error("its name must be 1 to 200 bytes without control characters and without blanks at its ends")]
    Name,
    /// Something else has its name: another robot of the run, or a thing of its world.
    #[error("its name is taken")]
    NameTaken,
    /// It resides in no world of the run.
    #[error("it resides in no world of the run")]
    World,
    /// Its kind is not registered, or robots of that kind have a model of another type.
    #[error("robots of its type are of no kind {0:?}")]
    Kind(String),
    /// It has models of two types.
    #[error("it has models of two types")]
    Models,
    /// It has no configuration of its model's type.
    #[error("it has no configuration of its model's type")]
    Configuration,
    /// Its model differs from its kind's in more than its sizes, so no configuration of a run could say it.
    #[error("its model differs from that of its kind in more than its sizes")]
    Model,
    /// No run with it would start.
    #[error(transparent)]
    Spawn(#[from] SpawnError),
}
