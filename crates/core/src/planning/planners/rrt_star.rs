//! `RrtStar`, a tree that grows from the start and mends its ways.

use std::f64::consts::E;

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::num::ln;
use crate::planning::{Nearest, Planner, Progress, SamplingSettings, Search, sample_shorter, sample_toward_goal};
use crate::robots::Robot;

/// RRT* (Karaman and Frazzoli, 2011), with the k nearest: a new node is reached from that neighbour from which it is
/// nearest to the start, and its neighbours are reached from it where that is shorter. So the path tends to a shortest
/// one.
///
/// Once it has a path it goes on: every further iteration may shorten it. An iteration draws a sample and asks about at
/// most twice as many edges as there are neighbours, `e (1 + 1/d) ln n` of n nodes in d dimensions.
///
/// [`informed`](Self::informed) it draws, once it has a path, only samples through which a shorter one may lead
/// (Gammell, Srinivasa and Barfoot, 2014): those whose distances to start and goal add up to less than its length.
#[derive(Clone, Debug)]
pub struct RrtStar<R: Robot> {
    search: Search<R>,
    settings: SamplingSettings,
    is_informed: bool,
    tree: Nearest,
    /// The length of each node's way from the start.
    costs: Vec<f64>,
    children: Vec<Vec<usize>>,
    /// The nodes that solve the problem.
    ends: Vec<usize>,
    /// The length of the path, by the costs.
    cost: f64,
}

impl<R: Robot<Configuration: Chart>> RrtStar<R> {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<R>) -> Self {
        let settings = SamplingSettings::of(&problem);
        Self::with_settings(problem, settings)
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<R>, settings: SamplingSettings) -> Self {
        let tree = Nearest::new(settings.metric.clone());
        let search = Search::from_start(problem);
        let (start, costs, children, ends) = (search.at(0), Vec::new(), Vec::new(), Vec::new());
        let (is_informed, cost) = (false, f64::INFINITY);
        let mut planner = RrtStar { search, settings, is_informed, tree, costs, children, ends, cost };
        planner.enlist(start, 0, 0.0);
        planner
    }

    /// Informed RRT* with its usual settings. Where a region around the goal solves the problem it draws from all of
    /// the space, as the planner does that is not informed.
    pub fn informed(problem: Problem<R>) -> Self {
        RrtStar { is_informed: true, ..Self::new(problem) }
    }

    /// The next sample; `None` where none may shorten the path.
    fn sample(&mut self) -> Option<R::Configuration> {
        let problem = &mut self.search.problem;
        self.search.growth.count_sample();
        if self.is_informed && problem.region().is_none() && self.cost < f64::INFINITY {
            return sample_shorter(problem, &self.settings.metric, self.cost);
        }
        Some(sample_toward_goal(problem, self.settings.goal_bias))
    }

    /// Keeps what the planner needs to know of a new node.
    fn enlist(&mut self, q: R::Configuration, node: usize, cost: f64) {
        self.tree.add(&q, node);
        self.costs.push(cost);
        self.children.push(Vec::new());
        if self.search.problem.is_goal(&q) {
            self.ends.push(node);
        }
    }

    fn grow(&mut self) -> Option<()> {
        let sample = self.sample()?;
        let near = self.tree.nearest(&sample)?;
        if near.distance == 0.0 {
            // the goal is a node already
            return None;
        }
        let q = self.settings.toward(&self.search.at(near.number), &sample)?.in_chart();
        let dimensions = q.coordinates().len() as f64;
        let count = (E * (1.0 + 1.0 / dimensions) * ln((self.costs.len() + 1) as f64)).ceil() as usize;
        let neighbours = self.tree.nearest_few(&q, count);
        // the cheapest way to it that is free
        let mut ways: Vec<(f64, usize)> =
            neighbours.iter().map(|n| (self.costs[n.number] + n.distance, n.number)).collect();
        ways.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let free = ways.into_iter().find_map(|(cost, from)| Some((cost, from, self.search.reach(from, q)?)));
        let (cost, parent, node) = free?;
        self.enlist(q, node, cost);
        self.children[parent].push(node);
        for neighbour in neighbours {
            let (other, shorter) = (neighbour.number, cost + neighbour.distance);
            if other != parent && shorter < self.costs[other] && self.search.ask(&q, &self.search.at(other)) {
                self.rewire(other, node, shorter);
            }
        }
        Some(())
    }

    /// Reaches a node from another one, and shortens the ways to all that are reached from it.
    fn rewire(&mut self, node: usize, parent: usize, cost: f64) {
        if let Some(before) = self.search.growth.nodes()[node].parent {
            self.children[before].retain(|child| *child != node);
        }
        self.search.growth.set_parent(node, parent);
        self.children[parent].push(node);
        self.costs[node] = cost;
        let mut open = vec![node];
        while let Some(at) = open.pop() {
            for child in self.children[at].clone() {
                let length = self.settings.metric.distance(&self.search.at(at), &self.search.at(child));
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
        if self.costs[end] < self.cost && self.search.take_branch(end) {
            self.cost = self.costs[end];
        }
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for RrtStar<R> {
    fn name(&self) -> &'static str {
        if self.is_informed { "informed-rrt-star" } else { "rrt-star" }
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        if self.grow().is_some() {
            self.improve();
        }
    }

    fn step(&mut self) -> Progress {
        self.search.growth.begin_iteration();
        self.advance();
        self.search.progress()
    }
}
