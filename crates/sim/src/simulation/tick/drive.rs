//! The systems that give each robot its control and its motion.

use std::collections::BTreeSet;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::parallel::each;
use super::world_crowds::WorldCrowds;
use crate::run::DT;
use crate::simulation::{
    Configuration, Control, DrawnTour, DriveMode, Extra, OwnState, PreviousConfiguration, RobotId, RobotModel,
    SimulatedRobot, Slip, TickMotion, Transport,
};
use motion_lab_core::num::greater;
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{CHANNEL_UNITS, Motion};

/// The robots of an app that stand while nobody drives them, by their ids; a run without this resource has none.
///
/// It is no part of a run's recipe: whoever replays a log of such a run says the same again. Robots that are spawned or
/// despawned at tick 0 may give others another id.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct StandingRobots(pub BTreeSet<RobotId>);

/// What does not change about a robot in a run, and its driver.
pub(crate) struct Driver<'a, R: SimulatedRobot> {
    pub(crate) robot: &'a R,
    pub(crate) tour: &'a R::Tour,
    pub(crate) mode: &'a DriveMode<R>,
    /// Whether it stands when nobody drives it, instead of touring.
    pub(crate) stands: bool,
}

impl<R: SimulatedRobot> Driver<'_, R> {
    /// The control commanded for a tick: by the driver's target, else the driver's channels, else the tour.
    fn commanded(&self, tick: u64, q: &R::Configuration, extra: &mut Extra) -> R::Control {
        let Driver { robot, tour, mode, stands, .. } = self;
        if !mode.manual && *stands {
            return R::Control::default();
        }
        if !mode.manual {
            return robot.touring(tour, tick, DT, q, extra);
        }
        let to_target = mode.target.and_then(|target| robot.toward(q, &target));
        let by_channels = || robot.driven(mode.channels.map(|c| f64::from(c) / CHANNEL_UNITS));
        to_target.or_else(by_channels).unwrap_or_default()
    }

    /// The control that takes effect in a tick at the configuration `q`. The robot's own state goes on. `slip` is the
    /// stream of its actuation noise, at this tick.
    pub(crate) fn control(&self, tick: u64, q: &R::Configuration, own: &mut Extra, slip: &mut Stream) -> R::Control {
        let mut extra = own.clone();
        let command = self.commanded(tick, q, &mut extra);
        let control = self.robot.actuate(&command, DT, slip, &mut extra);
        // a robot's own state is part of the frames: -0.0 becomes +0.0, and a NaN leaves the earlier value
        for (kept, new) in own.iter_mut().zip(&extra) {
            if !new.is_nan() {
                *kept = new + 0.0;
            }
        }
        control
    }
}

/// The components of a robot that [`drive`] reads and writes.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Driven<R: SimulatedRobot> {
    id: &'static RobotId,
    model: &'static RobotModel<R>,
    tour: &'static DrawnTour<R>,
    slip: &'static Slip,
    mode: &'static DriveMode<R>,
    configuration: &'static Configuration<R>,
    previous: &'static mut PreviousConfiguration<R>,
    own: &'static mut OwnState<R>,
    control: &'static mut Control<R>,
}

/// Gives every robot of a kind its control.
pub(crate) fn drive<R: SimulatedRobot>(
    transport: Res<Transport>,
    standing: Option<Res<StandingRobots>>,
    mut robots: Query<Driven<R>>,
) {
    let tick = transport.tick;
    let standing = standing.as_deref();
    each(
        robots.iter_mut(),
        || (),
        |(), mut driven| {
            let q = driven.configuration.0;
            driven.previous.0 = q;
            let DrivenItem { id, model, tour, slip, mode, .. } = &driven;
            let stands = standing.is_some_and(|standing| standing.0.contains(*id));
            let driver = Driver { robot: &model.0, tour: &tour.0, mode, stands };
            let mut slip = slip.0.at(tick);
            driven.control.0 = driver.control(tick, &q, &mut driven.own.extra, &mut slip);
        },
    );
}

/// The components of a robot that [`plan`] reads and writes.
type Planned<R> = (
    &'static RobotId,
    &'static RobotModel<R>,
    &'static Configuration<R>,
    &'static Control<R>,
    &'static mut TickMotion<R>,
);

/// Gives every robot of a kind the motion of its control, and those that are not alone in their worlds their bodies.
pub(crate) fn plan<R: SimulatedRobot>(mut crowds: ResMut<WorldCrowds>, mut robots: Query<Planned<R>>) {
    for (&id, RobotModel(robot), Configuration(q), Control(u), mut motion) in &mut robots {
        let robot = robot.fitted(q);
        motion.0 = robot.drive(q, u, DT).ok();
        if let Some(crowd) = crowds.of_mut(id) {
            let footprint = robot.footprint(q);
            let bound = motion.0.as_ref().map_or(0.0, |motion| reach(motion, footprint.parts().len()));
            crowd.put(id.0, &footprint, bound);
        }
    }
}

/// How far a motion may take any point of a robot from where it is at the start, or a proof may think so, metres.
pub(super) fn reach(motion: &impl Motion, parts: usize) -> f64 {
    (0..parts).fold(0.0, |most, k| greater(motion.bound(k, 0.0, 1.0) + motion.sagitta(k, 0.0, 1.0), most))
}
