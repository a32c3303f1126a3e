//! `RrtConnect`, two trees that grow toward each other.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::planning::{Nearest, Planner, SamplingSettings, Search};
use crate::robots::Robot;

/// What the next iteration does.
#[derive(Clone, Copy, Debug)]
enum ConnectPhase {
    /// Draws a sample and extends the tree toward it.
    Extend,
    /// Grows the other tree toward this node, from its node nearest to it or from the node it reached last.
    Connect { to: usize, from: Option<usize> },
}

/// RRT-Connect (Kuffner and LaValle, 2000): a tree from the start and a tree from the goal. One takes a step toward a
/// sample, the other grows toward the new node until it meets it or is stopped; then they change places.
///
/// An iteration is one step of either tree and asks about at most two edges. The edges of the goal's tree are asked
/// about in the direction in which the path goes along them.
#[derive(Clone, Debug)]
pub struct RrtConnect<R: Robot> {
    search: Search<R>,
    settings: SamplingSettings,
    trees: [Nearest; 2],
    /// The tree that extends: 0 is the start's.
    extending: usize,
    phase: ConnectPhase,
}

impl<R: Robot<Configuration: Chart>> RrtConnect<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = SamplingSettings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: SamplingSettings) -> Self {
        let ends = [problem.start(), problem.goal()];
        let mut search = Search::new(problem);
        let trees = ends.map(|root| {
            let mut tree = Nearest::new(settings.metric.clone());
            tree.add(&root, search.growth.add_root(root.in_chart()));
            tree
        });
        // the first thing to try is the straight line
        let phase = ConnectPhase::Connect { to: 1, from: None };
        RrtConnect { search, settings, trees, extending: 1, phase }
    }

    /// Takes a step in a tree from a node toward a configuration; `None` if it is not free. The step may be the whole
    /// way; it is where `far` allows it.
    fn grow(&mut self, tree: usize, from: usize, to: &R::Configuration, far: bool) -> Option<usize> {
        let start = self.search.at(from);
        let end = if far { *to } else { self.settings.toward(&start, to)? };
        let (a, b) = if tree == 0 { (start, end) } else { (end, start) };
        if !self.search.ask(&a, &b) {
            return None;
        }
        let node = self.search.growth.add(end, from);
        self.trees[tree].add(&end, node);
        Some(node)
    }

    fn extend(&mut self) {
        let sample = self.search.problem.sample();
        self.search.growth.count_sample();
        let near = self.trees[self.extending].nearest(&sample).map(|near| near.number);
        match near.and_then(|near| self.grow(self.extending, near, &sample, false)) {
            Some(to) => self.phase = ConnectPhase::Connect { to, from: None },
            None => self.extending = 1 - self.extending,
        }
    }

    fn connect(&mut self, to: usize, from: Option<usize>) {
        let (other, target) = (1 - self.extending, self.search.at(to));
        let from = from.or_else(|| self.trees[other].nearest(&target).map(|near| near.number));
        let Some(from) = from else { return };
        // the whole way first: a proof of a long edge costs little more than that of a short one
        if let Some(met) = self.grow(other, from, &target, true) {
            self.search.take(&self.through(to, met));
            self.swap();
            return;
        }
        let is_step = self.settings.metric.distance(&self.search.at(from), &target) <= self.settings.step;
        match if is_step { None } else { self.grow(other, from, &target, false) } {
            Some(next) => self.phase = ConnectPhase::Connect { to, from: Some(next) },
            None => self.swap(),
        }
    }

    fn swap(&mut self) {
        self.extending = 1 - self.extending;
        self.phase = ConnectPhase::Extend;
    }

    /// The nodes of the path through two nodes at the same place, one in each tree.
    fn through(&self, extended: usize, met: usize) -> Vec<usize> {
        let (of_start, of_goal) = if self.extending == 0 { (extended, met) } else { (met, extended) };
        let mut nodes = self.search.growth.branch(of_start);
        nodes.extend(self.search.growth.branch(of_goal).into_iter().rev().skip(1));
        nodes
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for RrtConnect<R> {
    fn name(&self) -> &'static str {
        "rrt-connect"
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        match self.phase {
            ConnectPhase::Extend => self.extend(),
            ConnectPhase::Connect { to, from } => self.connect(to, from),
        }
    }
}
