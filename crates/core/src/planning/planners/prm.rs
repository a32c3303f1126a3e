//! `Prm`, a roadmap of samples.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration};
use crate::planning::{Metric, Nearest, Neighbour, Planner, Progress, Queue, Search};
use crate::robots::Robot;

/// The number of neighbours that a new node is joined to, where the edges are free.
const NEIGHBOURS: usize = 10;

/// A probabilistic roadmap (Kavraki, Svestka, Latombe and Overmars, 1996) that is built until it joins the start to the
/// goal: each free sample is joined to its nearest neighbours. The path is the roadmap's shortest. Stepped on, the
/// roadmap goes on to grow, and its shortest way is taken where it is shorter than the path.
///
/// An iteration draws a sample and asks about at most ten edges. The start and the goal are nodes 0 and 1. Once there
/// is a path a shorter one is looked for whenever the roadmap has a hundredth more nodes, and at least one.
#[derive(Clone, Debug)]
pub struct Prm<R: Robot> {
    search: Search<R>,
    near: Nearest,
    /// The edges of each node, with their lengths.
    roads: Vec<Vec<Neighbour>>,
    /// A node of the same component with a lower number, or itself.
    components: Vec<usize>,
    /// The length of the path, by the metric.
    cost: f64,
    /// The number of nodes when the shortest way was last looked for.
    searched: usize,
}

impl<R: Robot<Configuration: Chart>> Prm<R> {
    /// The planner by the metric in which a metre counts as much as a radian.
    pub fn new(problem: Problem<R>) -> Self {
        let metric = Metric::unit(&problem.start());
        Self::with_metric(problem, metric)
    }

    /// The planner by this metric.
    pub fn with_metric(problem: Problem<R>, metric: Metric) -> Self {
        let near = Nearest::new(metric);
        let ends = [problem.start(), problem.goal()].map(|q| q.in_chart());
        let (search, cost) = (Search::new(problem), f64::INFINITY);
        let mut planner = Prm { search, near, roads: Vec::new(), components: Vec::new(), cost, searched: 0 };
        for end in ends {
            planner.place(end);
        }
        planner
    }

    /// Adds a node and joins it to its neighbours.
    fn place(&mut self, q: R::Configuration) {
        let node = self.search.growth.add_root(q);
        let neighbours = self.near.nearest_few(&q, NEIGHBOURS);
        self.near.add(&q, node);
        self.roads.push(Vec::new());
        self.components.push(node);
        for Neighbour { number, distance } in neighbours {
            if self.search.ask(&self.search.at(number), &q) {
                self.search.growth.link(number, node);
                self.roads[node].push(Neighbour { number, distance });
                self.roads[number].push(Neighbour { number: node, distance });
                let (a, b) = (self.component(number), self.component(node));
                self.components[a.max(b)] = a.min(b);
            }
        }
    }

    fn component(&self, mut node: usize) -> usize {
        while self.components[node] != node {
            node = self.components[node];
        }
        node
    }

    /// The nodes of the roadmap's shortest way from the start to the goal (Dijkstra, 1959), and its length.
    fn shortest(&self) -> (Vec<usize>, f64) {
        let mut costs = vec![f64::INFINITY; self.roads.len()];
        let mut before = vec![0; self.roads.len()];
        let mut open = Queue::new();
        costs[0] = 0.0;
        open.push(0.0, 0);
        while let Some(node) = open.pop().filter(|node| *node != 1) {
            for road in &self.roads[node] {
                let cost = costs[node] + road.distance;
                if cost < costs[road.number] {
                    (costs[road.number], before[road.number]) = (cost, node);
                    open.push(cost, road.number);
                }
            }
        }
        let mut nodes = vec![1];
        while nodes[nodes.len() - 1] != 0 {
            nodes.push(before[nodes[nodes.len() - 1]]);
        }
        nodes.reverse();
        (nodes, costs[1])
    }

    /// Takes the roadmap's shortest way where it is shorter than the path.
    fn improve(&mut self) {
        self.searched = self.roads.len();
        let (nodes, cost) = self.shortest();
        if cost < self.cost && self.search.take(&nodes) {
            self.cost = cost;
        }
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for Prm<R> {
    fn name(&self) -> &'static str {
        "prm"
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        // at first the straight line may have joined them
        if self.component(0) != self.component(1) || self.search.growth.effort().iterations > 1 {
            let sample = self.search.problem.sample();
            self.search.growth.count_sample();
            if self.search.problem.checker().is_free(&sample) {
                self.place(sample);
            }
        }
        let grown = self.roads.len() - self.searched;
        let is_due = self.cost == f64::INFINITY || grown >= (self.searched / 100).max(1);
        if is_due && self.component(0) == self.component(1) {
            self.improve();
        }
    }

    fn step(&mut self) -> Progress {
        self.search.growth.begin_iteration();
        self.advance();
        self.search.progress()
    }
}
