//! The components of worlds, obstacles, robots and sensors.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use bevy::prelude::*;

use super::{Extra, SimulatedRobot};
use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Pose2, Shape};
use motion_lab_core::random::Stream;
use motion_lab_core::sensors::{BeamModel, FanSensor, RangeSensor};
use motion_lab_core::worlds::{ObstacleKind, World as WorldModel};

/// A world of the run at its start. A component of the world's entity, beside its [`WorldScene`] and
/// [`StandingWorld`].
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct SimulatedWorld {
    /// The world's number in the run's configuration, from 0.
    pub index: u32,
    /// The world.
    pub model: Arc<WorldModel>,
}

/// The world's obstacles as a collision scene. It follows from the obstacles' entities.
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct WorldScene(pub Arc<Scene>);

/// The revision of a world's scene. Each scene that is made has one of its own; whatever is kept of a scene from tick
/// to tick is kept with it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[component(immutable)]
pub struct SceneRevision(u64);

impl SceneRevision {
    /// A revision that no other scene of the process has, so that what is kept of another run's scene is none of this
    /// one. A run does not depend on its number.
    pub(crate) fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        SceneRevision(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// The world as it stands now: its obstacles where they are, and its doors open or closed.
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct StandingWorld(pub Arc<WorldModel>);

/// An obstacle, an entity of its world.
///
/// Spawn one with an [`ObstacleOf`] before tick 0, and robots meet it; replace or remove it then, and they meet what is
/// left. In a run only its script changes obstacles: any other change has no effect and is refused aloud.
#[derive(Component, Clone, Debug, PartialEq)]
#[component(immutable)]
#[require(Placement)]
pub struct ObstacleShape {
    /// The obstacle's name, unique in its world.
    pub name: String,
    /// Wall or solid, which collide alike.
    pub kind: ObstacleKind,
    /// Its pieces at first, each with the pose of its frame.
    pub pieces: Vec<(Pose2, Shape)>,
}

/// Where an obstacle is. It is part of the run's state: frames hold it, and a restore overwrites it.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(immutable)]
pub struct Placement {
    /// Whether it is there; a closed door is, an open one is not.
    pub present: bool,
    /// The rigid motion from where its pieces are at first to where it is.
    pub pose: Pose2,
}

/// It is there, where its pieces are.
impl Default for Placement {
    fn default() -> Self {
        Placement { present: true, pose: Pose2::IDENTITY }
    }
}

/// Marks an obstacle, a single segment, as a door: it is open where it is not present.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[component(immutable)]
pub struct Door;

/// Relates an obstacle to its world.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = Obstacles)]
pub struct ObstacleOf(pub Entity);

/// A world's obstacles; they go with it.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = ObstacleOf, linked_spawn)]
pub struct Obstacles(Vec<Entity>);

/// Relates a robot to the world it lives in.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = Residents)]
pub struct ResidesIn(pub Entity);

/// A world's robots, in no particular order; they go with it.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = ResidesIn, linked_spawn)]
pub struct Residents(Vec<Entity>);

/// Relates a sensor to its robot.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = Sensors)]
pub struct MountedOn(pub Entity);

/// A robot's sensors; they go with it.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = MountedOn, linked_spawn)]
pub struct Sensors(Vec<Entity>);

/// A range sensor: its rays, its greatest range and its field of view. Spawn it with a [`SensorName`] and a
/// [`MountedOn`] before the run's first tick, and it is in the run; a [`SensorMount`] and a [`SensorNoise`] may come
/// with it. The run's configuration then says it too, and so do logs: any program runs them again.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(immutable)]
#[require(SensorName, SensorMount, Scan)]
pub struct SensorModel(pub FanSensor);

/// The name of a sensor, unique on its robot. A robot's sensors are ordered by the bytes of their names.
///
/// The empty name, which is the default, is that of the sensor that the run gives to its rovers, so that one is the
/// first. It may be changed or removed before the first tick, on all of them alike: it is one sensor of the
/// configuration, over a full turn in the middle of the robot's frame, with noise of each robot's own. Where the robots
/// that sense do not agree, no unnamed sensor is taken; one on any other robot is never taken. Either is refused aloud.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[component(immutable)]
pub struct SensorName(pub String);

/// The pose of a sensor in the frame of its robot that sensors are mounted in:
/// [`SimulatedRobot::mount_pose`]. By default it is that frame itself.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
#[component(immutable)]
pub struct SensorMount(pub Pose2);

/// The noise of a range sensor; without it the sensor is exact.
///
/// Each sensor has a stream of its own, by the run's seed and names: the first of the robot NAME `NAME/beam`, another
/// one `NAME/beam/SENSOR`. With n rays, ray k of tick t draws at index t n + k.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(immutable)]
pub struct SensorNoise(pub BeamModel);

/// The ranges that a sensor of the run read at the end of the last tick, metres, one per ray; empty before the first
/// scan. They are those of the frame, shared with it.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct Scan(pub(crate) Arc<[f64]>);

impl Scan {
    /// The ranges.
    pub fn ranges(&self) -> &Arc<[f64]> {
        &self.0
    }
}

/// A robot's id: its place in the run's list of robots. Wherever robots have an order, it is this one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[component(immutable)]
pub struct RobotId(pub u32);

/// A robot's unique name and its kind.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
#[component(immutable)]
pub struct RobotName {
    /// The name.
    pub name: String,
    /// The kind, as worlds name it.
    pub kind: String,
    /// The kind's description, if it has one.
    pub about: Option<&'static RobotKind>,
}

impl RobotName {
    /// The name and the kind of a robot that is to be spawned. The run adds the kind's description.
    pub fn new(name: impl Into<String>, kind: impl Into<String>) -> Self {
        RobotName { name: name.into(), kind: kind.into(), about: None }
    }
}

/// A robot's model: its dimensions and limits. It requires the rest of a robot's components.
///
/// Spawn one before tick 0, with a [`Configuration`], a [`RobotName`] and a [`ResidesIn`], and the run has the robot;
/// replace it, write its configuration or its drive mode, or despawn it then, and the run follows.
#[derive(Component, Clone, Debug, PartialEq)]
#[component(immutable)]
#[require(Control<R>, Contacts<R>, DriveMode<R>, OwnState<R>, TickMotion<R>, Cut<R>)]
pub struct RobotModel<R: SimulatedRobot>(pub R);

/// A robot's configuration. At tick 0 whoever writes it moves the robot; in a run it is put back.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Configuration<R: SimulatedRobot>(pub R::Configuration);

/// A robot's configuration before the last tick's motion, for drawing between ticks.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct PreviousConfiguration<R: SimulatedRobot>(pub(crate) R::Configuration);

/// The tick's control as it takes effect, after limits and slip.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Control<R: SimulatedRobot>(pub(crate) R::Control);

/// A robot's contacts.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct Contacts<R: SimulatedRobot> {
    pub(crate) in_contact: bool,
    pub(crate) episodes: u32,
    pub(crate) flash: u32,
    marker: std::marker::PhantomData<fn() -> R>,
}

/// Who drives a robot, and the input in force. At tick 0 one that is written becomes an input of tick 1; in a run it is
/// put back.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct DriveMode<R: SimulatedRobot> {
    /// Whether a person drives instead of the tour.
    pub manual: bool,
    /// The channels held, -128 to 128 of the maximum.
    pub channels: [i16; 2],
    /// The target of a manual move; `None` once it is reached.
    pub target: Option<R::Configuration>,
    /// Inputs refused since tick 0.
    pub refusals: u32,
}

