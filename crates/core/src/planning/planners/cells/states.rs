//! `CellStates`, the cells of a level as a raster, and the ways through them.

use crate::cspace::{CellMap, CellState};
use crate::planning::Queue;

/// The states of the cells of a level, row after row.
pub(super) struct CellStates<const N: usize> {
    pub(super) states: Vec<CellState>,
    /// The number of cells along each side of the map.
    pub(super) side: usize,
    pub(super) min: [f64; N],
    /// The sides of a cell.
    pub(super) steps: [f64; N],
    pub(super) wraps: [bool; N],
}

impl<const N: usize> CellStates<N> {
    pub(super) fn of(map: &CellMap<N>, level: u32) -> Self {
        let (slice, side) = (map.slice(), 1 << level);
        let steps = std::array::from_fn(|i| (slice.max()[i] - slice.min()[i]) / side as f64);
        let wraps = std::array::from_fn(|i| slice.wraps_along(i));
        CellStates { states: map.raster(level), side, min: slice.min(), steps, wraps }
    }

    /// A point in cells from the least corner.
    pub(super) fn scaled(&self, p: [f64; N]) -> [f64; N] {
        std::array::from_fn(|i| (p[i] - self.min[i]) / self.steps[i])
    }

    /// The index along each side of the cell in which a point lies; on the last side, of the last.
    pub(super) fn index(&self, scaled: [f64; N]) -> [usize; N] {
        let last = (self.side - 1) as f64;
        scaled.map(|x| x.floor().clamp(0.0, last) as usize)
    }

    /// The number of the cell of an index, row after row.
    pub(super) fn number(&self, index: [usize; N]) -> usize {
        index.into_iter().rev().fold(0, |number, i| number * self.side + i)
    }

    fn index_of(&self, number: usize) -> [usize; N] {
        std::array::from_fn(|i| number / self.side.pow(i as u32) % self.side)
    }

    /// The number of the cell in which a point lies.
    pub(super) fn cell(&self, p: [f64; N]) -> usize {
        self.number(self.index(self.scaled(p)))
    }

    pub(super) fn is_open(&self, index: [usize; N]) -> bool {
        self.states[self.number(index)] != CellState::Blocked
    }

    pub(super) fn middle(&self, number: usize) -> [f64; N] {
        let index = self.index_of(number);
        std::array::from_fn(|i| self.min[i] + (index[i] as f64 + 0.5) * self.steps[i])
    }

    /// The cells that share a side with a cell, with the distance to them. A way through a corner or an edge alone
    /// would touch the cells beside it, so those decide.
    fn beside(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (index, side) = (self.index_of(cell), self.side);
        (0..N).flat_map(move |i| [(i, side - 1), (i, 1)]).filter_map(move |(i, step)| {
            let other = (index[i] + step) % side;
            let across = index[i].abs_diff(other) > 1;
            let stride = side.pow(i as u32);
            (self.wraps[i] || !across).then(|| (cell - index[i] * stride + other * stride, self.steps[i]))
        })
    }

    /// Whether a way leads from cell to cell through those whose state `passes`, both ends too.
    pub(super) fn joins(&self, start: usize, goal: usize, passes: impl Fn(CellState) -> bool) -> bool {
        let mut is_reached = vec![false; self.states.len()];
        let mut open = Vec::new();
        let mut reach = |open: &mut Vec<usize>, cell: usize| {
            if passes(self.states[cell]) && !std::mem::replace(&mut is_reached[cell], true) {
                open.push(cell);
            }
        };
        reach(&mut open, start);
        while let Some(cell) = open.pop() {
            if cell == goal {
                return true;
            }
            self.beside(cell).for_each(|(other, _)| reach(&mut open, other));
        }
        false
    }

    /// The shortest way from cell to cell through those whose state `passes`, where one [joins](Self::joins) them.
    pub(super) fn way(&self, start: usize, goal: usize, passes: impl Fn(CellState) -> bool) -> Vec<usize> {
        let mut costs = vec![f64::INFINITY; self.states.len()];
        let mut before = vec![start; self.states.len()];
        let mut open = Queue::new();
        costs[start] = 0.0;
        open.push(0.0, start);
        while let Some(cell) = open.pop().filter(|cell| *cell != goal) {
            for (other, length) in self.beside(cell) {
                let cost = costs[cell] + length;
                if cost < costs[other] && passes(self.states[other]) {
                    (costs[other], before[other]) = (cost, cell);
                    open.push(cost, other);
                }
            }
        }
        let mut cells = vec![goal];
        while cells[cells.len() - 1] != start {
            cells.push(before[cells[cells.len() - 1]]);
        }
        cells.reverse();
        cells
    }
}
