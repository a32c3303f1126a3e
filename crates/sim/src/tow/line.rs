//! `Tow`, the line by which a robot is pulled.

use super::command::TowCommand;
use super::pull::Pull;
use super::{car, rover};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::greater;
use motion_lab_core::robots::{AnyRobot, Robot, TICK};

/// Part of a rover's radius behind its centre that still counts as its centre: nobody aims at a rover so finely.
const CENTRE: f64 = 0.35;

/// A line by which a robot on wheels is pulled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tow {
    /// Where on its axis the robot is gripped: metres ahead of the rover's centre or the car's rear axle.
    pub grip: f64,
    /// Where the grip is pulled to, in the world, metres.
    pub aim: Point2,
    /// How long the command will be held before the next, seconds: a tick, or more where ticks pass unseen.
    pub held: f64,
}

/// Where on its axis a robot on wheels is gripped by this point of the world: metres ahead of its reference point, at
/// most as far as its body reaches. `None` for an arm, or a configuration of another robot.
pub fn grip_at(robot: &AnyRobot, q: &AnyConfiguration, point: Point2) -> Option<f64> {
    let ahead = in_frame(&frame(robot, q)?, point).x;
    let grip = match robot {
        AnyRobot::Rusty(rover) => {
            let radius = rover.body_radius;
            let is_centre = ahead < 0.0 && ahead > -CENTRE * radius;
            if is_centre { 0.0 } else { ahead.clamp(-radius, radius) }
        }
        AnyRobot::Hitch(car) => ahead.clamp(-car.body.rear_overhang, car.body.length - car.body.rear_overhang),
        AnyRobot::Reach(_) | AnyRobot::Reach3(_) => return None,
    };
    grip.is_finite().then_some(grip)
}

impl Tow {
    /// A line to `aim` from the grip, whose commands are held for a tick each.
    pub fn new(grip: f64, aim: Point2) -> Self {
        Tow { grip, aim, held: TICK }
    }

    /// Where the grip is at a configuration, in the world. `None` for an arm, or a configuration of another robot.
    pub fn gripped(&self, robot: &AnyRobot, q: &AnyConfiguration) -> Option<Point2> {
        Some(frame(robot, q)?.transform(Point2::new(self.grip, 0.0)))
    }

    /// The channels for the robot at `q`. Within 0.02 m of the aim a rover's grip has arrived, within 0.05 m a car's.
    /// `None` for an arm, or a configuration of another robot. A line that is not finite pulls nothing.
    pub fn command(&self, robot: &AnyRobot, q: &AnyConfiguration) -> Option<TowCommand> {
        let aim = in_frame(&frame(robot, q)?, self.aim);
        let pull = Pull { grip: self.grip, aim, held: greater(self.held, TICK) };
        if !(aim.x.is_finite() && aim.y.is_finite() && self.grip.is_finite() && pull.held.is_finite()) {
            return Some(TowCommand::REST);
        }
        match (robot.fitted(q), q) {
            (AnyRobot::Rusty(rover), AnyConfiguration::Pose(_)) => Some(rover::command(&rover, &pull)),
            (AnyRobot::Hitch(car), AnyConfiguration::Hitch(q)) => Some(car::command(&car, q, &pull)),
            _ => None,
        }
    }
}

/// The frame in which a robot on wheels is gripped: its reference point, its heading.
fn frame(robot: &AnyRobot, q: &AnyConfiguration) -> Option<Pose2> {
    let fitted = robot.fitted(q);
    fitted.check(q).ok()?;
    match (fitted, q) {
        (AnyRobot::Rusty(_), AnyConfiguration::Pose(pose)) => Some(*pose),
        (AnyRobot::Hitch(_), AnyConfiguration::Hitch(q)) => Some(q.body),
        _ => None,
    }
}

/// A point of the world as it is seen from a frame.
fn in_frame(frame: &Pose2, point: Point2) -> Point2 {
    frame.inverse().transform(point)
}
