//! `GridSearch`: A* and Dijkstra's algorithm on a grid of configurations.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::frontier::Frontier;
use crate::collision::Problem;
use crate::configuration::{Chart, Configuration, Coordinates};
use crate::planning::{Metric, NoPath, Planner, SamplingSettings, Search};
use crate::robots::Robot;
use crate::short_list::ShortList;

/// The number of steps of the grid to a step of the sampling planners.
const FINER: f64 = 4.0;

/// A place on the grid: the number of steps from the start along each coordinate, angles from 0 to a turn.
type GridIndex = ShortList<i32, 4>;

/// Along a coordinate of the grid.
#[derive(Clone, Copy, Debug)]
struct GridAxis {
    /// The length of a step, metres or radians.
    step: f64,
    /// The number of steps of a whole turn; `None` for a length.
    turn: Option<i32>,
    /// The range of a length.
    range: [f64; 2],
}

/// A best-first search of a grid that is laid through the start: A* (Hart, Nilsson and Raphael, 1968), whose heuristic
/// is the distance to the goal by the metric, or Dijkstra's algorithm (1959), which has none.
///
/// A place is joined to its neighbours along the coordinates and diagonally, and to the goal where that is at most a
/// diagonal away. Positions lie within the scene's bounds and angles wrap, so the grid is finite, and the search ends
/// with [`NoPath::NoneInGraph`] where it holds no path. That depends on the grid's step: a finer one may hold a path.
///
/// An iteration expands one place and asks about at most `3^d` edges in d dimensions, each when it would shorten a way.
#[derive(Clone, Debug)]
pub struct GridSearch<R: Robot> {
    search: Search<R>,
    metric: Metric,
    has_heuristic: bool,
    axes: ShortList<GridAxis, 4>,
    /// The nodes of the places reached.
    nodes: BTreeMap<[i32; 4], usize>,
    /// The place of each node; `None` for the goal beside the grid.
    places: Vec<Option<GridIndex>>,
    /// The node of the goal beside the grid.
    goal: Option<usize>,
    frontier: Frontier,
}

impl<R: Robot<Configuration: Chart>> GridSearch<R> {
    /// A*, on a grid whose step is a quarter of the sampling planners' ([`SamplingSettings::of`]).
    pub fn a_star(problem: Problem<R>) -> Self {
        let step = SamplingSettings::of(&problem).step / FINER;
        Self::of(problem, step, true)
    }

    /// Dijkstra's algorithm, on a grid whose step is a quarter of the sampling planners' ([`SamplingSettings::of`]).
    pub fn dijkstra(problem: Problem<R>) -> Self {
        let step = SamplingSettings::of(&problem).step / FINER;
        Self::of(problem, step, false)
    }

    /// A search of the grid with this step, metres and radians; for angles the next lower part of a turn. The goal
    /// attracts it if `has_heuristic`.
    ///
    /// A step that is not above 0 gives a search that ends with [`NoPath::Unsuited`].
    pub fn of(problem: Problem<R>, step: f64, has_heuristic: bool) -> Self {
        let (start, bounds) = (problem.start().in_chart(), problem.checker().scene().bounds());
        let axis = |i: usize| {
            if start.is_angle(i) {
                let turn = (TAU / step).ceil().clamp(1.0, 1e6);
                return GridAxis { step: TAU / turn, turn: Some(turn as i32), range: [0.0; 2] };
            }
            let range = if i == 0 { [bounds.min.x, bounds.max.x] } else { [bounds.min.y, bounds.max.y] };
            GridAxis { step, turn: None, range }
        };
        let dimensions = start.coordinates().len();
        let axes: ShortList<GridAxis, 4> = (0..dimensions).map(axis).collect();
        let fits = dimensions <= 4 && step > 0.0 && step.is_finite();
        let reason = "a grid has at most four coordinates and a step above 0";
        let mut search = Search::new(problem);
        search.end = (!fits).then_some(NoPath::Unsuited(reason));
        let mut planner = GridSearch {
            metric: Metric::unit(&start),
            search,
            has_heuristic,
            axes,
            nodes: BTreeMap::new(),
            places: Vec::new(),
            goal: None,
            frontier: Frontier::default(),
        };
        if fits {
            let root = planner.search.growth.add_root(start);
            planner.enlist(root, Some((0..dimensions).map(|_| 0).collect()), 0.0);
        }
        planner
    }

