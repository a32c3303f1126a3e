//! `TangentGraph`, the planner.

use std::collections::BTreeMap;

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::geometry::Point2;
use crate::num::{greater, lesser};
use crate::planning::planners::disc::{moved, position, radius_of};
use crate::planning::{NoPath, Planner, Search};
use crate::robots::Robot;

use super::bound::length_bound;
use super::search::{TangentSearch, TangentStep};
use super::space::DiscSpace;

/// The clearance that the planner keeps about corners at first, metres.
const FIRST_CLEARANCE: f64 = 1e-4;

/// The least that it keeps, where more leads nowhere or the long way round.
const LEAST_CLEARANCE: f64 = 5e-6;

/// The least that it keeps where an end has less: an arc of a metre's radius is then some thousands of lines.
const LEAST_NEAR_ENDS: f64 = 1e-7;

/// How much longer than a shortest path a path may be, metres, before the planner keeps less.
const CLOSE: f64 = 1e-3;

/// The shortest path of a robot that is a disc, by tangents and arcs (Liu and Arimoto, 1992), searched by A*.
///
/// Each arc is drawn by straight lines that leave a clearance of 0.1 to 0.05 mm about its corner. Where that leads to
/// no path, or to one that is longer than a [shortest](length_bound) by more than a millimetre, the planner halves it,
/// down to 5 micrometres. Where an end has less clearance, it keeps half of that, at least 0.1 micrometres. Headings
/// turn on the way to the goal, on the path's last leg.
///
/// An iteration takes the shortest way to one more corner and asks about the lines of that. A robot that is not a disc
/// ends it with [`NoPath::Unsuited`]. [`NoPath::Unsuited`] too, once it has more than a million lines to look at: among
/// some thousand walls. [`NoPath::NoneInGraph`] is no proof; an infinite [`length_bound`] says that there is no path.
#[derive(Clone, Debug)]
pub struct TangentGraph<R: Robot> {
    search: Search<R>,
    radius: f64,
    kept: f64,
    tangents: TangentSearch,
    /// The nodes of the tangents' lines that were reached.
    nodes: BTreeMap<usize, usize>,
    /// The shortest way yet: its length, and the node at its end.
    best: Option<(f64, usize)>,
    /// The length that no path undercuts, once it was needed.
    bound: Option<f64>,
}

impl<R: Robot<Configuration: Chart>> TangentGraph<R> {
    /// The planner, with the tangents that leave the start.
    pub fn new(problem: Problem<R>) -> Self {
        let checker = problem.checker();
        let radius = radius_of(&checker.robot().footprint(&problem.start()));
        let ends = lesser(checker.distance(&problem.start()), checker.distance(&problem.goal()));
        let kept = greater(lesser(FIRST_CLEARANCE, 0.5 * ends), LEAST_NEAR_ENDS);
        let tangents = Self::tangents(&problem, radius.unwrap_or(0.0) + kept);
        let mut search = Search::from_start(problem);
        search.end = radius.is_none().then_some(NoPath::Unsuited("a tangent graph is for robots that are discs"));
        let radius = radius.unwrap_or(0.0);
        TangentGraph { search, radius, kept, tangents, nodes: BTreeMap::new(), best: None, bound: None }
    }

    fn tangents(problem: &Problem<R>, distance: f64) -> TangentSearch {
        let space = DiscSpace::new(problem.checker().scene(), distance);
        TangentSearch::new(space, position(&problem.start()), position(&problem.goal()))
    }

    /// Adds the nodes of a way to a rim, and returns the last one; `None` where one of its lines is not proven free.
    fn reach(&mut self, line: usize, is_goal: bool) -> Option<usize> {
        let mut node = match self.tangents.way(line).before {
            Some(before) => *self.nodes.get(&before)?,
            None => 0,
        };
        let mut corners = self.tangents.corners(line, 0.5 * self.kept);
        if is_goal {
            corners.pop();
        }
        for corner in corners {
            let to = self.at(corner)?;
            if to != self.search.at(node) {
                node = self.search.reach(node, to)?;
            }
        }
        if is_goal {
            node = self.search.reach(node, self.search.problem.goal().in_chart())?;
        }
        self.nodes.insert(line, node);
        Some(node)
    }

    /// The start's configuration, moved to a point.
    fn at(&self, p: Point2) -> Option<R::Configuration> {
        let start = self.search.at(0);
        moved(&start, p - position(&start))
    }

    /// Takes the best path if it is close to a shortest one or none nearer to the corners is to be had; otherwise
    /// begins again with half the clearance.
    fn conclude(&mut self) {
        let problem = &self.search.problem;
        let bound = *self.bound.get_or_insert_with(|| length_bound(problem).unwrap_or(0.0));
        let is_close = self.best.is_some_and(|(length, _)| length <= bound + CLOSE);
        if !is_close && bound < f64::INFINITY && 0.5 * self.kept >= LEAST_CLEARANCE {
            self.kept *= 0.5;
            self.tangents = Self::tangents(problem, self.radius + self.kept);
            self.nodes.clear();
            return;
        }
        let taken = self.best.is_some_and(|(_, node)| self.search.take_branch(node));
        self.search.end = (!taken).then_some(NoPath::NoneInGraph { nodes: self.tangents.rim_count() });
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for TangentGraph<R> {
    fn name(&self) -> &'static str {
        "tangent-graph"
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        match self.tangents.next() {
            TangentStep::Rim(line) => _ = self.reach(line, false),
            TangentStep::Goal(line) => {
                if let Some(node) = self.reach(line, true) {
                    let length = self.tangents.way(line).cost;
                    if self.best.is_none_or(|(shortest, _)| length < shortest) {
                        self.best = Some((length, node));
                    }
                    self.conclude();
                }
            }
            TangentStep::Nothing => self.conclude(),
            TangentStep::TooMany if self.best.is_some() => self.conclude(),
            TangentStep::TooMany => {
                self.search.end = Some(NoPath::Unsuited("it looks at a million lines at most, and there are more"))
            }
        }
    }
}
