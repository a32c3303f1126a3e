//! `RrtStar`, a tree that grows from the start and mends its ways.

use std::f64::consts::E;

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::num::ln;
use crate::planning::{Growth, LinePath, Nearest, Planner, Progress, Settings, sample_toward_goal};
use crate::robots::{ChartLine, Robot};

/// RRT* (Karaman and Frazzoli, 2011), with the k nearest: a new node is reached from that neighbour from which it is
/// nearest to the start, and its neighbours are reached from it where that is shorter. So the path tends to a shortest
/// one.
///
/// Once it has a path it goes on: every further iteration may shorten it. An iteration draws a sample and asks about at
/// most twice as many edges as there are neighbours, `e (1 + 1/d) ln n` of n nodes in d dimensions.
#[derive(Clone, Debug)]
pub struct RrtStar<R: Robot> {
    problem: Problem<R>,
    settings: Settings,
    growth: Growth<R::Configuration, ChartLine<R>>,
    tree: Nearest,
    /// The length of each node's way from the start.
    costs: Vec<f64>,
    children: Vec<Vec<usize>>,
    /// The nodes that solve the problem.
    ends: Vec<usize>,
    path: Option<LinePath<R>>,
    /// The length of the path, by the costs.
    cost: f64,
}

impl<R: Robot<Configuration: Chart>> RrtStar<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = Settings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: Settings) -> Self {
        let tree = Nearest::new(settings.metric.clone());
        let (growth, costs, children, ends) = (Growth::new(), Vec::new(), Vec::new(), Vec::new());
        let start = problem.start().in_chart();
        let mut planner =
            RrtStar { problem, settings, growth, tree, costs, children, ends, path: None, cost: f64::INFINITY };
        planner.growth.add_root(start);
        planner.enlist(start, 0, 0.0);
        planner
    }

    /// Keeps what the planner needs to know of a new node.
    fn enlist(&mut self, q: R::Configuration, node: usize, cost: f64) {
        self.tree.add(&q, node);
        self.costs.push(cost);
        self.children.push(Vec::new());
        if self.problem.is_goal(&q) {
            self.ends.push(node);
        }
    }

    fn grow(&mut self) -> Option<()> {
        let sample = sample_toward_goal(&mut self.problem, self.settings.goal_bias);
        self.growth.count_sample();
        let near = self.tree.nearest(&sample)?;
        if near.distance == 0.0 {
            // the goal is a node already
            return None;
        }
        let q = self.settings.toward(&self.growth.at(near.number), &sample)?.in_chart();
        let dimensions = q.coordinates().len() as f64;
        let count = (E * (1.0 + 1.0 / dimensions) * ln((self.costs.len() + 1) as f64)).ceil() as usize;
        let neighbours = self.tree.nearest_few(&q, count);
        // the cheapest way to it that is free
        let mut ways: Vec<(f64, usize)> =
            neighbours.iter().map(|n| (self.costs[n.number] + n.distance, n.number)).collect();
        ways.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let checker = self.problem.checker();
        let &(cost, parent) =
            ways.iter().find(|(_, from)| self.growth.ask_edge(checker, &self.growth.at(*from), &q))?;
        let node = self.growth.add(q, parent);
        self.enlist(q, node, cost);
        self.children[parent].push(node);
        for neighbour in neighbours {
            let (other, shorter) = (neighbour.number, cost + neighbour.distance);
            if other != parent
                && shorter < self.costs[other]
                && self.growth.ask_edge(self.problem.checker(), &q, &self.growth.at(other))
            {
                self.rewire(other, node, shorter);
            }
        }
        Some(())
    }

    /// Reaches a node from another one, and shortens the ways to all that are reached from it.
    fn rewire(&mut self, node: usize, parent: usize, cost: f64) {
        if let Some(before) = self.growth.nodes()[node].parent {
            self.children[before].retain(|child| *child != node);
        }
        self.growth.set_parent(node, parent);
        self.children[parent].push(node);
        self.costs[node] = cost;
        let mut open = vec![node];
        while let Some(at) = open.pop() {
            for child in self.children[at].clone() {
                let length = self.settings.metric.distance(&self.growth.at(at), &self.growth.at(child));
                self.costs[child] = self.costs[at] + length;
                open.push(child);
            }
        }
    }

    /// Takes the shortest way to the goal where it is shorter than the path.
    fn improve(&mut self) {
        let cheaper = |best: usize, end: &usize| if self.costs[*end] < self.costs[best] { *end } else { best };
        let Some(&first) = self.ends.first() else { return };
        let end = self.ends.iter().fold(first, cheaper);
        if self.costs[end] < self.cost
            && let Some(path) = self.growth.certified(self.problem.checker(), &self.growth.branch(end))
        {
            self.cost = self.costs[end];
            self.path = Some(path);
        }
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for RrtStar<R> {
    fn name(&self) -> &'static str {
        "rrt-star"
    }

    fn problem(&self) -> &Problem<R> {
        &self.problem
    }

    fn step(&mut self) -> Progress {
        self.growth.begin_iteration();
        if self.grow().is_some() {
            self.improve();
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
