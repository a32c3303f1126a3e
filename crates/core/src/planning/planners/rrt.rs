//! `Rrt`, a tree that grows from the start.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::planning::{Nearest, Planner, SamplingSettings, Search, sample_toward_goal};
use crate::robots::Robot;

/// A rapidly-exploring random tree (LaValle, 1998): the node nearest to a sample takes a step toward it. Some samples
/// are the goal.
///
/// An iteration draws a sample and asks about at most two edges, the second from the new node to the goal. A start that
/// is the goal, or lies in its region, is the whole path.
#[derive(Clone, Debug)]
pub struct Rrt<R: Robot> {
    search: Search<R>,
    settings: SamplingSettings,
    tree: Nearest,
}

impl<R: Robot<Configuration: Chart>> Rrt<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = SamplingSettings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: SamplingSettings) -> Self {
        let (search, mut tree) = (Search::from_start(problem), Nearest::new(settings.metric.clone()));
        tree.add(&search.at(0), 0);
        Rrt { search, settings, tree }
    }

    /// Grows toward a sample; the new node, if there is one.
    fn extend(&mut self) -> Option<usize> {
        let sample = sample_toward_goal(&mut self.search.problem, self.settings.goal_bias);
        self.search.growth.count_sample();
        let near = self.tree.nearest(&sample)?;
        let from = self.search.at(near.number);
        let to = self.settings.toward(&from, &sample)?;
        self.grow(near.number, to)
    }

    fn grow(&mut self, from: usize, to: R::Configuration) -> Option<usize> {
        let node = self.search.reach(from, to)?;
        self.tree.add(&to, node);
        Some(node)
    }

    /// The node that solves the problem: the new one, or the goal one step from it.
    fn reach(&mut self, node: usize) -> Option<usize> {
        let (at, goal) = (self.search.at(node), self.search.problem.goal().in_chart());
        if self.search.problem.is_goal(&at) {
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

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        if self.search.problem.is_goal(&self.search.at(0)) && self.search.take_branch(0) {
            return;
        }
        if let Some(end) = self.extend().and_then(|node| self.reach(node)) {
            self.search.take_branch(end);
        }
    }
}
