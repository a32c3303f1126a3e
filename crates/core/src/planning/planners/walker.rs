//! `Walker`, what Bug1 and Bug2 share: a disc that heads for its goal and follows boundaries.

use std::f64::consts::{PI, TAU};

use super::disc::{moved, position, radius_of};
use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::geometry::{Point2, Vector2};
use crate::num::{greater, hypot, lesser, sin_cos};
use crate::planning::{NoPath, Search};
use crate::robots::{Robot, nearest_side, to_sides};

/// The first direction that a step along a boundary tries, from the heading: back and to the right, radians.
const RIGHT: f64 = -0.75 * PI;

/// The number of directions that it tries, a whole turn.
const DIRECTIONS: u32 = 48;

/// The angle between two of them, radians.
const TURN: f64 = TAU / 48.0;

/// How often the angle between a direction that keeps the clearance and one that does not is halved.
const HALVINGS: u32 = 6;

/// The clearance that the usual walker keeps from a boundary, as a share of its radius.
const KEEP: f64 = 0.5;

/// The least that it keeps, once there is no gap for one that keeps more.
const LEAST_KEEP: f64 = 0.0625;

/// The number of steps after which the first round that is not closed begins again.
const LONGEST_ROUND: usize = 1 << 14;

/// The number of steps along a boundary in which the walker comes to the clearance that it keeps.
pub(super) const SETTLE: usize = 16;

/// A disc on its way. Every step is an edge that was proven free, and a node of the growth.
#[derive(Clone, Debug)]
pub(super) struct Walker<R: Robot> {
    pub(super) search: Search<R>,
    /// The clearance that it keeps from a boundary that it follows, metres.
    pub(super) keep: f64,
    /// The least that it may keep, metres.
    least_keep: f64,
    /// The number of steps after which a round that is not closed begins again where the walker is.
    longest_round: usize,
    /// The direction in which it follows a boundary, a unit vector.
    heading: Vector2,
}

/// The distance of two points, metres.
pub(super) fn apart(a: Point2, b: Point2) -> f64 {
    hypot(a.x - b.x, a.y - b.y)
}

/// The result of a step toward the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Headed {
    Moved,
    Arrived,
    Blocked,
}

impl<R: Robot<Configuration: Chart>> Walker<R> {
    /// A walker at the start; `None` where the robot is not a disc.
    pub(super) fn try_new(problem: &Problem<R>) -> Option<Self> {
        let start = problem.start().in_chart();
        let radius = radius_of(&problem.checker().robot().footprint(&start))?;
        let search = Search::from_start(problem.clone());
        Some(Walker {
            search,
            keep: KEEP * radius,
            least_keep: LEAST_KEEP * radius,
            longest_round: LONGEST_ROUND,
            heading: Vector2::x(),
        })
    }

    /// Keeps half as much from now on, because the goal lies behind an obstacle without a gap for one that keeps more.
    /// The reason why there is no path where that would be less than the least.
    pub(super) fn keep_half(&mut self) -> Option<NoPath> {
        if self.keep <= self.least_keep {
            return Some(NoPath::Enclosed { kept: self.keep });
        }
        self.keep *= 0.5;
        None
    }

    /// The number of the node at which it is.
    pub(super) fn node(&self) -> usize {
        self.search.growth.nodes().len() - 1
    }

    /// Where its centre was at a node, metres.
    pub(super) fn place(&self, node: usize) -> Point2 {
        position(&self.search.at(node))
    }

    pub(super) fn here(&self) -> Point2 {
        self.place(self.node())
    }

    pub(super) fn goal(&self) -> Point2 {
        position(&self.search.problem.goal())
    }

    /// The length of a step along a boundary, metres.
    pub(super) fn stride(&self) -> f64 {
        0.5 * self.keep
    }

    /// Goes straight to a configuration, if that is free.
    pub(super) fn go(&mut self, to: R::Configuration) -> bool {
        self.search.reach(self.node(), to).is_some()
    }

    fn moved(&self, by: Vector2) -> Option<R::Configuration> {
        moved(&self.search.at(self.node()), by)
    }

    fn step(&mut self, by: Vector2) -> bool {
        self.moved(by).is_some_and(|to| self.go(to))
    }

