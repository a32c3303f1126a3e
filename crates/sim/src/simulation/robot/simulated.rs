//! `SimulatedRobot`, the trait that a kind of robot implements to be simulated.

use crate::tour::RouteTour;
use motion_lab_core::collision::Collision;
use motion_lab_core::configuration::{Configuration, Sizes};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{AnyRobot, Drivable, EncoderCounts};
use motion_lab_core::short_list::ShortList;
use motion_lab_core::worlds::World;

/// A robot's own state beside its configuration, in the order its kind documents.
pub type Extra = ShortList<f64, 4>;

/// A robot that lives in the simulation: its tour, what manual input means to it, what state it keeps. Register it
/// under a name with [`RobotPlugin`](crate::simulation::RobotPlugin); worlds then name it as the `kind` of a resident.
///
/// Everything here is a pure function of its arguments: no clock, no global, no random number but `draws`.
pub trait SimulatedRobot: Drivable<Drive: Clone + Send + Sync + 'static> {
    /// The data of a tour, drawn from the seed at the start of a run.
    type Tour: Clone + std::fmt::Debug + Send + Sync + 'static;

    /// Whether contact holds the robot where it is. A robot that is not held passes through things, in contact.
    const HELD: bool = true;

    /// The tour of the robot named `name` in `world`.
    fn tour(&self, seed: Seed, name: &str, world: &World, start: &Self::Configuration) -> Self::Tour;

    /// The tour of a robot whose world gives it this route, its reference to be put where the robot starts. `None` for
    /// a robot that follows no routes, or none as fast as this one; a run with it does not start then.
    fn route_tour(&self, _route: &RouteTour, _start: &Self::Configuration) -> Option<Self::Tour> {
        None
    }

    /// The control the tour gives for tick number `tick` (from 1), `dt` seconds long, at the configuration `q`.
    fn touring(
        &self,
        tour: &Self::Tour,
        tick: u64,
        dt: f64,
        q: &Self::Configuration,
        extra: &mut Extra,
    ) -> Self::Control;

    /// Called when the tour takes the robot back from its driver, at `q` among these obstacles.
    fn resume(&self, _tour: &Self::Tour, _q: &Self::Configuration, _obstacles: &dyn Collision, _extra: &mut Extra) {}

    /// The control that the held channels stand for, each a part in `[-1, 1]` of the maximum. `None` for a robot
    /// without drive channels, which refuses them.
    fn driven(&self, channels: [f64; 2]) -> Option<Self::Control>;

    /// The control that leads from `q` toward a target. `None` for a robot that takes no targets.
    fn toward(&self, _q: &Self::Configuration, _target: &Self::Configuration) -> Option<Self::Control> {
        None
    }

    /// The configuration with these chart coordinates, angles wrapped, of a robot now at `now`. `None` when the number
    /// of coordinates fits no configuration that the robot can be put in.
    fn configuration_at(&self, now: &Self::Configuration, coordinates: &[f64]) -> Option<Self::Configuration>;

    /// The configuration `q` with the trailer attached or not. `None` for a robot that pulls none.
    fn with_trailer_set(&self, _q: &Self::Configuration, _on: bool) -> Option<Self::Configuration> {
        None
    }

    /// The robot that a configuration is one of: a car with its hitch fitted or not.
    fn fitted(&self, _q: &Self::Configuration) -> Self {
        self.clone()
    }

    /// The same robot with the sizes that its world gives it. `None` for a robot that takes none, or not these; a run
    /// with it does not start then. They were checked for their ranges.
    fn with_sizes(&self, _sizes: &Sizes) -> Option<Self> {
        None
    }

    /// The sizes that make this robot of its kind's model, by [`with_sizes`](Self::with_sizes). `None` for a robot that
    /// takes none; such a robot can be in a run only as its kind's model has it.
    fn sizes(&self) -> Option<Sizes> {
        None
    }

    /// The robot as one of the lab's, for views that ask about it: its configuration space, its teleports. `None` for a
    /// robot of a type of one's own. A car's hitch is there or not whatever it pulls.
    fn lab_model(&self) -> Option<AnyRobot> {
        None
    }

    /// The robot's own state at the start; its length never changes.
    fn initial_extra(&self) -> Extra {
        Extra::new()
    }

    /// The control that takes effect for a commanded one. Called once in every tick, whoever drives and whether or not
    /// the robot is held: the place to draw slip and to turn encoders. `draws` is the robot's own stream at this tick,
    /// good for [`DRAWS_PER_INDEX`](motion_lab_core::random::DRAWS_PER_INDEX) draws.
    fn actuate(&self, commanded: &Self::Control, _dt: f64, _draws: &mut Stream, _extra: &mut Extra) -> Self::Control {
        *commanded
    }

    /// The pose in the world of the range sensor that a run gives to its robots. `None` for a robot that gets none.
    fn sensor_pose(&self, _q: &Self::Configuration) -> Option<Pose2> {
        None
    }

    /// The pose in the world of the frame that sensors are mounted in. Unless a kind says otherwise it is that of its
    /// range sensor, and without one that of the footprint's first part.
    fn mount_pose(&self, q: &Self::Configuration) -> Pose2 {
        let first_part = || self.fitted(q).footprint(q).parts().first().map_or(Pose2::IDENTITY, |part| *part.pose());
        self.sensor_pose(q).unwrap_or_else(first_part)
    }

    /// The readings of the wheels' encoders; `None` without encoders.
    fn encoders(&self, _extra: &Extra) -> Option<EncoderCounts> {
        None
    }

    /// The distance travelled according to the encoders, metres; `None` without encoders.
    fn odometer(&self, _extra: &Extra) -> Option<f64> {
        None
    }

    /// The tip of an arm, in the world; `None` for other robots.
    fn tip(&self, _q: &Self::Configuration) -> Option<Point2> {
        None
    }
}

/// Returns `q` with every -0.0 replaced by +0.0, as the state keeps it.
pub(crate) fn canonical<C: Configuration>(q: &C) -> C {
    let mut coordinates = q.coordinates();
    coordinates.iter_mut().for_each(|x| *x += 0.0);
    C::from_coordinates(&coordinates).unwrap_or(*q)
}
