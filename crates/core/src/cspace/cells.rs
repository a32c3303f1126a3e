//! `CellMap`, a slice cut into cells as fine as their proofs need.

use std::collections::VecDeque;

use super::{CellState, Slice};

/// The finest level: its cells have a 4096th of the slice's sides.
pub const MAX_LEVEL: u32 = 12;

/// A cell of a level, which has `2^level` cells along each side of the slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell<const N: usize = 2> {
    /// How often the slice's sides were halved.
    pub level: u32,
    /// Its number along each side, from the least coordinate: in a plane the column and the row.
    pub index: [u32; N],
    /// What is known of it.
    pub state: CellState,
}

/// How far the proofs have come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProofProgress {
    /// Cells judged so far.
    pub judged: u64,
    /// The part of the slice proven free, 0 to 1.
    pub free: f64,
    /// The part proven blocked.
    pub blocked: f64,
    /// The part not known.
    pub unknown: f64,
    /// Whether every cell is proven or of the finest level.
    pub done: bool,
}

/// A node of the tree of cells; a leaf has no children.
#[derive(Clone, Debug)]
struct TreeNode<const N: usize> {
    cell: Cell<N>,
    /// The first of the children, four in a plane and eight in space, which stand side by side.
    children: Option<u32>,
}

/// The cells of a slice: a tree in which a cell that is not proven is cut in halves along each side, coarse cells
/// before fine ones.
///
/// What is known depends only on the number of cells judged, not on the number of calls.
#[derive(Clone, Debug)]
pub struct CellMap<const N: usize = 2> {
    slice: Slice<N>,
    finest: u32,
    nodes: Vec<TreeNode<N>>,
    waiting: VecDeque<u32>,
    judged: u64,
    /// What is proven, in cells of the finest level.
    free: u64,
    blocked: u64,
}

impl<const N: usize> CellMap<N> {
    /// Creates a map in which nothing is known. Its finest cells have a `2^finest`th of the slice's sides; `finest` is
    /// limited to [`MAX_LEVEL`].
    pub fn new(slice: Slice<N>, finest: u32) -> Self {
        let finest = std::cmp::min(finest, MAX_LEVEL);
        let cell = Cell { level: 0, index: [0; N], state: CellState::Unknown };
        let root = TreeNode { cell, children: None };
        CellMap { slice, finest, nodes: vec![root], waiting: VecDeque::from([0]), judged: 0, free: 0, blocked: 0 }
    }

    /// The slice.
    pub fn slice(&self) -> &Slice<N> {
        &self.slice
    }

    /// The finest level.
    pub fn finest(&self) -> u32 {
        self.finest
    }

    /// Judges up to `budget` more cells. Returns whether cells are left to judge.
    pub fn refine(&mut self, budget: u32) -> bool {
        for _ in 0..budget {
            let Some(number) = self.waiting.pop_front() else { return false };
            self.judge(number as usize);
        }
        !self.waiting.is_empty()
    }

    fn judge(&mut self, number: usize) {
        let cell = self.nodes[number].cell;
        let (centre, half) = self.place(&cell);
        let state = self.slice.judge(centre, half);
        self.nodes[number].cell.state = state;
        self.judged += 1;
        let size = 1_u64 << (N as u32 * (self.finest - cell.level));
        match state {
            CellState::Free => self.free += size,
            CellState::Blocked => self.blocked += size,
            CellState::Unknown if cell.level < self.finest => {
                let first = self.nodes.len() as u32;
                self.nodes[number].children = Some(first);
                for k in 0..1 << N {
                    let index = std::array::from_fn(|i| 2 * cell.index[i] + (k >> i & 1));
                    let cell = Cell { level: cell.level + 1, index, state: CellState::Unknown };
                    self.nodes.push(TreeNode { cell, children: None });
                    self.waiting.push_back(first + k);
                }
            }
            CellState::Unknown => {}
        }
    }

    /// The middle of a cell and half its sides.
    pub fn place(&self, cell: &Cell<N>) -> ([f64; N], [f64; N]) {
        let (_, whole) = self.slice.whole();
        let scale = 1.0 / f64::from(1_u32 << cell.level);
        let half = whole.map(|h| h * scale);
        let min = self.slice.min();
        let index = cell.index.map(f64::from);
        (std::array::from_fn(|i| min[i] + (2.0 * index[i] + 1.0) * half[i]), half)
    }

