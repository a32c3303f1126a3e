//! `CrowdView`, the robots of a world of many, as plain values.

use std::sync::Arc;

use super::members::Members;
use crate::window::ui::dashboard::blend::{angle_between, blend};
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _, Coordinates};
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Vector2};
use motion_lab_core::num::{greater, lesser};

/// Largest number of robots of a world that are shown one by one, each with its words. More are a crowd.
pub const MAX_SHOWN_EACH: usize = 3;

/// Farthest that a robot moves in a tick, metres. One that moved farther was put there.
const MAX_DRIVEN: f64 = 0.5;

/// One robot of a crowd after a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct CrowdRobot {
    /// How it stands.
    pub stance: Stance,
    /// Whether its contact flash is on.
    pub flash: bool,
    /// Contact episodes since the start.
    pub contacts: u32,
}

/// How a robot of a crowd stands. Those of the lab's kinds take their footprints from it when they are drawn large
/// enough: most are dots.
#[derive(Clone, Debug, PartialEq)]
pub enum Stance {
    /// In the configuration with these coordinates, for a robot of one of the lab's kinds.
    In(Coordinates),
    /// Over this footprint, with the heading that it does not show, radians, for any other.
    Over(Arc<Footprint>, Option<f64>),
}

/// A circle on the floor that holds a robot, and how large the robot is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotCircle {
    /// The circle's centre.
    pub centre: Point2,
    /// The circle's radius, metres.
    pub radius: f64,
    /// The robot's greatest extent along an axis, metres; of one with joints while it is straight.
    pub size: f64,
}

/// A footprint, and the heading that it does not show, radians.
pub type DrawnFootprint = (Footprint, Option<f64>);

/// The robots of a world of many.
#[derive(Clone, Debug, PartialEq)]
pub struct CrowdView {
    /// The id of the first; the others follow.
    pub first: u32,
    /// Their names.
    pub names: Arc<[String]>,
    /// What never changes of them.
    pub members: Arc<Members>,
    /// The robots after the last tick, by their places.
    pub now: Arc<Vec<CrowdRobot>>,
    /// The robots one tick before, or the same where that is not known.
    pub before: Arc<Vec<CrowdRobot>>,
    /// How far the view is on the way from the tick before to the last one, from 0 to 1.
    pub between: f64,
}

impl CrowdView {
    /// The robot's place in the lists, for an id of this crowd.
    pub fn place(&self, id: u32) -> Option<usize> {
        let place = id.checked_sub(self.first)? as usize;
        (place < self.names.len()).then_some(place)
    }

    /// The robot's name, for an id of this crowd.
    pub fn name(&self, id: u32) -> Option<&str> {
        self.names.get(self.place(id)?).map(String::as_str)
    }

    /// Contact episodes of all robots since the start.
    pub fn contacts(&self) -> u64 {
        self.now.iter().map(|robot| u64::from(robot.contacts)).sum()
    }

    /// Where the robot at a place is on its way from the tick before.
    pub fn spot(&self, place: usize) -> Option<RobotCircle> {
        let mut spot = self.spot_of(place, self.now.get(place)?)?;
        if let Some(before) = self.moving(place).and_then(|before| self.spot_of(place, before)) {
            let back = before.centre - spot.centre;
            if back.norm_squared() <= MAX_DRIVEN * MAX_DRIVEN {
                spot.centre += back * (1.0 - self.between);
            }
        }
        Some(spot)
    }

    /// The vector from the centre of a robot's circle to the robot's middle.
    pub fn middle(&self, place: usize) -> Vector2 {
        match self.now.get(place).map(|robot| &robot.stance) {
            Some(Stance::In(q)) => self.members.circle(place).map_or(Vector2::zeros(), |circle| circle.middle(q)),
            _ => Vector2::zeros(),
        }
    }

    /// What is drawn of the robot at a place: its footprint on the way from the tick before, or where it now is if it
    /// did not move there.
    pub fn drawn(&self, place: usize) -> Option<DrawnFootprint> {
        let now = &self.now.get(place)?.stance;
        let before = self.moving(place).map(|before| &before.stance);
        match (now, before) {
            (Stance::In(now), Some(Stance::In(before))) => {
                let q = self.members.configuration(place, now)?;
                let from = self.members.configuration(place, before).filter(|from| self.is_a_step(place, from, &q));
                let on_the_way = from.and_then(|from| from.interpolate(&q, self.between).ok());
                self.members.footprint(place, &on_the_way.unwrap_or(q))
            }
            (Stance::Over(now, heading), Some(Stance::Over(before, from))) => {
                let heading = heading.map(|to| from.map_or(to, |from| angle_between(from, to, self.between)));
                Some((blend(before, now, self.between, MAX_DRIVEN), heading))
            }
            _ => self.footprint(place),
        }
    }

    /// The robot's footprint now, by its place.
    pub fn footprint(&self, place: usize) -> Option<DrawnFootprint> {
        match &self.now.get(place)?.stance {
            Stance::In(q) => self.members.footprint(place, &self.members.configuration(place, q)?),
            Stance::Over(footprint, heading) => Some((Footprint::clone(footprint), *heading)),
        }
    }

    /// The id of the robot that is nearest to a point by the box around it, within `reach` metres. Of those whose boxes
    /// hold the point it is the one whose middle is nearest.
    pub fn nearest(&self, at: Point2, reach: f64) -> Option<u32> {
        let off = |b: &Aabb| {
            let near = Point2::new(greater(b.min.x, lesser(b.max.x, at.x)), greater(b.min.y, lesser(b.max.y, at.y)));
            ((near - at).norm(), (b.centre() - at).norm())
        };
        let gap = |place: &usize| {
            let spot = self.spot_of(*place, self.now.get(*place)?)?;
            ((spot.centre - at).norm() <= spot.radius + reach).then_some(())?;
            Some(off(&self.footprint(*place)?.0.bounds()?)).filter(|(gap, _)| *gap <= reach)
        };
        let near = (0..self.now.len()).filter_map(|place| Some((gap(&place)?, self.first + place as u32)));
        near.min_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, id)| id)
    }

    /// The robot at a place one tick before, while the view is on the way from there.
    fn moving(&self, place: usize) -> Option<&CrowdRobot> {
        self.before.get(place).filter(|_| self.between < 1.0)
    }

    fn spot_of(&self, place: usize, robot: &CrowdRobot) -> Option<RobotCircle> {
        match &robot.stance {
            Stance::In(q) => {
                let circle = self.members.circle(place)?;
                Some(RobotCircle { centre: circle.centre(q)?, radius: circle.radius, size: circle.size })
            }
            Stance::Over(footprint, _) => {
                let bounds = footprint.bounds()?;
                let extent = bounds.max - bounds.min;
                Some(RobotCircle {
                    centre: bounds.centre(),
                    radius: 0.5 * extent.norm(),
                    size: greater(extent.x, extent.y),
                })
            }
        }
    }

    /// Whether no point of a robot moved far from one configuration to the other: it was not put there.
    fn is_a_step(&self, place: usize, from: &AnyConfiguration, to: &AnyConfiguration) -> bool {
        let (Some(circle), Ok(steps)) = (self.members.circle(place), from.difference(to)) else { return false };
        let is_arm = matches!(to, AnyConfiguration::T2(_) | AnyConfiguration::T3(_));
        let moved = |steps: &[f64]| match steps {
            joints if is_arm => joints.iter().map(|joint| joint.abs()).sum::<f64>() * circle.radius,
            [x, y, ..] => Vector2::new(*x, *y).norm(),
            _ => 0.0,
        };
        moved(&steps) <= MAX_DRIVEN
    }
}
