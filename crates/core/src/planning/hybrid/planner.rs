//! `HybridAStar`, a search over what a car can drive.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::f64::consts::TAU;
use std::sync::Arc;

use super::remaining::Remaining;
use super::shots::shots;
use super::{CarMove, HybridSettings};
use crate::collision::Problem;
use crate::configuration::HitchCfg;
use crate::num::{lesser, wrap};
use crate::planning::{NoPath, Planner, Progress, Search};
use crate::robots::{CHANNEL_UNITS, Hitch, HitchArc, Motion};

/// Hybrid A* (Dolgov, Thrun, Montemerlo and Diebel, 2008) for the car, with a trailer or without: A* over what the car
/// drives in a few ticks under each of a few controls, one configuration kept for each cell of the space. From each
/// configuration that it expands it also tries to go straight to the goal: along Reeds and Shepp's curve, and with a
/// trailer backward onto the line on which it is to stand.
///
/// Its moves are held channels and whole ticks, so the simulator can drive its paths bit for bit. A path ends in
/// the problem's region, or where it has none, [near](super::NearGoal) its goal. An iteration expands one
/// configuration. No samples are drawn.
#[derive(Clone, Debug)]
pub struct HybridAStar {
    search: Search<Hitch, HitchArc>,
    settings: HybridSettings,
    /// The clearance that the ends of moves keep, metres.
    keep: f64,
    remaining: Remaining,
    /// How each node was reached; `None` for the start.
    reached: Vec<Arrival>,
    open: BinaryHeap<Reverse<(u64, usize)>>,
    /// The least cost at which each cell was reached.
    cells: BTreeMap<StateCell, f64>,
    closed: BTreeMap<StateCell, usize>,
}

/// The problem with the region of the settings about its goal.
fn near_its_goal(problem: Problem<Hitch>, settings: &HybridSettings) -> Problem<Hitch> {
    let region = Arc::new(settings.around(problem.goal()));
    problem.clone().try_with_region(region).unwrap_or(problem)
}

/// How a node was reached.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    by: Option<CarMove>,
    cost: f64,
    cell: StateCell,
}

/// A cell of the space: place, headings, and whether the car went back.
type StateCell = ([i32; 4], bool);

impl HybridAStar {
    /// The planner with its usual settings.
    pub fn new(problem: Problem<Hitch>) -> Self {
        Self::with_settings(problem, HybridSettings::default())
    }

    /// The planner with these settings.
    pub fn with_settings(problem: Problem<Hitch>, settings: HybridSettings) -> Self {
        let problem = if problem.region().is_some() { problem } else { near_its_goal(problem, &settings) };
        let remaining = Remaining::new(problem.checker(), &problem.goal().body);
        let ends = [problem.start(), problem.goal()].map(|q| 0.5 * problem.checker().distance(&q));
        let mut planner = HybridAStar {
            keep: ends.into_iter().fold(settings.keep, lesser),
            settings,
            remaining,
            reached: Vec::new(),
            open: BinaryHeap::new(),
            cells: BTreeMap::new(),
            closed: BTreeMap::new(),
            search: Search::of_motions(problem),
        };
        let start = planner.search.problem.start();
        planner.search.growth.add_root(start);
        let cell = planner.cell(&start, false);
        planner.cells.insert(cell, 0.0);
        planner.reached.push(Arrival { by: None, cost: 0.0, cell });
        planner.push(0);
        planner
    }

    /// The settings.
    pub fn settings(&self) -> &HybridSettings {
        &self.settings
    }

    /// The moves of the path, as the simulator can drive them; none while there is no path.
    pub fn moves(&self) -> Vec<CarMove> {
        let last = self.search.growth.nodes().len() - 1;
        if self.search.progress() != Progress::Solved {
            return Vec::new();
        }
        self.search.growth.branch(last).into_iter().filter_map(|node| self.reached[node].by).collect()
    }

    fn car(&self) -> &Hitch {
        self.search.problem.checker().robot()
    }

    fn cell(&self, q: &HitchCfg, back: bool) -> StateCell {
        let part = |x: f64, size: f64| (x / size).floor() as i32;
        let turn = TAU / f64::from(self.settings.headings.max(1));
        let of_circle =
            |angle: f64| part(wrap(angle) + 0.5 * turn, turn).rem_euclid(self.settings.headings.max(1) as i32);
        let place = |x: f64| part(x, self.settings.cell);
        let hitch = q.hitch_angle().map_or(0, of_circle);
        ([place(q.body.x), place(q.body.y), of_circle(q.body.theta), hitch], back)
    }

    /// Opens a node, by its cost and the estimate of what remains.
    fn push(&mut self, node: usize) {
        let estimate = self.reached[node].cost + self.settings.greed * self.remaining.at(&self.search.at(node).body);
        // the order of the bits of numbers that are not negative is theirs
        self.open.push(Reverse((estimate.to_bits(), node)));
    }

