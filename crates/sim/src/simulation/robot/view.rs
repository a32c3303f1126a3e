//! `RobotView`, a robot's state for views that do not know its type.

use motion_lab_core::configuration::{Coordinates, RobotKind};
use motion_lab_core::geometry::{Footprint, Point2, Pose2, Vector2};
use motion_lab_core::num;
use motion_lab_core::picture::Gait;
use motion_lab_core::robots::{AnyRobot, CHANNEL_UNITS, EncoderCounts, Hitch};

/// A robot as a view shows it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotView {
    /// The id.
    pub id: u32,
    /// The unique name.
    pub name: String,
    /// The kind, as worlds name it.
    pub kind: String,
    /// The kind's description, if it has one.
    pub about: Option<&'static RobotKind>,
    /// The robot with its own sizes, if it is one of the lab's. [`AnyRobot::fitted`] fits it to a configuration.
    pub model: Option<AnyRobot>,
    /// The number of the world it lives in.
    pub world: u32,
    /// The configuration as its type prints, three decimals.
    pub configuration: String,
    /// The configuration with every digit, for copying.
    pub configuration_in_full: String,
    /// The configuration's coordinates in its chart.
    pub coordinates: Coordinates,
    /// The footprint.
    pub footprint: Footprint,
    /// The footprint before the last tick's motion, for drawing between ticks.
    pub previous_footprint: Footprint,
    /// The tip of an arm, in the world; `None` for other robots.
    pub tip: Option<Point2>,
    /// Whether the last tick's motion met an obstacle, another robot or its own limit. A robot that is held before what
    /// it meets does not touch it.
    pub in_contact: bool,
    /// Contact episodes since tick 0.
    pub contacts: u32,
    /// Ticks for which the flash still holds; above 0 the robot shows red.
    pub flash: u32,
    /// Whether a person drives.
    pub manual: bool,
    /// The channels the driver holds, -128 to 128 of the maximum.
    pub channels: [i16; 2],
    /// Inputs refused since tick 0.
    pub refusals: u32,
    /// The readings of the wheels' encoders; `None` without encoders.
    pub encoders: Option<EncoderCounts>,
    /// The distance travelled according to the encoders, metres; `None` without encoders.
    pub odometer: Option<f64>,
}

/// Way in a tick below which it does not tell the steering angle, metres.
const STILL: f64 = 1e-6;

impl RobotView {
    /// How the robot's wheels stand: a rover's by its encoders, a car's by the arc of the last tick, or where it stood
    /// still, by what its driver holds.
    pub fn gait(&self) -> Gait {
        match (&self.model, self.encoders) {
            (Some(AnyRobot::Rusty(rover)), Some(EncoderCounts { left, right })) => {
                let rolled = |counts: i64| std::f64::consts::TAU * (counts as f64 / rover.counts_per_turn);
                Gait { rolled: [left, right].map(rolled), steering: 0.0 }
            }
            (Some(AnyRobot::Hitch(car)), _) => {
                let body = |footprint: &Footprint| footprint.parts().first().map(|part| *part.pose());
                let arc = body(&self.previous_footprint).zip(body(&self.footprint));
                let held = f64::from(self.channels[1]) / CHANNEL_UNITS * car.max_steer;
                let steering = arc.and_then(|(from, to)| steering(car, &from, &to)).unwrap_or(held);
                Gait { rolled: [0.0; 2], steering }
            }
            _ => Gait::default(),
        }
    }
}

/// The steering angle with which a car went from one pose to another: `tan(phi) = wheelbase * turn / way`. `None` where
/// it went no way.
fn steering(car: &Hitch, from: &Pose2, to: &Pose2) -> Option<f64> {
    let turn = num::wrap(to.theta - from.theta);
    let (s, c) = num::sin_cos(from.theta + 0.5 * turn);
    let way = (to.position() - from.position()).dot(&Vector2::new(c, s));
    let angle = num::atan2(car.wheelbase * turn * way.signum(), way.abs());
    (way.abs() > STILL).then(|| angle.clamp(-car.max_steer, car.max_steer))
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::HitchCfg;
    use motion_lab_core::robots::{CarCmd, HITCH};

    #[test]
    fn the_arc_of_a_tick_tells_the_steering_angle() {
        for (v, phi) in [(1.0, 0.4), (-1.0, 0.4), (0.5, -0.6), (-1.5, -0.2), (1.0, 0.0)] {
            let from = Pose2::new(1.0, 2.0, 3.1);
            let q = HitchCfg { body: from, trailer: None };
            let to = HITCH.step(&q, &CarCmd { v, phi }, 0.05).unwrap().body;
            let found = steering(&HITCH, &from, &to).unwrap();
            assert!((found - phi).abs() < 1e-3, "{found} for {phi} at {v} m/s");
        }
        assert_eq!(steering(&HITCH, &Pose2::IDENTITY, &Pose2::IDENTITY), None, "standing still tells nothing");
    }
}