    /// The clearance that it would have after moving by a vector, metres. The sides of the scene's bounds are walls for
    /// the disc's centre.
    fn clearance(&self, by: Vector2) -> f64 {
        let checker = self.search.problem.checker();
        let to_sides = to_sides(&checker.scene().bounds(), self.here() + by);
        self.moved(by).map_or(0.0, |q| lesser(checker.distance(&q), greater(to_sides, 0.0)))
    }

    /// Takes a step toward the goal, as long as the clearance allows. It is blocked where that would come nearer to a
    /// boundary than it keeps.
    pub(super) fn head(&mut self) -> Headed {
        self.head_keeping(self.keep)
    }

    /// As [`head`](Self::head), keeping half the clearance. Whoever leaves a boundary that runs almost along its way
    /// comes nearer to it at first by a hair.
    pub(super) fn leave(&mut self) -> Headed {
        self.head_keeping(0.5 * self.keep)
    }

    /// Whether it has the clearance that it keeps.
    pub(super) fn is_clear(&self) -> bool {
        self.clearance(Vector2::zeros()) >= self.keep
    }

    fn head_keeping(&mut self, least: f64) -> Headed {
        if self.arrive() {
            return Headed::Arrived;
        }
        let way = self.goal() - self.here();
        let (distance, clearance) = (hypot(way.x, way.y), self.clearance(Vector2::zeros()));
        let length = lesser(greater(clearance - self.keep, self.stride()), distance);
        let by = way * (length / distance);
        if self.clearance(by) >= lesser(least, clearance) && self.step(by) {
            return Headed::Moved;
        }
        self.face();
        Headed::Blocked
    }

    /// Its clearance where it is, metres, and the unit vector to the nearest boundary, of an obstacle or a side of the
    /// bounds.
    fn nearest(&self) -> (f64, Vector2) {
        let checker = self.search.problem.checker();
        let side = nearest_side(&checker.scene().bounds(), self.here());
        match checker.witness(&self.search.at(self.node())).ok().flatten() {
            Some(witness) if witness.dist <= side.0 => {
                let toward = witness.on_obstacle - self.here();
                (witness.dist, toward / greater(hypot(toward.x, toward.y), f64::MIN_POSITIVE))
            }
            _ => side,
        }
    }

    /// Turns so that the nearest boundary is at its right hand.
    fn face(&mut self) {
        let (_, toward) = self.nearest();
        self.heading = Vector2::new(-toward.y, toward.x);
    }

    /// Goes to the goal where that is near and in sight: it may lie nearer to a boundary than the walker keeps.
    pub(super) fn arrive(&mut self) -> bool {
        let way = self.goal() - self.here();
        hypot(way.x, way.y) <= 4.0 * self.keep && self.go(self.search.problem.goal().in_chart())
    }

    /// Takes a step along the boundary at its right hand: in the first direction from the right on, turning left, that
    /// keeps the clearance. False where there is none.
    pub(super) fn follow(&mut self) -> bool {
        let least = lesser(self.keep, self.clearance(Vector2::zeros()));
        let keeps = |walker: &Self, turn: f64| walker.clearance(walker.turned(turn) * walker.stride()) >= least;
        let Some(first) = (0..DIRECTIONS).find(|k| keeps(self, RIGHT + TURN * f64::from(*k))) else { return false };
        if first == 0 && self.clearance(Vector2::zeros()) > self.keep {
            // nothing is at the right hand: it would go in circles
            return self.approach();
        }
        // between the last direction that does not and the first that does
        let [mut less, mut more] = [RIGHT + TURN * (f64::from(first) - 1.0), RIGHT + TURN * f64::from(first)];
        for _ in 0..if first == 0 { 0 } else { HALVINGS } {
            let middle = 0.5 * (less + more);
            if keeps(self, middle) {
                more = middle;
            } else {
                less = middle;
            }
        }
        self.heading = self.turned(more);
        self.step(self.heading * self.stride())
    }

    /// Takes a step to the nearest boundary, up to the clearance that it keeps, and turns along it.
    fn approach(&mut self) -> bool {
        let (clearance, toward) = self.nearest();
        let is_there = self.step(toward * lesser(clearance - self.keep, self.stride()));
        self.face();
        is_there
    }

