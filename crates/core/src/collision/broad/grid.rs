//! `PieceGrid`, a uniform grid over the boxes of many pieces that are spread evenly.

use crate::geometry::{Aabb, Point2, square};
use crate::num::{lesser, sqrt};

/// A uniform grid over the boxes of pieces; each cell lists the boxes that touch it.
#[derive(Clone, Debug)]
pub(crate) struct PieceGrid {
    corner: Point2,
    size: f64,
    inverse: f64,
    columns: u16,
    rows: u16,
    /// Where each cell's list begins in `items`, row by row, and where the last ends.
    starts: Vec<u32>,
    items: Vec<GridItem>,
}

/// A box in a cell's list, with its piece and all cells that it touches.
#[derive(Clone, Copy, Debug)]
struct GridItem {
    extent: Aabb,
    piece: u32,
    cells: CellRectangle,
}

/// A rectangle of cells, first and last included.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CellRectangle {
    left: u16,
    right: u16,
    low: u16,
    high: u16,
}

impl CellRectangle {
    fn count(&self) -> usize {
        usize::from(self.right - self.left + 1) * usize::from(self.high - self.low + 1)
    }

    fn meets(&self, other: &CellRectangle) -> bool {
        self.left <= other.right && other.left <= self.right && self.low <= other.high && other.low <= self.high
    }
}

/// About the largest number of cells along a side: no cell is smaller than the longer side divided by this.
const MAX_CELLS_A_SIDE: f64 = 512.0;
/// Largest number of pieces that may touch one cell; beyond it a tree is the better choice.
const CROWD: u32 = 32;
/// Largest average number of cells that a piece may touch; beyond it a tree is the better choice.
const ENTRIES: usize = 8;
/// Largest number of boxes that wait until the piece of the nearest box has been measured.
const SOME: usize = 32;

impl PieceGrid {
    /// The grid over boxes, with about two thirds as many cells as boxes. `None` where the boxes are crowded, too
    /// different in size, or not finite.
    pub(crate) fn new(extents: &[Aabb]) -> Option<Self> {
        let all = extents.iter().copied().reduce(|a, b| a.merged(&b))?;
        let (width, height) = (all.max.x - all.min.x, all.max.y - all.min.y);
        let longest = if width > height { width } else { height };
        let fair = 1.25 * sqrt(width * height / extents.len() as f64);
        let size = if fair > longest / MAX_CELLS_A_SIDE { fair } else { longest / MAX_CELLS_A_SIDE };
        if !(size > 0.0 && size < 1e100) {
            return None;
        }
        let cells = |extent: f64| (extent / size) as u16 + 1;
        let (columns, rows) = (cells(width), cells(height));
        let mut grid =
            PieceGrid { corner: all.min, size, inverse: 1.0 / size, columns, rows, starts: vec![], items: vec![] };
        // counted before the cells are visited: boxes that all cover everything make as many entries as boxes times
        // cells
        let mut entries = 0;
        for extent in extents {
            entries += grid.block(extent).count();
            if entries > ENTRIES * extents.len() {
                return None;
            }
        }
        let mut counts = vec![0_u32; usize::from(columns) * usize::from(rows) + 1];
        for extent in extents {
            grid.each_cell(&grid.block(extent), |cell| counts[cell + 1] += 1);
        }
        if counts.iter().any(|&n| n > CROWD) {
            return None;
        }
        for i in 1..counts.len() {
            counts[i] += counts[i - 1];
        }
        let mut next = counts.clone();
        let nothing = Aabb { min: all.min, max: all.min };
        let mut items = vec![GridItem { extent: nothing, piece: 0, cells: grid.block(&nothing) }; entries];
        for (piece, extent) in extents.iter().enumerate() {
            let cells = grid.block(extent);
            grid.each_cell(&cells, |cell| {
                items[next[cell] as usize] = GridItem { extent: *extent, piece: piece as u32, cells };
                next[cell] += 1;
            });
        }
        (grid.starts, grid.items) = (counts, items);
        Some(grid)
    }

