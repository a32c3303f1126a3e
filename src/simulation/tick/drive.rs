//! The systems that give each robot its control and its motion.

use bevy::prelude::*;

use crate::run::DT;
use crate::simulation::{
    Configuration, Control, DriveMode, Extra, OwnState, PreviousConfiguration, RobotModel, Route, SimulatedRobot, Slip,
    TickMotion, Transport,
};

/// The channel value that stands for the maximum.
const CHANNEL_UNITS: f64 = 128.0;

/// The control commanded for a tick: by the driver's target, else the driver's channels, else the tour.
fn commanded<R: SimulatedRobot>(
    robot: &R,
    tour: &R::Tour,
    mode: &DriveMode<R>,
    tick: u64,
    q: &R::Configuration,
    extra: &mut Extra,
) -> R::Control {
    if !mode.manual {
        return robot.touring(tour, tick, DT, q, extra);
    }
    let to_target = mode.target.and_then(|target| robot.toward(q, &target));
    let by_channels = || robot.driven(mode.channels.map(|c| f64::from(c) / CHANNEL_UNITS));
    to_target.or_else(by_channels).unwrap_or_default()
}

/// The components of a robot that [`drive`] reads and writes.
type Driven<R> = (
    &'static RobotModel<R>,
    &'static Route<R>,
    &'static Slip,
    &'static DriveMode<R>,
    &'static Configuration<R>,
    &'static mut PreviousConfiguration<R>,
    &'static mut OwnState<R>,
    &'static mut Control<R>,
);

/// Gives every robot of a kind its control.
pub(crate) fn drive<R: SimulatedRobot>(transport: Res<Transport>, mut robots: Query<Driven<R>>) {
    let tick = transport.tick;
    for (RobotModel(robot), Route(tour), Slip(slip), mode, Configuration(q), mut previous, mut own, mut control) in
        &mut robots
    {
        previous.0 = *q;
        let mut extra = own.extra.clone();
        let command = commanded(robot, tour, mode, tick, q, &mut extra);
        control.0 = robot.actuate(&command, DT, &mut slip.at(tick), &mut extra);
        // a robot's own state is part of the frames: -0.0 becomes +0.0, and a NaN leaves the earlier value
        for (kept, new) in own.extra.iter_mut().zip(&extra) {
            if !new.is_nan() {
                *kept = new + 0.0;
            }
        }
    }
}

/// The components of a robot that [`plan`] reads and writes.
type Planned<R> = (&'static RobotModel<R>, &'static Configuration<R>, &'static Control<R>, &'static mut TickMotion<R>);

/// Gives every robot of a kind the motion of its control.
pub(crate) fn plan<R: SimulatedRobot>(mut robots: Query<Planned<R>>) {
    for (RobotModel(robot), Configuration(q), Control(u), mut motion) in &mut robots {
        motion.0 = robot.fitted(q).drive(q, u, DT).ok();
    }
}
