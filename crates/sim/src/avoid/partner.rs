//! `ContactPartner`, what a robot meets.

use std::fmt;

use crate::recording::Recorder;
use crate::simulation::RobotView;
use motion_lab_core::collision::{Collision, Scene, footprint_distance};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::num::lesser;
use motion_lab_core::robots::AnyRobot;

/// The distance within which a robot that something holds is from it, metres.
const HELD_WITHIN: f64 = 1e-4;

/// How near its limit a hitch is that the limit holds, radians.
const FOLDED_WITHIN: f64 = 1e-6;

/// What a robot is in contact with.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContactPartner {
    /// An obstacle of its world, by its name.
    Obstacle(String),
    /// Another robot.
    Robot(String),
    /// Its own limits: a hitch that folds no farther.
    OwnLimits,
    /// Nothing that is near it.
    Unknown,
}

impl fmt::Display for ContactPartner {
    /// In words, as the object of "meets".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ContactPartner::Obstacle(name) => write!(f, "{name}"),
            ContactPartner::Robot(name) => write!(f, "the robot {name}"),
            ContactPartner::OwnLimits => write!(f, "its own limits"),
            ContactPartner::Unknown => write!(f, "something"),
        }
    }
}

impl ContactPartner {
    /// What a robot is in contact with at the tick at which a run stands: an obstacle that holds it, its own limits,
    /// else what is nearest.
    pub(super) fn of(run: &Recorder, robot: &RobotView, all: &[RobotView]) -> Self {
        let worlds = run.standing_worlds();
        let Some(world) = worlds.get(robot.world as usize) else { return ContactPartner::Unknown };
        let scene = Scene::of_world(world);
        let obstacle = scene.witness(&robot.footprint).and_then(|witness| {
            let name = scene.obstacle_name(witness.obstacle)?.to_owned();
            Some((witness.dist, ContactPartner::Obstacle(name)))
        });
        if let Some((_, obstacle)) = obstacle.clone().filter(|(distance, _)| *distance <= HELD_WITHIN) {
            return obstacle;
        }
        if is_folded(robot) {
            return ContactPartner::OwnLimits;
        }
        let others = all.iter().filter(|other| other.world == robot.world && other.id != robot.id);
        let robots = others.map(|other| {
            // a motion that meets another's is not made: both count, where they were and where they are
            let [a, b] = [&robot.previous_footprint, &robot.footprint];
            let [c, d] = [&other.previous_footprint, &other.footprint];
            let pairs = [(a, c), (a, d), (b, c), (b, d)];
            let near = pairs.iter().fold(f64::INFINITY, |near, (a, b)| lesser(footprint_distance(a, b), near));
            (near, ContactPartner::Robot(other.name.clone()))
        });
        let nearest = robots.chain(obstacle).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(ContactPartner::Unknown, |(_, partner)| partner)
    }
}

/// Whether a robot is a car whose hitch folds no farther.
fn is_folded(robot: &RobotView) -> bool {
    let (Some(AnyRobot::Hitch(car)), Some((_, AnyConfiguration::Hitch(q)))) =
        (robot.model, AnyRobot::of_kind(&robot.kind, &robot.coordinates))
    else {
        return false;
    };
    car.jackknife.zip(q.hitch_angle()).is_some_and(|(limit, angle)| angle.abs() >= limit - FOLDED_WITHIN)
}