    /// The cells that a box touches. What lies beyond the grid counts as in the cells at its rim.
    fn block(&self, e: &Aabb) -> CellRectangle {
        // the cast saturates
        let column = |x: f64| (((x - self.corner.x) * self.inverse) as u16).min(self.columns - 1);
        let row = |y: f64| (((y - self.corner.y) * self.inverse) as u16).min(self.rows - 1);
        CellRectangle { left: column(e.min.x), right: column(e.max.x), low: row(e.min.y), high: row(e.max.y) }
    }

    fn each_cell(&self, block: &CellRectangle, mut visit: impl FnMut(usize)) {
        for j in block.low..=block.high {
            for i in block.left..=block.right {
                visit(usize::from(j) * usize::from(self.columns) + usize::from(i));
            }
        }
    }

    /// Calls `visit` once with each box that touches a cell of `block` but none of `without`, until it returns true.
    #[inline]
    fn each_in(
        &self,
        block: &CellRectangle,
        without: Option<&CellRectangle>,
        mut visit: impl FnMut(&GridItem) -> bool,
    ) {
        for j in block.low..=block.high {
            for i in block.left..=block.right {
                let cell = usize::from(j) * usize::from(self.columns) + usize::from(i);
                for item in &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize] {
                    // once only: in the first of its cells in the block
                    let first = i == item.cells.left.max(block.left) && j == item.cells.low.max(block.low);
                    if first && without.is_none_or(|w| !w.meets(&item.cells)) && visit(item) {
                        return;
                    }
                }
            }
        }
    }

    /// A lower bound on the distance from the box to whatever touches no cell of the block, metres.
    fn room(&self, block: &CellRectangle, from: &Aabb) -> f64 {
        let side = |inside: bool, room: f64| if inside { room } else { f64::INFINITY };
        let at = |corner: f64, cells: u16| corner + f64::from(cells) * self.size;
        let x = lesser(
            side(block.left > 0, from.min.x - at(self.corner.x, block.left)),
            side(block.right + 1 < self.columns, at(self.corner.x, block.right + 1) - from.max.x),
        );
        let y = lesser(
            side(block.low > 0, from.min.y - at(self.corner.y, block.low)),
            side(block.high + 1 < self.rows, at(self.corner.y, block.high + 1) - from.max.y),
        );
        lesser(x, y) - 1e-9 * self.size
    }

    /// Calls `look` with every box that may hold something no farther than the least distance so far, which `look`
    /// returns.
    pub(crate) fn nearest(&self, from: &Aabb, within: f64, mut look: impl FnMut(usize) -> f64) {
        let mut least = within;
        let block = self.block(&from.grown(lesser(within, 0.25 * self.size)));
        // the piece of the nearest box first: most others can then be passed over
        // two arrays of zeros, which cost less than one of pairs
        let (mut distances, mut pieces, mut count, mut first) = ([0.0; SOME], [0; SOME], 0, (f64::INFINITY, 0));
        self.each_in(&block, None, |item| {
            let distance = from.squared_distance(&item.extent);
            if distance < first.0 {
                first = (distance, item.piece);
            }
            if count < SOME {
                (distances[count], pieces[count]) = (distance, item.piece);
                count += 1;
            } else if distance <= square(least) {
                least = look(item.piece as usize);
            }
            false
        });
        if first.0 <= square(least) {
            least = look(first.1 as usize);
        }
        for (&distance, &piece) in distances.iter().zip(&pieces).take(count) {
            if piece != first.1 && distance <= square(least) {
                least = look(piece as usize);
            }
        }
        let mut seen = block;
        loop {
            let room = self.room(&seen, from);
            if least < room || room == f64::INFINITY {
                return;
            }
            let block = self.block(&from.grown(lesser(least, 2.0 * room + self.size) * (1.0 + 1e-9)));
            if block == seen {
                return;
            }
            self.each_in(&block, Some(&seen), |item| {
                if from.squared_distance(&item.extent) <= square(least) {
                    least = look(item.piece as usize);
                }
                false
            });
            seen = block;
        }
    }

    /// Calls `visit` with each box at most `range` away, until it returns true.
    pub(crate) fn each_near(&self, from: &Aabb, range: f64, mut visit: impl FnMut(usize) -> bool) {
        let block = self.block(&from.grown(range * (1.0 + 1e-9) + 1e-9 * self.size));
        self.each_in(&block, None, |item| {
            from.squared_distance(&item.extent) <= range * range && visit(item.piece as usize)
        });
    }
}
