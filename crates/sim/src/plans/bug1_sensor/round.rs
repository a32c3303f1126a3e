//! `Round`, a way all round an obstacle, and `Lap`, one that is not closed yet.

use super::rover::{Rover, Side};
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::greater;

/// Distance from a place at which a rover counts as back there, metres.
pub(super) const BACK: f64 = 0.1;

/// The number of first steps, which bring a rover to the distance that it keeps.
const SETTLE: u32 = 5;

/// Largest number of steps in a round; beyond it the rover is lost. A round along all the walls of the Apartment takes
/// about 1,600.
const LOST: u64 = 5000;

/// A round about an obstacle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    /// The rover's place where the boundary seemed nearest to the goal.
    pub(super) leave: Point2,
    /// The distance gone round until then, metres.
    pub(super) until_leave: f64,
    /// The length of the whole round, metres.
    pub(super) length: f64,
}

/// What a step of a round came to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lapped {
    Going,
    Closed(Round),
    Lost,
}

/// A round that is not closed yet.
#[derive(Clone, Debug)]
pub(super) struct Lap {
    settled: u32,
    /// Where the round began, and what the rover's way and its steps were by then.
    hit: Point2,
    start: f64,
    first: u64,
    /// The least distance of the boundary from the goal so far, metres.
    least: f64,
    leave: Point2,
    until_leave: f64,
    /// Whether the rover has left the place where the round began.
    left: bool,
}

impl Lap {
    /// A round of a rover that has met an obstacle.
    pub(super) fn new(rover: &Rover) -> Self {
        let (hit, start, first) = (rover.at, rover.length, rover.tick);
        Lap { settled: 0, hit, start, first, least: f64::INFINITY, leave: hit, until_leave: 0.0, left: false }
    }

    /// Takes the rover a step on, with the boundary at its right hand.
    pub(super) fn step(&mut self, rover: &mut Rover) -> Lapped {
        if self.settled < SETTLE {
            rover.follow(Side::Right);
            *self = Lap { settled: self.settled + 1, ..Lap::new(rover) };
            return Lapped::Going;
        }
        if rover.tick >= self.first + LOST {
            return Lapped::Lost;
        }
        let from = rover.at;
        let wall = rover.follow(Side::Right);
        // the rover's place beside that point of the wall, on this side of it, because a wall may be thin
        let apart = greater((from - wall).norm(), 1e-6);
        let seen = (wall + (from - wall) * (rover.keep() / apart) - rover.goal).norm();
        if seen < self.least {
            (self.least, self.leave, self.until_leave) = (seen, from, rover.length - self.start);
        }
        let home = (rover.at - self.hit).norm();
        self.left = self.left || home > 3.0 * BACK;
        if self.left && home < BACK {
            let length = rover.length - self.start;
            return Lapped::Closed(Round { leave: self.leave, until_leave: self.until_leave, length });
        }
        Lapped::Going
    }
}