    fn enlist(&mut self, node: usize, place: Option<GridIndex>, cost: f64) {
        match &place {
            Some(place) => _ = self.nodes.insert(key(place), node),
            None => self.goal = Some(node),
        }
        self.places.push(place);
        self.frontier.add(cost, self.rest(node));
    }

    /// The least that the way from a node to the goal costs, as far as the search uses it.
    fn rest(&self, node: usize) -> f64 {
        if self.has_heuristic { self.metric.distance(&self.search.at(node), &self.search.problem.goal()) } else { 0.0 }
    }

    /// The configuration at a place; `None` outside the scene's bounds.
    fn at(&self, place: &GridIndex) -> Option<R::Configuration> {
        let tangent: Coordinates = self.axes.iter().zip(place).map(|(axis, k)| axis.step * f64::from(*k)).collect();
        let q = self.search.problem.start().in_chart().exp(&tangent)?;
        let holds = |(axis, c): (&GridAxis, &f64)| axis.turn.is_some() || (*c >= axis.range[0] && *c <= axis.range[1]);
        self.axes.iter().zip(&q.coordinates()).all(holds).then_some(q)
    }

    /// The places beside a place, diagonals too.
    fn beside(&self, place: &GridIndex) -> Vec<GridIndex> {
        let count = 3_usize.pow(place.len() as u32);
        let neighbour = |mut number: usize| -> GridIndex {
            let along = |(k, axis): (&i32, &GridAxis)| {
                let moved = k + (number % 3) as i32 - 1;
                number /= 3;
                axis.turn.map_or(moved, |turn| moved.rem_euclid(turn))
            };
            place.iter().zip(&self.axes).map(along).collect()
        };
        (0..count).map(neighbour).filter(|other| key(other) != key(place)).collect()
    }

    /// Reaches a place from a node, or the goal where there is no place, if that is a shorter way and free.
    fn relax(&mut self, from: usize, place: Option<GridIndex>, q: R::Configuration, known: Option<usize>) {
        let cost = self.frontier.cost(from) + self.metric.distance(&self.search.at(from), &q);
        if !self.frontier.is_of_use(known, cost) || !self.search.ask(&self.search.at(from), &q) {
            return;
        }
        if let Some(node) = known {
            self.search.growth.set_parent(node, from);
            self.frontier.improve(node, cost, self.rest(node));
        } else {
            let node = self.search.growth.add(q, from);
            self.enlist(node, place, cost);
        }
    }

    fn expand(&mut self, node: usize) {
        if self.search.problem.is_goal(&self.search.at(node)) {
            self.search.take_branch(node);
            return;
        }
        let Some(place) = self.places[node].clone() else { return };
        let goal = self.search.problem.goal().in_chart();
        let diagonal = crate::num::sqrt(self.axes.iter().map(|axis| axis.step * axis.step).sum());
        if self.metric.distance(&self.search.at(node), &goal) <= diagonal {
            self.relax(node, None, goal, self.goal);
        }
        for other in self.beside(&place) {
            if let Some(q) = self.at(&other) {
                let known = self.nodes.get(&key(&other)).copied();
                self.relax(node, Some(other), q, known);
            }
        }
    }
}

/// A place as a key of a map.
fn key(place: &GridIndex) -> [i32; 4] {
    let mut key = [0; 4];
    for (k, at) in key.iter_mut().zip(place) {
        *k = *at;
    }
    key
}

impl<R: Robot<Configuration: Chart>> Planner<R> for GridSearch<R> {
    fn name(&self) -> &'static str {
        if self.has_heuristic { "a-star" } else { "dijkstra" }
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        match self.frontier.close_next() {
            Some(node) => self.expand(node),
            None => self.search.end = Some(NoPath::NoneInGraph { nodes: self.search.growth.nodes().len() }),
        }
    }
}
