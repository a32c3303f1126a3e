//! `Crowd`, the robots of a world of many, as plain values.

use std::sync::Arc;

use crate::geometry::{Aabb, Footprint, Part, Point2};
use crate::num::{greater, lesser};

/// Largest number of robots of a world that are shown one by one, each with its words. More are a crowd.
pub const MOST_SHOWN_EACH: usize = 3;

/// One robot of a crowd after a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct CrowdRobot {
    /// The box around it.
    pub bounds: Aabb,
    /// Its heading, radians, for a robot of one part that is no arm; otherwise `None`.
    pub heading: Option<f64>,
    /// Whether its contact flash is on.
    pub flash: bool,
    /// Contact episodes since the start.
    pub contacts: u32,
    /// The number of the last of its parts among those of all, plus one.
    parts_end: u32,
}

/// The robots of a crowd after a tick. What every frame reads of each is apart from their parts, which are many times
/// as large and are read only where a robot is seen large enough.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bodies {
    robots: Vec<CrowdRobot>,
    parts: Vec<Part>,
}

impl Bodies {
    /// Adds a robot.
    pub fn push(&mut self, footprint: &Footprint, heading: Option<f64>, flash: bool, contacts: u32) {
        let bounds = footprint.bounds().unwrap_or(Aabb::new(Point2::origin(), Point2::origin()));
        self.parts.extend_from_slice(footprint.parts());
        let parts_end = self.parts.len() as u32;
        self.robots.push(CrowdRobot { bounds, heading, flash, contacts, parts_end });
    }

    /// Forgets the robots and keeps the room for as many.
    pub fn clear(&mut self) {
        self.robots.clear();
        self.parts.clear();
    }

    /// The robots by their places.
    pub fn robots(&self) -> &[CrowdRobot] {
        &self.robots
    }

    /// The parts of the robot at a place; none where nobody is.
    pub fn parts(&self, place: usize) -> &[Part] {
        let end = |place: usize| self.robots.get(place).map_or(0, |robot| robot.parts_end as usize);
        let begin = place.checked_sub(1).map_or(0, end);
        self.parts.get(begin..end(place)).unwrap_or_default()
    }
}

/// The robots of a world of many.
#[derive(Clone, Debug, PartialEq)]
pub struct Crowd {
    /// The id of the first; the others follow.
    pub first: u32,
    /// Their names.
    pub names: Arc<[String]>,
    /// The robots after the last tick.
    pub now: Arc<Bodies>,
    /// The robots one tick before, or the same where that is not known.
    pub before: Arc<Bodies>,
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
        self.now.robots().iter().map(|robot| u64::from(robot.contacts)).sum()
    }

    /// The id of the robot that is nearest to a point by the box around it, within `reach` metres. Of those whose boxes
    /// hold the point it is the one whose middle is nearest.
    pub fn nearest(&self, at: Point2, reach: f64) -> Option<u32> {
        let off = |b: &Aabb| {
            let near = Point2::new(greater(b.min.x, lesser(b.max.x, at.x)), greater(b.min.y, lesser(b.max.y, at.y)));
            ((near - at).norm(), (b.centre() - at).norm())
        };
        let all = self.now.robots().iter().zip(self.first..).map(|(robot, id)| (off(&robot.bounds), id));
        let near = all.filter(|((gap, _), _)| *gap <= reach);
        near.min_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, id)| id)
    }
}
