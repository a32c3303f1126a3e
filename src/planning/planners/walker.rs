//! `Walker`, what Bug1 and Bug2 share: a disc that heads for its goal and follows boundaries.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration, Coordinates};
use crate::geometry::{Point2, Vector2};
use crate::num::{greater, hypot, lesser};
use crate::planning::{Growth, LinePath};
use crate::robots::{ChartLine, Robot};

/// How often a step along a boundary is halved before the walker is stuck.
const HALVINGS: u32 = 12;

/// The clearance that the usual walker keeps from a boundary, as a share of its radius.
const KEEP: f64 = 0.5;

/// A disc on its way. Every step is an edge that was proven free, and a node of the growth.
#[derive(Clone, Debug)]
pub(super) struct Walker<R: Robot> {
    pub(super) problem: Problem<R>,
    pub(super) growth: Growth<R::Configuration, ChartLine<R>>,
    /// The clearance that it keeps from a boundary that it follows, metres.
    pub(super) keep: f64,
}

/// The result of a step toward the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Headed {
    Moved,
    Arrived,
    Blocked,
}

/// The nearest boundary.
#[derive(Clone, Copy, Debug)]
struct Wall {
    clearance: f64,
    /// The unit vector from the walker's centre to it.
    toward: Vector2,
}

impl<R: Robot<Configuration: Chart>> Walker<R> {
    /// A walker at the start; `None` where the robot is not a disc.
    pub(super) fn try_new(problem: &Problem<R>) -> Option<Self> {
        let start = problem.start().in_chart();
        let footprint = problem.checker().robot().footprint(&start);
        let [part] = footprint.parts() else { return None };
        if part.placed().core().len() != 1 {
            return None;
        }
        let mut growth = Growth::new();
        growth.add_root(start);
        Some(Walker { problem: problem.clone(), growth, keep: KEEP * part.placed().radius() })
    }

    /// The number of the node at which it is.
    pub(super) fn node(&self) -> usize {
        self.growth.nodes().len() - 1
    }

    /// Where its centre was at a node, metres.
    pub(super) fn place(&self, node: usize) -> Point2 {
        let c = self.growth.at(node).coordinates();
        Point2::new(c[0], c[1])
    }

    /// Where its centre is.
    pub(super) fn here(&self) -> Point2 {
        self.place(self.node())
    }

    /// Where the goal is.
    pub(super) fn goal(&self) -> Point2 {
        let c = self.problem.goal().coordinates();
        Point2::new(c[0], c[1])
    }

    /// The length of a step along a boundary, metres.
    pub(super) fn stride(&self) -> f64 {
        0.5 * self.keep
    }

    /// Goes straight to a configuration, if that is free.
    pub(super) fn go(&mut self, to: R::Configuration) -> bool {
        let node = self.node();
        let free = self.growth.ask_edge(self.problem.checker(), &self.growth.at(node), &to);
        if free {
            self.growth.add(to, node);
        }
        free
    }

    fn step(&mut self, by: Vector2) -> bool {
        let here = self.growth.at(self.node());
        let mut tangent: Coordinates = here.coordinates().iter().map(|_| 0.0).collect();
        (tangent[0], tangent[1]) = (by.x, by.y);
        here.exp(&tangent).is_some_and(|to| self.go(to))
    }

    fn wall(&self) -> Option<Wall> {
        let witness = self.problem.checker().witness(&self.growth.at(self.node())).ok()??;
        let toward = witness.on_obstacle - self.here();
        let apart = hypot(toward.x, toward.y);
        (apart > 0.0).then(|| Wall { clearance: witness.dist, toward: toward / apart })
    }

    /// Takes a step toward the goal, as long as the clearance allows. It is blocked at a boundary that lies ahead.
    pub(super) fn head(&mut self) -> Headed {
        let way = self.goal() - self.here();
        let distance = hypot(way.x, way.y);
        if self.arrive() {
            return Headed::Arrived;
        }
        let Some(wall) = self.wall() else {
            return if self.go(self.problem.goal().in_chart()) { Headed::Arrived } else { Headed::Blocked };
        };
        let is_at_wall = wall.clearance <= 1.05 * self.keep;
        if is_at_wall && wall.toward.dot(&way) > 0.0 {
            return Headed::Blocked;
        }
        let length = lesser(greater(wall.clearance - self.keep, self.stride()), distance);
        if self.step(way * (length / distance)) { Headed::Moved } else { Headed::Blocked }
    }

    /// Goes to the goal where that is near and in sight: it may lie nearer to a boundary than the walker keeps.
    pub(super) fn arrive(&mut self) -> bool {
        let way = self.goal() - self.here();
        hypot(way.x, way.y) <= 4.0 * self.keep && self.go(self.problem.goal().in_chart())
    }

    /// Takes a step along the nearest boundary, which is at its right hand. False where it is stuck.
    pub(super) fn follow(&mut self) -> bool {
        let Some(wall) = self.wall() else { return false };
        let along = Vector2::new(-wall.toward.y, wall.toward.x);
        let correction = (4.0 * (wall.clearance - self.keep) / self.keep).clamp(-1.0, 1.0);
        let direction = along + wall.toward * correction;
        let mut length = self.stride() / hypot(direction.x, direction.y);
        for _ in 0..HALVINGS {
            if self.step(direction * length) {
                return true;
            }
            length *= 0.5;
        }
        false
    }

    /// The certified path from the start to where it is.
    pub(super) fn path(&self) -> Option<LinePath<R>> {
        self.growth.certified(self.problem.checker(), &self.growth.branch(self.node()))
    }
}