    /// The nodes of the shorter way from the end of a round, which began at node `from`, to the place nearest to the
    /// goal, the first one last.
    pub(super) fn way_back(&self, from: usize, end: usize) -> Vec<usize> {
        let far = |node: usize| apart(self.place(node), self.goal());
        let leave = (from..=end).fold(from, |best, node| if far(node) < far(best) { node } else { best });
        let length =
            |a: usize, b: usize| -> f64 { (a..b).map(|node| apart(self.place(node), self.place(node + 1))).sum() };
        if length(from, leave) <= length(leave, end) {
            // once more the way that it went round
            (from..=leave).rev().collect()
        } else {
            (leave..end).collect()
        }
    }

    /// Where a round begins that has begun at node `from`: here, once it has gone on for too long, and the next one may
    /// be twice as long (Brent's way to find a cycle). A round may begin at a place that it does not come back to.
    pub(super) fn beginning(&mut self, from: usize) -> usize {
        if self.node() - from <= self.longest_round {
            return from;
        }
        self.longest_round *= 2;
        self.node()
    }

    /// Whether a round that began at node `from` is closed where it is.
    pub(super) fn is_back(&self, from: usize) -> bool {
        let node = self.node();
        node > from + SETTLE && apart(self.place(node), self.place(from)) < self.stride()
    }

    /// Its heading turned by an angle, radians to the left.
    fn turned(&self, angle: f64) -> Vector2 {
        let ((sin, cos), v) = (sin_cos(angle), self.heading);
        Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
    }

    /// Takes the way from the start to where it is as the path; the reason is why that is none.
    pub(super) fn arrived(&mut self) -> Option<NoPath> {
        if self.search.take_branch(self.node()) { None } else { Some(self.stuck()) }
    }

    /// It can't go on from where it is.
    pub(super) fn stuck(&self) -> NoPath {
        NoPath::LocalMinimum { node: self.node() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{Checker, Scene};
    use crate::configuration::R2;
    use crate::geometry::{Aabb, Segment, Shape};
    use crate::random::Seed;
    use crate::robots::RustyDisc;

    /// A disc of 10 cm at a place in a room of 4 by 4 metres with a wall on x = 0.
    fn walker(x: f64, y: f64) -> Walker<RustyDisc> {
        let bounds = Aabb { min: Point2::new(-2.0, -2.0), max: Point2::new(2.0, 2.0) };
        let Segment { a, b } = Segment::new(Point2::new(0.0, -2.0), Point2::new(0.0, 2.0));
        let scene = Scene::empty(bounds).with_obstacle("the wall", Shape::Segment { a, b });
        let checker = Checker::new(scene, RustyDisc::try_new(0.1).unwrap());
        let problem = Problem::try_new(checker, R2::new(x, y), R2::new(1.0, 1.0), Seed(1)).unwrap();
        Walker::try_new(&problem).unwrap()
    }

    /// A side of the bounds stops the disc's centre, a wall its edge.
    #[test]
    fn the_nearest_boundary_is_a_wall_or_a_side_whichever_is_nearer() {
        for ((x, y), distance, toward) in [
            ((-0.5, 0.0), 0.4, [1.0, 0.0]),
            ((0.5, 0.0), 0.4, [-1.0, 0.0]),
            ((-1.75, 0.5), 0.25, [-1.0, 0.0]),
            ((-1.0, 1.5), 0.5, [0.0, 1.0]),
            ((-1.0, -1.25), 0.75, [0.0, -1.0]),
        ] {
            let (found, way) = walker(x, y).nearest();
            assert!((found - distance).abs() < 1e-12, "{found} at {x}, {y}");
            assert!((way - Vector2::new(toward[0], toward[1])).norm() < 1e-12, "{way} at {x}, {y}");
        }
    }

    /// Brent's way: the next round may be twice as long, and so every cycle is found in a few times its length.
    #[test]
    fn a_round_that_is_not_closed_begins_again_and_may_be_twice_as_long() {
        let mut walker = walker(-1.0, 0.0);
        walker.longest_round = 4;
        let (mut from, mut began) = (0, vec![]);
        for step in 1..=80 {
            assert!(walker.go(R2::new(-1.0, 0.01 * f64::from(step))));
            let next = walker.beginning(from);
            if next != from {
                (from, began) = (next, [began, vec![next]].concat());
            }
        }
        assert_eq!(began, [5, 5 + 9, 14 + 17, 31 + 33], "more than 4, 8, 16 and 32 steps");
    }
}
