//! `Crowd`, the robots of a world of many, as plain values.

use std::sync::Arc;

use crate::geometry::{Aabb, Footprint, Point2};
use crate::num::{greater, lesser};

/// Largest number of robots of a world that are shown one by one, each with its words. More are a crowd.
pub const MOST_SHOWN_EACH: usize = 3;

/// One robot of a crowd after a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct CrowdRobot {
    /// Its footprint.
    pub footprint: Footprint,
    /// The box around it.
    pub bounds: Aabb,
    /// Its heading, radians, for a robot of one part that is no arm; otherwise `None`.
    pub heading: Option<f64>,
    /// Whether its contact flash is on.
    pub flash: bool,
    /// Contact episodes since the start.
    pub contacts: u32,
}

/// The robots of a world of many.
#[derive(Clone, Debug, PartialEq)]
pub struct Crowd {
    /// The id of the first; the others follow.
    pub first: u32,
    /// Their names.
    pub names: Arc<[String]>,
    /// The robots after the last tick.
    pub now: Arc<Vec<CrowdRobot>>,
    /// The robots one tick before, or the same where that is not known.
    pub before: Arc<Vec<CrowdRobot>>,
    /// How far the view is on the way from the tick before to the last one, from 0 to 1.
    pub between: f64,
}

impl Crowd {
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

    /// The id of the robot that is nearest to a point by the box around it, within `reach` metres. Of those whose boxes
    /// hold the point it is the one whose middle is nearest.
    pub fn nearest(&self, at: Point2, reach: f64) -> Option<u32> {
        let off = |b: &Aabb| {
            let near = Point2::new(greater(b.min.x, lesser(b.max.x, at.x)), greater(b.min.y, lesser(b.max.y, at.y)));
            ((near - at).norm(), (b.centre() - at).norm())
        };
        let all = self.now.iter().zip(self.first..).map(|(robot, id)| (off(&robot.bounds), id));
        let near = all.filter(|((gap, _), _)| *gap <= reach);
        near.min_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, id)| id)
    }
}