    /// How far the proofs have come.
    pub fn progress(&self) -> ProofProgress {
        let count = 1_u64 << (N as u32 * self.finest);
        let all = count as f64;
        let (free, blocked) = (self.free as f64 / all, self.blocked as f64 / all);
        let unknown = (count - self.free - self.blocked) as f64 / all;
        ProofProgress { judged: self.judged, free, blocked, unknown, done: self.waiting.is_empty() }
    }

    /// The number of cells that there are to judge in all, estimated: what lies between free and blocked crosses half
    /// of the parts of a cell. It is exact when no cell is left.
    pub fn expected(&self) -> u64 {
        let half = 1_u64 << (N - 1);
        let levels = |number: &u32| self.finest - self.nodes[*number as usize].cell.level;
        let below = |number: &u32| (0..levels(number)).fold(1, |cells, _| 1 + half * cells);
        self.judged + self.waiting.iter().map(below).sum::<u64>()
    }

    /// The state of the cell in which a point of the slice lies; unknown beyond the slice.
    pub fn state(&self, p: [f64; N]) -> CellState {
        let (min, max) = (self.slice.min(), self.slice.max());
        if !(0..N).all(|i| p[i] >= min[i] && p[i] <= max[i]) {
            return CellState::Unknown;
        }
        let mut node = &self.nodes[0];
        while let Some(first) = node.children {
            let (centre, _) = self.place(&node.cell);
            let child: u32 = (0..N).map(|i| u32::from(p[i] >= centre[i]) << i).sum();
            node = &self.nodes[(first + child) as usize];
        }
        node.cell.state
    }

    /// The cells that are not cut further, coarse before fine.
    pub fn leaves(&self) -> impl Iterator<Item = &Cell<N>> {
        self.nodes.iter().filter(|node| node.children.is_none()).map(|node| &node.cell)
    }

    /// The number of the tree's nodes, of which the leaves are some.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The cell of a node of the tree.
    pub(super) fn cell(&self, number: usize) -> &Cell<N> {
        &self.nodes[number].cell
    }

    /// As [`leaves`](Self::leaves), with the numbers of their nodes.
    pub(super) fn numbered_leaves(&self) -> impl Iterator<Item = (usize, &Cell<N>)> {
        let leaves = self.nodes.iter().enumerate().filter(|(_, node)| node.children.is_none());
        leaves.map(|(number, node)| (number, &node.cell))
    }

    /// What a cell covers of the finest level along each side, without the last.
    pub(super) fn span(&self, cell: &Cell<N>) -> [[u32; 2]; N] {
        let scale = 1_u32 << (self.finest - cell.level);
        cell.index.map(|index| [index * scale, (index + 1) * scale])
    }

    /// The numbers of the leaves that cover any of these cells of the finest level, given along each side.
    pub(super) fn leaves_within(&self, ranges: [[u32; 2]; N]) -> Vec<usize> {
        let (mut found, mut open) = (Vec::new(), vec![0]);
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            let span = self.span(&node.cell);
            if (0..N).any(|i| span[i][1] <= ranges[i][0] || ranges[i][1] <= span[i][0]) {
                continue;
            }
            match node.children {
                Some(first) => open.extend((0..1 << N).map(|k| (first + k) as usize)),
                None => found.push(number),
            }
        }
        found
    }

    /// The level up to which all cells are judged; `None` before any is.
    pub fn judged_level(&self) -> Option<u32> {
        match self.waiting.front() {
            Some(number) => self.nodes[*number as usize].cell.level.checked_sub(1),
            None => Some(self.finest),
        }
    }

    /// The states as an image of `2^level` cells along each side, row after row from the least coordinates, and in
    /// space layer after layer. `level` is limited to [`finest`](Self::finest). A cell of the image that the map has
    /// cut further is unknown.
    pub fn raster(&self, level: u32) -> Vec<CellState> {
        let level = std::cmp::min(level, self.finest);
        let side = 1_usize << level;
        let mut image = vec![CellState::Unknown; side.pow(N as u32)];
        for Cell { level: own, index, state } in self.leaves().filter(|leaf| leaf.level <= level) {
            let scale = 1_usize << (level - own);
            let first = index.map(|i| i as usize * scale);
            // a row along the first side for each place along the others
            for row in 0..scale.pow(N as u32 - 1) {
                let (mut start, mut stride, mut rest) = (first[0], side, row);
                for low in &first[1..] {
                    start += (low + rest % scale) * stride;
                    (stride, rest) = (stride * side, rest / scale);
                }
                image[start..start + scale].fill(*state);
            }
        }
        image
    }
}

#[cfg(test)]
mod tests;
