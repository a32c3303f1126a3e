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
    /// The node at which the path ends, once there is one; it need not be the last one added.
    end: usize,
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
            end: 0,
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
        if self.search.progress() != Progress::Solved {
            return Vec::new();
        }
        self.search.growth.branch(self.end).into_iter().filter_map(|node| self.reached[node].by).collect()
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
        let end = if is_goal { Some(node) } else { self.shoot(node) };
        let motions = end.and_then(|end| self.motions_to(end));
        if motions.is_some_and(|motions| self.search.take_motions(motions)) {
            self.end = end.unwrap_or(node);
        } else {
            self.expand(node);
        }
    }

    fn motion(&self, from: usize, to: usize) -> Option<HitchArc> {
        let node = self.search.growth.nodes().get(to)?;
        let by = self.reached[to].by.filter(|_| node.parent == Some(from))?;
        by.drive(self.car(), &self.search.at(from)).ok()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::collision::{Checker, Scene};
    use crate::geometry::{Point2, Pose2, Segment};
    use crate::num::{cos, hypot, sin};
    use crate::random::Seed;
    use crate::robots::HITCH;

    /// Planners whose costs all differ from one another: they park a car with a trailer or without in the Lot, or look
    /// for a goal behind a wall, which they never reach.
    fn planners() -> Vec<HybridAStar> {
        let wall = |x0, y0, x1, y1| Segment::new(Point2::new(x0, y0), Point2::new(x1, y1));
        let parted = Scene::of_walls(&[
            wall(0.0, 0.0, 40.0, 0.0),
            wall(40.0, 0.0, 40.0, 20.0),
            wall(40.0, 20.0, 0.0, 20.0),
            wall(0.0, 20.0, 0.0, 0.0),
            wall(25.0, 0.0, 25.0, 20.0),
        ]);
        let planner = |(trailer, scene, [x0, y0], [x1, y1, theta1]): (bool, Scene, [f64; 2], [f64; 3])| {
            let car = if trailer { HITCH.with_trailer() } else { HITCH };
            let at = |x, y, theta| HitchCfg { body: Pose2::new(x, y, theta), trailer: trailer.then_some(theta) };
            let problem = Problem::try_new(Checker::new(scene, car), at(x0, y0, 0.0), at(x1, y1, theta1), Seed(1));
            let settings =
                HybridSettings { reversal: 0.7, back: 0.45, fold: 0.6, greed: 1.7, ..HybridSettings::default() };
            HybridAStar::with_settings(problem.unwrap(), settings)
        };
        let parking = [false, true].map(|trailer| (trailer, Scene::lot(), [6.5, 2.5], [6.75, 7.0, -FRAC_PI_2]));
        let parted = [false, true].map(|trailer| (trailer, parted.clone(), [10.0, 10.0], [32.0, 12.0, 0.0]));
        parking.into_iter().chain(parted).map(planner).collect()
    }

    /// The length of an arc by its chords, metres, and whether it leads back.
    fn driven(arc: &HitchArc) -> (f64, bool) {
        let places: Vec<Pose2> = (0..=200).map(|k| arc.at(f64::from(k) / 200.0).body).collect();
        let chord = |ends: &[Pose2]| hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y);
        let [from, to] = [places[0], places[1]];
        let ahead = (to.x - from.x) * cos(from.theta) + (to.y - from.y) * sin(from.theta);
        (places.windows(2).map(chord).sum(), ahead < 0.0)
    }

    #[test]
    fn every_way_costs_its_length_its_stretches_back_its_reversals_and_its_folds() {
        let (mut count, mut reversals, mut shots) = (0, 0, 0);
        for mut planner in planners() {
            let is_solved = (0..300).any(|_| planner.step() == Progress::Solved);
            let HybridSettings { reversal, back, fold, .. } = planner.settings;
            // what each node's way costs, and whether it ends with a stretch back
            let mut ways: Vec<(f64, Option<bool>)> = vec![(0.0, None)];
            for (node, Arrival { cost, .. }) in planner.reached.iter().enumerate().skip(1) {
                let from = planner.search.growth.nodes()[node].parent.unwrap();
                let arc = planner.motion(from, node).unwrap();
                let ((length, is_back), end, (before, was_back)) = (driven(&arc), arc.at(1.0), ways[from]);
                let angle = end.trailer.map_or(0.0, |psi| wrap(end.body.theta - psi).abs());
                let turns = was_back.is_some_and(|was_back| was_back != is_back);
                let mut expected = before + length + fold * angle * length;
                expected += if is_back { back * length } else { 0.0 };
                expected += if turns { reversal } else { 0.0 };
                assert!((cost - expected).abs() < 1e-5, "{cost}, not {expected}, at node {node} from {from}");
                reversals += u32::from(turns);
                ways.push((expected, Some(is_back)));
            }
            (count, shots) = (count + ways.len(), shots + u32::from(is_solved));
        }
        assert!(count > 500 && reversals > 50 && shots > 0, "{count} ways, {reversals} reversals, {shots} solved");
    }

    #[test]
    fn the_cheapest_open_way_is_followed_and_a_cell_is_reached_again_only_for_less() {
        let (mut compared, mut cheaper) = (0, 0);
        for mut planner in planners() {
            // each node's cost with the greed's share of what remains
            let mut worth: Vec<f64> = Vec::new();
            for _ in 0..200 {
                let known = planner.reached.len();
                for node in worth.len()..known {
                    let remaining = planner.remaining.at(&planner.search.at(node).body);
                    worth.push(planner.reached[node].cost + 1.7 * remaining);
                }
                let closed = planner.closed.clone();
                let progress = planner.step();
                let fresh = planner.closed.iter().filter(|(cell, _)| !closed.contains_key(*cell));
                let [next] = fresh.map(|(_, node)| *node).collect::<Vec<_>>()[..] else {
                    panic!("an iteration expands one configuration")
                };
                for other in (0..known).filter(|node| !closed.contains_key(&planner.reached[*node].cell)) {
                    assert!(worth[next] <= worth[other], "{next} is followed before {other}");
                    compared += 1;
                }
                if progress != Progress::Growing {
                    break;
                }
                for node in known..planner.reached.len() {
                    let Arrival { cost, cell, .. } = planner.reached[node];
                    assert!(!closed.contains_key(&cell), "{node} is in a cell that is done with");
                    for other in planner.reached[..node].iter().filter(|other| other.cell == cell) {
                        assert!(cost < other.cost, "{node} costs {cost}, and its cell was reached for {}", other.cost);
                        cheaper += 1;
                    }
                }
            }
        }
        assert!(compared > 10_000 && cheaper > 5, "{compared} comparisons, {cheaper} cells reached for less");
    }
}
