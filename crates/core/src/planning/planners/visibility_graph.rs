//! `VisibilityGraph`, for a disc: the corners of the grown obstacles that see one another.

use std::f64::consts::TAU;

use super::disc::{moved, position, radius_of};
use super::frontier::Frontier;
use crate::collision::{Problem, Scene};
use crate::configuration::{Chart, Configuration};
use crate::geometry::{Placed, Point2, Vector2};
use crate::num::{cos, sin_cos, sqrt};
use crate::planning::{MARGIN, NoPath, Planner, Search};
use crate::robots::Robot;

/// The number of directions about a vertex in which the grown obstacle has corners. A path about a corner is longer
/// than the arc by at most two per cent.
const DIRECTIONS: u32 = 16;

/// The visibility graph (Lozano-Perez and Wesley, 1979) of a robot that is a disc, searched by A*.
///
/// Every obstacle is grown by the radius: about each vertex stands a polygon of sixteen corners that circumscribes the
/// rounded corner and leaves a clearance of 1 mm. Two corners see one another where the edge between them is proven
/// free. The edges are asked about when the search comes to them. Headings turn on the way to the goal.
///
/// An iteration expands one corner and asks about at most as many edges as there are corners. A robot that is not a
/// disc ends it with [`NoPath::Unsuited`]. [`NoPath::NoneInGraph`] is no proof where the way is hardly wider than the
/// robot: by less than 2 mm and four per cent of its radius.
#[derive(Clone, Debug)]
pub struct VisibilityGraph<R: Robot> {
    search: Search<R>,
    /// The corners, after the goal and before the start; with the node of each that was reached.
    corners: Vec<(R::Configuration, Option<usize>)>,
    /// The corner of each node.
    of_node: Vec<usize>,
    frontier: Frontier,
}

impl<R: Robot<Configuration: Chart>> VisibilityGraph<R> {
    /// The planner, with the corners of all obstacles.
    pub fn new(problem: Problem<R>) -> Self {
        let (start, goal) = (problem.start().in_chart(), problem.goal().in_chart());
        let radius = radius_of(&problem.checker().robot().footprint(&start));
        let at = |p: Point2| moved(&start, p - position(&start));
        let mut corners = vec![goal];
        if let Some(radius) = radius {
            let grown = corners_of(problem.checker().scene(), radius);
            corners.extend(grown.into_iter().filter_map(at).filter(|q| problem.checker().is_free(q)));
        }
        corners.push(start);
        let mut search = Search::from_start(problem);
        search.end = radius.is_none().then_some(NoPath::Unsuited("a visibility graph is for robots that are discs"));
        let corners: Vec<_> = corners.into_iter().map(|q| (q, None)).collect();
        let mut planner = VisibilityGraph { search, corners, of_node: Vec::new(), frontier: Frontier::default() };
        planner.enlist(0, planner.corners.len() - 1, 0.0);
        planner
    }

    fn enlist(&mut self, node: usize, corner: usize, cost: f64) {
        self.corners[corner].1 = Some(node);
        self.of_node.push(corner);
        self.frontier.add(cost, apart(&self.search.at(node), &self.search.problem.goal()));
    }

    fn expand(&mut self, node: usize) {
        let (from, goal) = (self.search.at(node), self.search.problem.goal());
        if self.of_node[node] == 0 {
            self.search.take_branch(node);
            return;
        }
        for corner in 0..self.corners.len() {
            let (to, known) = self.corners[corner];
            let cost = self.frontier.cost(node) + apart(&from, &to);
            if !self.frontier.is_of_use(known, cost) || !self.search.ask(&from, &to) {
                continue;
            }
            match known {
                Some(known) => {
                    self.search.growth.set_parent(known, node);
                    self.frontier.improve(known, cost, apart(&to, &goal));
                }
                None => {
                    let reached = self.search.growth.add(to, node);
                    self.enlist(reached, corner, cost);
                }
            }
        }
    }
}

/// The distance of two positions, metres.
fn apart<C: Configuration>(a: &C, b: &C) -> f64 {
    let (a, b) = (a.coordinates(), b.coordinates());
    sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]))
}

/// The corners of every obstacle grown by a radius, in file order.
fn corners_of(scene: &Scene, radius: f64) -> Vec<Point2> {
    scene.pieces().flat_map(|(_, piece)| around(piece, radius)).collect()
}

/// The corners about each vertex of a placed shape, in the directions that lead outward.
fn around(piece: &Placed, radius: f64) -> Vec<Point2> {
    let core = piece.core();
    let part = TAU / f64::from(DIRECTIONS);
    let reach = (piece.radius() + radius + MARGIN) / cos(0.5 * part);
    let mut corners = Vec::new();
    for &vertex in core {
        for k in 0..DIRECTIONS {
            let (sin, cos_k) = sin_cos(part * f64::from(k));
            let direction = Vector2::new(cos_k, sin);
            // at most one direction beyond those in which no other vertex lies farther out
            let is_outward = core.iter().all(|other| {
                let side = other - vertex;
                direction.dot(&side) <= sqrt(side.dot(&side)) * sin_cos(part).0
            });
            if is_outward {
                corners.push(vertex + direction * reach);
            }
        }
    }
    corners
}

impl<R: Robot<Configuration: Chart>> Planner<R> for VisibilityGraph<R> {
    fn name(&self) -> &'static str {
        "visibility-graph"
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
            None => self.search.end = Some(NoPath::NoneInGraph { nodes: self.corners.len() }),
        }
    }
}
