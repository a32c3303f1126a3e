//! `TangentSearch`, the shortest way over rims, by A*.

use crate::geometry::Point2;
use crate::num::{hypot, sqrt};
use crate::planning::Queue;

use super::rim::{Rim, Tangent, free_turn, turned};
use super::space::DiscSpace;

/// The rims of the two ends, which are points.
const START: usize = 0;
const GOAL: usize = 1;

/// The greatest number of lines that a search holds: some 100 MB.
const MAX_RIM_PATHS: usize = 1 << 20;

/// A way to a rim: the way to the rim before, along an arc on that, and by a line that touches both.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimPath {
    /// The line to the rim before; `None` where that is the start.
    pub(super) before: Option<usize>,
    rim: usize,
    /// The side to which one turns on its rim: 1 to the left, -1 to the right.
    turn: f64,
    tangent: Tangent,
    /// The length of the whole way, metres.
    pub(super) cost: f64,
}

/// What a search has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TangentStep {
    /// The shortest way to a rim, by the number of its last line.
    Rim(usize),
    /// The shortest way to the goal.
    Goal(usize),
    /// There is no way.
    Nothing,
    /// There are more lines than it examines. No way is shorter than [`TangentSearch::bound`].
    TooMany,
}

/// A search for the shortest way of a point that keeps off the obstacles, as far as the rims' radii.
///
/// Lines are examined in the order of the least length that a whole way through them has, and checked when their
/// turn has come.
#[derive(Clone, Debug)]
pub(super) struct TangentSearch {
    space: DiscSpace,
    rims: Vec<Rim>,
    /// The blocked intervals of the rims that were reached.
    blocked: Vec<Option<Vec<[f64; 2]>>>,
    lines: Vec<RimPath>,
    open: Queue,
    /// The lines that are the shortest ways, by rim.
    closed: Vec<Vec<usize>>,
    bound: f64,
}

impl TangentSearch {
    pub(super) fn new(space: DiscSpace, start: Point2, goal: Point2) -> Self {
        let mut rims = vec![Rim::point(start), Rim::point(goal)];
        rims.extend(space.rims());
        let (blocked, closed) = (vec![None; rims.len()], vec![Vec::new(); rims.len()]);
        let mut search =
            TangentSearch { space, rims, blocked, lines: Vec::new(), open: Queue::new(), closed, bound: 0.0 };
        search.leave(None);
        search
    }

    /// The number of rims, the two ends among them.
    pub(super) fn rim_count(&self) -> usize {
        self.rims.len()
    }

    /// A length that no way to the goal undercuts, metres.
    pub(super) fn bound(&self) -> f64 {
        self.bound
    }

    pub(super) fn way(&self, number: usize) -> &RimPath {
        &self.lines[number]
    }

    /// Looks for the next shortest way to a rim.
    pub(super) fn next(&mut self) -> TangentStep {
        while let Some(number) = self.open.pop() {
            self.bound = self.least(&self.lines[number]);
            if !self.is_shortest(number) {
                continue;
            }
            let rim = self.lines[number].rim;
            if rim == GOAL {
                return TangentStep::Goal(number);
            }
            if self.lines.len() > MAX_RIM_PATHS {
                return TangentStep::TooMany;
            }
            self.closed[rim].push(number);
            self.leave(Some(number));
            return TangentStep::Rim(number);
        }
        TangentStep::Nothing
    }

    /// The least length of a way to the goal through a line.
    fn least(&self, line: &RimPath) -> f64 {
        let rest = self.rims[GOAL].centre - line.tangent.to;
        line.cost + hypot(rest.x, rest.y)
    }

    /// Whether a line is free, and no way that is closed leads along its rim to the same place as shortly.
    fn is_shortest(&mut self, number: usize) -> bool {
        let RimPath { rim, turn, tangent, cost, .. } = self.lines[number];
        for other in self.closed[rim].clone() {
            let RimPath { turn: other_turn, tangent: Tangent { arrives: from, .. }, cost: before, .. } =
                self.lines[other];
            if other_turn != turn {
                continue;
            }
            let angle = turned(turn, from, tangent.arrives);
            if before + self.rims[rim].radius * angle <= cost && angle <= self.free_turn(rim, turn, from) {
                return false;
            }
        }
        self.space.is_free(tangent.from, tangent.to)
    }

    fn free_turn(&mut self, rim: usize, turn: f64, from: f64) -> f64 {
        if self.rims[rim].radius == 0.0 {
            return f64::INFINITY;
        }
        let space = &self.space;
        let blocked = self.blocked[rim].get_or_insert_with(|| space.blocked(&self.rims[rim]));
        free_turn(blocked, turn, from)
    }

    /// Opens the lines that leave a rim after a way to it, or the start.
    fn leave(&mut self, before: Option<usize>) {
        let (rim, turn, arrived, cost) = match before {
            None => (START, 1.0, 0.0, 0.0),
            Some(line) => {
                let RimPath { rim, turn, tangent, cost, .. } = self.lines[line];
                (rim, turn, tangent.arrives, cost)
            }
        };
        let free = self.free_turn(rim, turn, arrived);
        for to in (GOAL..self.rims.len()).filter(|to| *to != rim) {
            let turns: &[f64] = if to == GOAL { &[1.0] } else { &[1.0, -1.0] };
            for &next in turns {
                let Some(tangent) = self.rims[rim].tangent(turn, &self.rims[to], next) else { continue };
                let angle = turned(turn, arrived, tangent.leaves);
                if angle > free {
                    continue;
                }
                let cost = cost + self.rims[rim].radius * angle + tangent.length;
                let line = RimPath { before, rim: to, turn: next, tangent, cost };
                self.open.push(self.least(&line), self.lines.len());
                self.lines.push(line);
            }
        }
    }

    /// The corners of a way from the rim before a line to the end of that: on the arc, at most so far apart that the
    /// straight lines between them come nearer than the rim by a distance, then the end of the line.
    pub(super) fn corners(&self, number: usize, nearer: f64) -> Vec<Point2> {
        let tangent = self.lines[number].tangent;
        let mut corners = Vec::new();
        if let Some(before) = self.lines[number].before {
            let RimPath { rim, turn, tangent: arrival, .. } = self.lines[before];
            let rim = &self.rims[rim];
            let angle = turned(turn, arrival.arrives, tangent.leaves);
            // the middle of a chord is nearer than its ends by `r (1 - cos (part / 2))`, less than `r part^2 / 8`
            let part = sqrt(8.0 * nearer / rim.radius);
            let count = (angle / part).ceil() as u32;
            corners.extend((1..=count).map(|k| {
                let share = f64::from(k) / f64::from(count);
                rim.at(arrival.arrives + turn * angle * share)
            }));
        }
        corners.push(tangent.to);
        corners
    }
}
