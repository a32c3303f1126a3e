//! `Search`, what every planner has: its problem, what it has grown, and what came of it.

use super::path::chart_lines;
use super::{CertifiedPath, Growth, NoPath, Progress, UnprovenPath};
use crate::collision::Problem;
use crate::configuration::Configuration as _;
use crate::robots::{ChartLine, Motion, Robot};

/// What every planner has: the problem, what it has grown, and the path or the reason why there is none.
///
/// A planner holds one and lends it by [`Planner::search`](super::Planner::search); the rest of the trait follows from
/// it. `M` is the type of motions that its edges are.
#[derive(Clone, Debug)]
pub struct Search<R: Robot, M = ChartLine<R>> {
    /// The problem.
    pub problem: Problem<R>,
    /// What has been grown so far.
    pub growth: Growth<R::Configuration, M>,
    /// The best path so far.
    pub path: Option<CertifiedPath<M>>,
    /// The best path so far of a search whose checker has a black box: nobody has proven it.
    pub unproven: Option<UnprovenPath<M>>,
    /// Why there will be no path.
    pub end: Option<NoPath>,
    /// The motion between the configurations of two nodes, where they alone determine it.
    between: fn(&R, &R::Configuration, &R::Configuration) -> Option<M>,
}

impl<R: Robot, M: Motion<Configuration = R::Configuration>> Search<R, M> {
    /// A search whose edges are not determined by their ends. Its planner has a
    /// [`motion`](super::Planner::motion) of its own.
    pub fn of_motions(problem: Problem<R>) -> Self {
        Search { problem, growth: Growth::new(), path: None, unproven: None, end: None, between: |_, _, _| None }
    }

    /// What the search has come to.
    pub fn progress(&self) -> Progress {
        match &self.end {
            _ if self.path.is_some() || self.unproven.is_some() => Progress::Solved,
            Some(reason) => Progress::Ended(reason.clone()),
            None => Progress::Growing,
        }
    }

    /// The motion of the edge between two nodes, where their configurations determine it; `None` when there is no such
    /// node.
    pub(super) fn between(&self, from: usize, to: usize) -> Option<M> {
        let at = |node: usize| self.growth.nodes().get(node).map(|node| node.at);
        (self.between)(self.problem.checker().robot(), &at(from)?, &at(to)?)
    }

    /// Takes these motions as the path, if they join and have their certificates; with a black box, if that calls them
    /// free. Returns whether they do. The path before stays where they do not.
    pub fn take_motions(&mut self, motions: Vec<M>) -> bool {
        let checker = self.problem.checker();
        if checker.black_box().is_some() {
            let path = UnprovenPath::try_new(checker, motions).ok();
            let is_called_free = path.is_some();
            self.unproven = path.or_else(|| self.unproven.take());
            is_called_free
        } else {
            let path = CertifiedPath::try_new(checker, motions).ok();
            let is_certified = path.is_some();
            self.path = path.or_else(|| self.path.take());
            is_certified
        }
    }

    /// The configuration of node number `node`.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn at(&self, node: usize) -> R::Configuration {
        self.growth.at(node)
    }
}

impl<R: Robot> Search<R> {
    /// A search by the chart's straight lines, with nothing grown.
    pub fn new(problem: Problem<R>) -> Self {
        Search { between: |robot, a, b| robot.edge(a, b).ok(), ..Self::of_motions(problem) }
    }

    /// A search by the chart's straight lines whose node number 0 is the start.
    pub fn from_start(problem: Problem<R>) -> Self {
        let mut search = Self::new(problem);
        search.growth.add_root(search.problem.start().in_chart());
        search
    }

    /// Asks whether the straight line from `a` to `b` is proven free, and counts it.
    pub fn ask(&mut self, a: &R::Configuration, b: &R::Configuration) -> bool {
        self.growth.ask_edge(self.problem.checker(), a, b)
    }

    /// The new node at `to`, reached from node number `from`; `None` where the line to it is not proven free.
    ///
    /// # Panics
    /// When there is no node `from`.
    pub fn reach(&mut self, from: usize, to: R::Configuration) -> Option<usize> {
        let free = self.ask(&self.at(from), &to);
        free.then(|| self.growth.add(to, from))
    }

    /// Takes the straight lines through these nodes as the path, if they have their certificates: in rare cases a quick
    /// proof of an edge has none. Returns whether they have. With a black box it takes them as a path that is not
    /// proven, if the black box calls them free.
    pub fn take(&mut self, nodes: &[usize]) -> bool {
        let corners: Vec<_> = nodes.iter().map(|node| self.growth.at(*node)).collect();
        match chart_lines(self.problem.checker(), &corners) {
            Ok(lines) => self.take_motions(lines),
            Err(_) => false,
        }
    }

    /// Takes the branch from a root to node number `node` as the path, as [`take`](Self::take).
    ///
    /// # Panics
    /// When there is no such node.
    pub fn take_branch(&mut self, node: usize) -> bool {
        self.take(&self.growth.branch(node))
    }
}
