//! `RrtConnect`, two trees that grow toward each other.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::planning::{Growth, LinePath, Nearest, Planner, Progress, Settings};
use crate::robots::{ChartLine, Robot};

/// What the next iteration does.
#[derive(Clone, Copy, Debug)]
enum Phase {
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
    problem: Problem<R>,
    settings: Settings,
    growth: Growth<R::Configuration, ChartLine<R>>,
    trees: [Nearest; 2],
    /// The tree that extends: 0 is the start's.
    extending: usize,
    phase: Phase,
    path: Option<LinePath<R>>,
}

impl<R: Robot<Configuration: Chart>> RrtConnect<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = Settings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: Settings) -> Self {
        let mut growth = Growth::new();
        let trees = [problem.start(), problem.goal()].map(|root| {
            let mut tree = Nearest::new(settings.metric.clone());
            tree.add(&root, growth.add_root(root.in_chart()));
            tree
        });
        // the first thing to try is the straight line
        let phase = Phase::Connect { to: 1, from: None };
        RrtConnect { problem, settings, growth, trees, extending: 1, phase, path: None }
    }

    /// Takes a step in a tree from a node toward a configuration; `None` if it is not free. The step may be the whole
    /// way; it is where `far` allows it.
    fn grow(&mut self, tree: usize, from: usize, to: &R::Configuration, far: bool) -> Option<usize> {
        let start = self.growth.at(from);
        let end = if far { *to } else { self.settings.toward(&start, to)? };
        let (a, b) = if tree == 0 { (start, end) } else { (end, start) };
        if !self.growth.ask_edge(self.problem.checker(), &a, &b) {
            return None;
        }
        let node = self.growth.add(end, from);
        self.trees[tree].add(&end, node);
        Some(node)
    }

    fn extend(&mut self) {
        let sample = self.problem.sample();
        self.growth.count_sample();
        let near = self.trees[self.extending].nearest(&sample).map(|near| near.number);
        match near.and_then(|near| self.grow(self.extending, near, &sample, false)) {
            Some(to) => self.phase = Phase::Connect { to, from: None },
            None => self.extending = 1 - self.extending,
        }
    }

    fn connect(&mut self, to: usize, from: Option<usize>) {
        let (other, target) = (1 - self.extending, self.growth.at(to));
        let from = from.or_else(|| self.trees[other].nearest(&target).map(|near| near.number));
        let Some(from) = from else { return };
        // the whole way first: a proof of a long edge costs little more than that of a short one
        if let Some(met) = self.grow(other, from, &target, true) {
            self.path = self.through(to, met);
            self.swap();
            return;
        }
        let is_step = self.settings.metric.distance(&self.growth.at(from), &target) <= self.settings.step;
        match if is_step { None } else { self.grow(other, from, &target, false) } {
            Some(next) => self.phase = Phase::Connect { to, from: Some(next) },
            None => self.swap(),
        }
    }

    fn swap(&mut self) {
        self.extending = 1 - self.extending;
        self.phase = Phase::Extend;
    }

    /// The path through two nodes at the same place, one in each tree.
    fn through(&self, extended: usize, met: usize) -> Option<LinePath<R>> {
        let (of_start, of_goal) = if self.extending == 0 { (extended, met) } else { (met, extended) };
        let mut nodes = self.growth.branch(of_start);
        nodes.extend(self.growth.branch(of_goal).into_iter().rev().skip(1));
        self.growth.certified(self.problem.checker(), &nodes)
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for RrtConnect<R> {
    fn name(&self) -> &'static str {
        "rrt-connect"
    }

    fn problem(&self) -> &Problem<R> {
        &self.problem
    }

    fn step(&mut self) -> Progress {
        if self.path.is_none() {
            self.growth.begin_iteration();
            match self.phase {
                Phase::Extend => self.extend(),
                Phase::Connect { to, from } => self.connect(to, from),
            }
        }
        if self.path.is_some() { Progress::Solved } else { Progress::Growing }
    }

    fn growth(&self) -> &Growth<R::Configuration, ChartLine<R>> {
        &self.growth
    }

    fn motion(&self, from: usize, to: usize) -> Option<ChartLine<R>> {
        self.growth.line(self.problem.checker().robot(), from, to)
    }

    fn path(&self) -> Option<&LinePath<R>> {
        self.path.as_ref()
    }
}