/// A robot's own state beside its configuration.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct OwnState<R: SimulatedRobot> {
    pub(crate) extra: Extra,
    marker: std::marker::PhantomData<fn() -> R>,
}

/// A robot's tour, drawn from the seed.
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct DrawnTour<R: SimulatedRobot>(pub R::Tour);

/// A robot's stream of actuation noise; tick t draws at index t.
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct Slip(pub Stream);

/// The current tick's motion; `None` when the control gives none.
#[derive(Component, Debug)]
pub struct TickMotion<R: SimulatedRobot>(pub(crate) Option<R::Drive>);

/// How far the current tick's motion may go among the obstacles and the other robots' starting footprints.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Cut<R: SimulatedRobot> {
    pub(crate) until: f64,
    pub(crate) contact: bool,
    /// What the motion and the cut follow from, for a robot alone in its world. With the same the cut is the same.
    /// `None` where other robots matter too.
    pub(crate) of: Option<CutOf<R>>,
}

/// What a robot's motion and its cut follow from, in a world without other robots.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CutOf<R: SimulatedRobot> {
    /// The robot, whose cut means nothing on another one.
    pub(crate) robot: RobotId,
    /// The configuration at the start of the motion.
    pub(crate) configuration: R::Configuration,
    pub(crate) control: R::Control,
    /// The obstacles.
    pub(crate) scene: SceneRevision,
}

