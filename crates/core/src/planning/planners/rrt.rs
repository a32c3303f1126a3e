//! `Rrt`, a tree that grows from the start.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::planning::{Growth, LinePath, Nearest, Planner, Progress, Settings, sample_toward_goal};
use crate::robots::{ChartLine, Robot};

/// A rapidly-exploring random tree (LaValle, 1998): the node nearest to a sample takes a step toward it. Some samples
/// are the goal.
///
/// An iteration draws a sample and asks about at most two edges, the second from the new node to the goal.
#[derive(Clone, Debug)]
pub struct Rrt<R: Robot> {
    problem: Problem<R>,
    settings: Settings,
    growth: Growth<R::Configuration, ChartLine<R>>,
    tree: Nearest,
    path: Option<LinePath<R>>,
}

impl<R: Robot<Configuration: Chart>> Rrt<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = Settings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: Settings) -> Self {
        let (mut growth, mut tree) = (Growth::new(), Nearest::new(settings.metric.clone()));
        let start = problem.start().in_chart();
        tree.add(&start, growth.add_root(start));
        Rrt { problem, settings, growth, tree, path: None }
    }

    /// Grows toward a sample; the new node, if there is one.
    fn extend(&mut self) -> Option<usize> {
        let sample = sample_toward_goal(&mut self.problem, self.settings.goal_bias);
        self.growth.count_sample();
        let near = self.tree.nearest(&sample)?;
        let from = self.growth.at(near.number);
        let to = self.settings.toward(&from, &sample)?;
        self.grow(near.number, to)
    }

    fn grow(&mut self, from: usize, to: R::Configuration) -> Option<usize> {
        if !self.growth.ask_edge(self.problem.checker(), &self.growth.at(from), &to) {
            return None;
        }
        let node = self.growth.add(to, from);
        self.tree.add(&to, node);
        Some(node)
    }

    /// The node that solves the problem: the new one, or the goal one step from it.
    fn reach(&mut self, node: usize) -> Option<usize> {
        let (at, goal) = (self.growth.at(node), self.problem.goal().in_chart());
        if self.problem.is_goal(&at) {
            return Some(node);
        }
        let is_near = self.settings.metric.distance(&at, &goal) <= self.settings.step;
        if is_near { self.grow(node, goal) } else { None }
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for Rrt<R> {
    fn name(&self) -> &'static str {
        "rrt"
    }

    fn problem(&self) -> &Problem<R> {
        &self.problem
    }

    fn step(&mut self) -> Progress {
        if self.path.is_none() {
            self.growth.begin_iteration();
            let end = self.extend().and_then(|node| self.reach(node));
            self.path = end.and_then(|end| self.growth.certified(self.problem.checker(), &self.growth.branch(end)));
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