    /// What a move costs from a node, metres.
    fn cost(&self, node: usize, m: &CarMove, end: &HitchCfg) -> f64 {
        let settings = &self.settings;
        let length = m.length(self.car()).abs();
        let back = if m.speed < 0 { settings.back } else { 0.0 };
        let fold = end.hitch_angle().map_or(0.0, |angle| settings.fold * angle.abs());
        let before = self.reached[node].by;
        let reversal = if before.is_some_and(|b| (b.speed < 0) != (m.speed < 0)) { settings.reversal } else { 0.0 };
        length * (1.0 + back + fold) + reversal
    }

    /// Asks whether a move is free whose end keeps its clearance.
    fn ask(&mut self, arc: HitchArc) -> bool {
        self.search.problem.checker().distance(&arc.at(1.0)) >= self.keep
            && self.search.growth.ask(self.search.problem.checker(), arc)
    }

    /// Adds the end of a move that is proven free.
    fn add(&mut self, parent: usize, m: CarMove, end: HitchCfg, cost: f64, cell: StateCell) -> usize {
        self.reached.push(Arrival { by: Some(m), cost, cell });
        self.search.growth.add(end, parent)
    }

    /// Asks about every control from a node.
    fn expand(&mut self, node: usize) {
        let from = self.search.at(node);
        let full = CHANNEL_UNITS as i16;
        let sides: Vec<i16> = self.settings.steering.iter().flat_map(|s| [*s, -*s]).collect();
        for speed in [full, -full] {
            for steering in std::iter::once(0).chain(sides.iter().copied()) {
                let m = CarMove { speed, steering, ticks: self.settings.ticks };
                let Ok(arc) = m.drive(self.car(), &from) else { continue };
                let end = arc.at(1.0);
                if end.hitch_angle().is_some_and(|angle| angle.abs() > self.settings.most_fold) {
                    continue;
                }
                let cell = self.cell(&end, speed < 0);
                let cost = self.reached[node].cost + self.cost(node, &m, &end);
                if self.closed.contains_key(&cell) || self.cells.get(&cell).is_some_and(|least| *least <= cost) {
                    continue;
                }
                if self.ask(arc) {
                    self.cells.insert(cell, cost);
                    let added = self.add(node, m, end, cost, cell);
                    self.push(added);
                }
            }
        }
    }

    /// Goes straight to the goal from a node, if that is free. Returns the last node.
    fn shoot(&mut self, node: usize) -> Option<usize> {
        let from = self.search.at(node);
        for shot in shots(&self.search.problem, &from, &self.settings) {
            let (mut at, mut ends) = (from, Vec::new());
            let free = shot.moves.iter().all(|m| {
                let Ok(arc) = m.drive(self.search.problem.checker().robot(), &at) else { return false };
                at = arc.at(1.0);
                ends.push(at);
                self.ask(arc)
            });
            if free {
                let moves = shot.moves.iter().zip(ends);
                return Some(moves.fold(node, |node, (m, end)| {
                    let cell = self.cell(&end, m.speed < 0);
                    let cost = self.reached[node].cost + self.cost(node, m, &end);
                    self.add(node, *m, end, cost, cell)
                }));
            }
        }
        None
    }

    /// The motions that lead to a node.
    fn motions_to(&self, node: usize) -> Option<Vec<HitchArc>> {
        let branch = self.search.growth.branch(node);
        let motions: Vec<HitchArc> =
            branch.windows(2).map(|ends| self.motion(ends[0], ends[1])).collect::<Option<_>>()?;
        // where the start is near enough to the goal, the car stays
        let stays = CarMove { speed: 0, steering: 0, ticks: 1 };
        let stay = || Some(vec![stays.drive(self.car(), &self.search.at(node)).ok()?]);
        if motions.is_empty() { stay() } else { Some(motions) }
    }

    /// The next open node whose cell is not closed.
    fn next(&mut self) -> Option<usize> {
        while let Some(Reverse((_, node))) = self.open.pop() {
            if self.closed.insert(self.reached[node].cell, node).is_none() {
                return Some(node);
            }
        }
        None
    }
}

impl Planner<Hitch, HitchArc> for HybridAStar {
    fn name(&self) -> &'static str {
        "hybrid-a-star"
    }

    fn search(&self) -> &Search<Hitch, HitchArc> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<Hitch, HitchArc> {
        &mut self.search
    }

    fn advance(&mut self) {
        let Some(node) = self.next() else {
            self.search.end = Some(NoPath::NoneInGraph { nodes: self.search.growth.nodes().len() });
            return;
        };
        let is_goal = self.search.problem.is_goal(&self.search.at(node));
        let last = if is_goal { Some(node) } else { self.shoot(node) };
        let motions = last.and_then(|last| self.motions_to(last));
        if !motions.is_some_and(|motions| self.search.take_motions(motions)) {
            self.expand(node);
        }
    }

    fn motion(&self, from: usize, to: usize) -> Option<HitchArc> {
        let node = self.search.growth.nodes().get(to)?;
        let by = self.reached[to].by.filter(|_| node.parent == Some(from))?;
        by.drive(self.car(), &self.search.at(from)).ok()
    }
}