impl From<RangeSensor> for SensorModel {
    fn from(sensor: RangeSensor) -> Self {
        SensorModel(sensor.into())
    }
}

impl<R: SimulatedRobot> Contacts<R> {
    pub(crate) fn new(in_contact: bool, episodes: u32, flash: u32) -> Self {
        Contacts { in_contact, episodes, flash, marker: std::marker::PhantomData }
    }

    /// Whether the last tick's motion met an obstacle, another robot or its own limit. A robot that is held before what
    /// it meets does not touch it.
    pub fn in_contact(&self) -> bool {
        self.in_contact
    }

    /// Contact episodes since tick 0. An episode begins at a tick in contact after one that was not.
    pub fn episodes(&self) -> u32 {
        self.episodes
    }

    /// Ticks for which the flash still holds.
    pub fn flash(&self) -> u32 {
        self.flash
    }
}

impl<R: SimulatedRobot> Control<R> {
    /// The control.
    pub fn control(&self) -> &R::Control {
        &self.0
    }
}

impl<R: SimulatedRobot> PreviousConfiguration<R> {
    /// The configuration.
    pub fn configuration(&self) -> &R::Configuration {
        &self.0
    }
}

impl<R: SimulatedRobot> TickMotion<R> {
    /// The motion.
    pub fn motion(&self) -> Option<&R::Drive> {
        self.0.as_ref()
    }
}

impl<R: SimulatedRobot> OwnState<R> {
    pub(crate) fn new(extra: Extra) -> Self {
        OwnState { extra, marker: std::marker::PhantomData }
    }

    /// The numbers, in the order the kind documents.
    pub fn extra(&self) -> &Extra {
        &self.extra
    }
}

impl<R: SimulatedRobot> Cut<R> {
    /// A cut for no known configuration and control.
    pub(crate) fn new(until: f64, contact: bool) -> Self {
        Cut { until, contact, of: None }
    }

    /// The parameter of the motion at which it ends.
    pub fn until(&self) -> f64 {
        self.until
    }

    /// Whether the motion was blocked, or not proven free.
    pub fn contact(&self) -> bool {
        self.contact
    }
}

// a derived `Copy` would require the robot to be `Copy`
impl<R: SimulatedRobot> Copy for Configuration<R> {}
impl<R: SimulatedRobot> Copy for PreviousConfiguration<R> {}
impl<R: SimulatedRobot> Copy for Control<R> {}
impl<R: SimulatedRobot> Copy for Contacts<R> {}
impl<R: SimulatedRobot> Copy for DriveMode<R> {}
impl<R: SimulatedRobot> Copy for Cut<R> {}
impl<R: SimulatedRobot> Copy for CutOf<R> {}

impl<R: SimulatedRobot> Default for Control<R> {
    fn default() -> Self {
        Control(R::Control::default())
    }
}

impl<R: SimulatedRobot> Default for Contacts<R> {
    fn default() -> Self {
        Contacts::new(false, 0, 0)
    }
}

impl<R: SimulatedRobot> Default for DriveMode<R> {
    fn default() -> Self {
        DriveMode { manual: false, channels: [0; 2], target: None, refusals: 0 }
    }
}

impl<R: SimulatedRobot> Default for OwnState<R> {
    fn default() -> Self {
        OwnState::new(Extra::new())
    }
}

impl<R: SimulatedRobot> Default for TickMotion<R> {
    fn default() -> Self {
        TickMotion(None)
    }
}

impl<R: SimulatedRobot> Default for Cut<R> {
    fn default() -> Self {
        Cut::new(0.0, false)
    }
}
