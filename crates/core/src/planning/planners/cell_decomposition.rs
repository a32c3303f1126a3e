//! `CellDecomposition`, a planner that may prove that there is no path.

use crate::collision::Problem;
use crate::configuration::{AnyConfiguration, Configuration};
use crate::cspace::{CellMap, CellState, Slice};
use crate::planning::{NoPath, Planner, Queue, Search};
use crate::robots::AnyRobot;

/// The level of the finest cells: a 128th of the space's sides.
const FINEST: u32 = 7;

/// The number of cells that an iteration judges.
const CELLS: u32 = 256;

/// Approximate cell decomposition (Brooks and Lozano-Perez, 1985): the cells of the configuration space are cut until
/// cells proven free join the start to the goal, or cells proven blocked part them.
///
/// The first gives a path through the middles of cells, the second a proof: [`NoPath::Unreachable`], whose
/// [`Barrier`](crate::cspace::Barrier) anybody can check. It is for spaces of two dimensions: a disc's positions within
/// the scene's bounds, and an arm of two links. Any other robot ends it with [`NoPath::Unsuited`]. Where the finest
/// cells decide neither it ends with [`NoPath::Undecided`].
///
/// An iteration judges 256 cells.
#[derive(Clone, Debug)]
pub struct CellDecomposition {
    search: Search<AnyRobot>,
    map: Option<CellMap>,
}

impl CellDecomposition {
    /// The planner, with nothing known of any cell.
    pub fn new(problem: Problem<AnyRobot>) -> Self {
        let slice = Slice::through(problem.checker(), &problem.start()).ok();
        // where other coordinates matter too, parting the start from the goal in the slice proves nothing
        let slice = slice.filter(|slice| slice.held().is_empty());
        let mut search = Search::from_start(problem);
        search.end = slice.is_none().then_some(NoPath::Unsuited("cells are for discs and for arms of two links"));
        CellDecomposition { search, map: slice.map(|slice| CellMap::new(slice, FINEST)) }
    }

    /// Judges cells, and takes the path where those that are free join the ends; the reason is why there is none.
    fn refine(&mut self) -> Option<NoPath> {
        let map = self.map.as_mut()?;
        let is_done = !map.refine(CELLS);
        let raster = CellStates::of(map);
        // either end is free, so all cells at whose side it lies are open, and any of them will do
        let place = |q: AnyConfiguration| raster.cell(map.slice().point(&q.in_chart()));
        let [start, goal] = [self.search.problem.start(), self.search.problem.goal()].map(place);
        if let Some(cells) = raster.way(start, goal, |state| state == CellState::Free) {
            // within one cell the straight way is free
            let cells = if cells.len() > 1 { &cells[..] } else { &[] };
            let middles: Vec<AnyConfiguration> =
                cells.iter().map(|cell| map.slice().at(raster.middle(*cell))).collect();
            let goal = self.search.problem.goal().in_chart();
            let end = middles.into_iter().chain([goal]).try_fold(0, |node, q| self.search.reach(node, q));
            let is_solved = end.is_some_and(|end| self.search.take_branch(end));
            let nodes = self.search.growth.nodes().len();
            return (!is_solved).then_some(NoPath::NoneInGraph { nodes });
        }
        if raster.way(start, goal, |state| state != CellState::Blocked).is_none() {
            // both ends lie within the cells, and so does every path between them
            return Some(NoPath::Unreachable { cells: map.progress().judged });
        }
        let unit = if map.slice().wraps() { "rad" } else { "m" };
        is_done.then_some(NoPath::Undecided { sides: raster.steps, unit })
    }
}

/// The states of the finest cells, row after row.
struct CellStates {
    states: Vec<CellState>,
    side: usize,
    min: [f64; 2],
    /// The sides of a cell.
    steps: [f64; 2],
    wraps: bool,
}

impl CellStates {
    fn of(map: &CellMap) -> Self {
        let (min, max, side) = (map.slice().min(), map.slice().max(), 1 << map.finest());
        let steps = [0, 1].map(|i| (max[i] - min[i]) / side as f64);
        CellStates { states: map.raster(map.finest()), side, min, steps, wraps: map.slice().wraps() }
    }

    /// The number of the cell in which a point lies; on its last side, of the last.
    fn cell(&self, p: [f64; 2]) -> usize {
        let last = (self.side - 1) as f64;
        let [column, row] = [0, 1].map(|i| ((p[i] - self.min[i]) / self.steps[i]).floor().clamp(0.0, last) as usize);
        row * self.side + column
    }

    fn middle(&self, cell: usize) -> [f64; 2] {
        let place = [cell % self.side, cell / self.side];
        [0, 1].map(|i| self.min[i] + (place[i] as f64 + 0.5) * self.steps[i])
    }

    /// The cells that share a side with a cell, with the distance to them. A way through a corner alone would touch the
    /// cells on both sides of it, so those decide.
    fn beside(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (place, side) = ([cell % self.side, cell / self.side], self.side);
        [(0, side - 1), (0, 1), (1, side - 1), (1, 1)].into_iter().filter_map(move |(i, step)| {
            let mut other = place;
            other[i] = (place[i] + step) % side;
            let across = place[i].abs_diff(other[i]) > 1;
            (self.wraps || !across).then(|| (other[1] * side + other[0], self.steps[i]))
        })
    }

    /// The shortest way from cell to cell through those whose state `passes`, both ends too.
    fn way(&self, start: usize, goal: usize, passes: impl Fn(CellState) -> bool) -> Option<Vec<usize>> {
        let mut costs = vec![f64::INFINITY; self.states.len()];
        let mut before = vec![start; self.states.len()];
        let mut open = Queue::new();
        if passes(self.states[start]) {
            costs[start] = 0.0;
            open.push(0.0, start);
        }
        while let Some(cell) = open.pop().filter(|cell| *cell != goal) {
            for (other, length) in self.beside(cell) {
                let cost = costs[cell] + length;
                if cost < costs[other] && passes(self.states[other]) {
                    (costs[other], before[other]) = (cost, cell);
                    open.push(cost, other);
                }
            }
        }
        if costs[goal] == f64::INFINITY {
            return None;
        }
        let mut cells = vec![goal];
        while cells[cells.len() - 1] != start {
            cells.push(before[cells[cells.len() - 1]]);
        }
        cells.reverse();
        Some(cells)
    }
}

impl Planner<AnyRobot> for CellDecomposition {
    fn name(&self) -> &'static str {
        "cell-decomposition"
    }

    fn search(&self) -> &Search<AnyRobot> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<AnyRobot> {
        &mut self.search
    }

    fn advance(&mut self) {
        self.search.end = self.refine();
    }

    fn cells(&self) -> Option<&CellMap> {
        self.map.as_ref()
    }
}
