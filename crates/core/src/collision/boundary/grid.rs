//! `Cells`, a uniform grid over segments and discs, for scans of large worlds.

use super::segments::{Circle, SegmentArrays, SegmentSoup};
use crate::geometry::{Point2, Segment};
use crate::num::{greater, lesser, sqrt};

/// A uniform grid over a soup: each cell lists the numbers of the segments and discs that touch it. The grid renumbers
/// the segments, so that those of neighbouring cells lie together in memory. The discs are numbered after the soup's
/// segments, in the soup's order.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    corner: Point2,
    size: f64,
    columns: i64,
    rows: i64,
    /// Where each cell's list begins in `things`, row by row, and where the last ends.
    starts: Vec<u32>,
    things: Vec<u32>,
    segments: Vec<Segment>,
}

/// Where a point lies in the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridCell {
    pub(crate) column: i64,
    pub(crate) row: i64,
    /// Lower bounds on the distance to the right, left, upper and lower side of the point's cell, metres.
    sides: [f64; 4],
}

/// About the largest number of cells along a side: no cell is smaller than the longer side divided by this.
const MAX_CELLS_A_SIDE: f64 = 512.0;
/// Largest average number of cells that a segment or disc may touch. Larger cells meet it in the end: a grid has at
/// least four cells, and at worst each segment or disc touches all of them.
const PAIRS: usize = 16;

impl Cells {
    /// The grid over a soup, with about two fifths as many cells as segments and discs. `None` where the boundary is
    /// empty, not finite or a single point.
    pub(crate) fn new(soup: &SegmentSoup) -> Option<Self> {
        let segments = soup.segments();
        let count = segments.len() + soup.circles().len();
        let segment_boxes = (0..segments.len()).map(|i| segment_box(&segments.segment(i)));
        let boxes: Vec<[f64; 4]> = segment_boxes.chain(soup.circles().iter().map(circle_box)).collect();
        let [x0, y0, x1, y1] = boxes
            .iter()
            .copied()
            .reduce(|a, b| [lesser(a[0], b[0]), lesser(a[1], b[1]), greater(a[2], b[2]), greater(a[3], b[3])])?;
        let (width, height) = (x1 - x0, y1 - y0);
        let mut size = greater(1.6 * sqrt(width * height / count as f64), greater(width, height) / MAX_CELLS_A_SIDE);
        let (mut grid, mut pairs) = loop {
            // the grid reaches a little beyond the boundary, so that rounding puts nothing outside
            size *= 1.0 + 1e-9;
            let corner = Point2::new(x0 - 0.01 * size, y0 - 0.01 * size);
            let cells = |extent: f64| (extent / size) as i64 + 2;
            if !(size > 0.0 && size.is_finite()) {
                return None;
            }
            let (columns, rows) = (cells(width), cells(height));
            let grid = Cells { corner, size, columns, rows, starts: vec![], things: vec![], segments: vec![] };
            // larger cells, where the lists of these would be too long
            match grid.pairs(&boxes, segments, PAIRS * count) {
                Some(pairs) => break (grid, pairs),
                None => size *= 2.0,
            }
        };
        pairs.sort_unstable();
        grid.starts = vec![0; (grid.columns * grid.rows) as usize + 1];
        for (cell, _) in &pairs {
            grid.starts[*cell as usize + 1] += 1;
        }
        for i in 1..grid.starts.len() {
            grid.starts[i] += grid.starts[i - 1];
        }
        const NONE: u32 = u32::MAX;
        let mut renumbered = vec![NONE; segments.len()];
        let number = |(_, i): (u32, u32)| {
            let Some(new) = renumbered.get_mut(i as usize) else { return i };
            if *new == NONE {
                *new = grid.segments.len() as u32;
                grid.segments.push(segments.segment(i as usize));
            }
            *new
        };
        grid.things = pairs.into_iter().map(number).collect();
        Some(grid)
    }

    /// The pairs of a cell and a segment or disc that touches it; `None` if there are more than `most`.
    fn pairs(&self, boxes: &[[f64; 4]], segments: &SegmentArrays, most: usize) -> Option<Vec<(u32, u32)>> {
        let mut pairs = Vec::new();
        for (i, b) in boxes.iter().enumerate() {
            let segment = (i < segments.len()).then(|| segments.segment(i));
            self.touched(b, segment, |cell| pairs.push((cell, i as u32)));
            if pairs.len() > most {
                return None;
            }
        }
        Some(pairs)
    }

    /// Calls `visit` with every cell that the box touches or, given a segment, that the segment touches. May visit a
    /// few more cells, never fewer.
    fn touched(&self, b: &[f64; 4], segment: Option<Segment>, mut visit: impl FnMut(u32)) {
        let slack = 1e-6 * self.size;
        let row = |y: f64| (((y - self.corner.y) / self.size) as i64).clamp(0, self.rows - 1);
        let column = |x: f64| (((x - self.corner.x) / self.size) as i64).clamp(0, self.columns - 1);
        for j in row(b[1] - slack)..=row(b[3] + slack) {
            let (mut from, mut to) = (b[0], b[2]);
            if let Some(Segment { a, b }) = segment
                && a.y != b.y
            {
                let (low, high) = (self.corner.y + j as f64 * self.size, self.corner.y + (j + 1) as f64 * self.size);
                let x_at = |y: f64| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
                let (p, q) = (x_at(low - slack), x_at(high + slack));
                (from, to) = (lesser(p, q), greater(p, q));
            }
            for i in column(from - slack)..=column(to + slack) {
                visit((j * self.columns + i) as u32);
            }
        }
    }

    /// The place of a point, which may lie outside the grid.
    pub(crate) fn place(&self, p: Point2) -> GridCell {
        let (x, y) = ((p.x - self.corner.x) / self.size, (p.y - self.corner.y) / self.size);
        let (column, row) = (x.floor(), y.floor());
        let (fx, fy) = (x - column, y - row);
        let sides = [1.0 - fx, fx, 1.0 - fy, fy].map(|f| greater(f - 1e-6, 0.0) * self.size);
        GridCell { column: column as i64, row: row as i64, sides }
    }

    /// Lower bounds on the distance from a place to the right, left, upper and lower side of the square of cells inside
    /// ring number `ring`, metres.
    pub(crate) fn sides(&self, place: &GridCell, ring: i64) -> [f64; 4] {
        place.sides.map(|side| side + (ring - 1) as f64 * self.size * (1.0 - 1e-9))
    }

    /// A lower bound on the distance from a place to anything in ring number `ring` or beyond, metres.
    pub(crate) fn least_distance(&self, place: &GridCell, ring: i64) -> f64 {
        if ring == 0 { 0.0 } else { self.sides(place, ring).into_iter().fold(f64::INFINITY, lesser) }
    }

    /// The first ring about a place that holds cells of the grid, and the last.
    pub(crate) fn rings(&self, place: &GridCell) -> (i64, i64) {
        let outside = |x: i64, count: i64| (-x).max(x - count + 1).max(0);
        let farthest = |x: i64, count: i64| x.abs().max((count - 1 - x).abs());
        (
            outside(place.column, self.columns).max(outside(place.row, self.rows)),
            farthest(place.column, self.columns).max(farthest(place.row, self.rows)),
        )
    }

    /// A length in units of the cells' size.
    pub(crate) fn in_cells(&self, length: f64) -> f64 {
        length / self.size
    }

    /// Whether there is a cell in this column and row.
    #[inline(always)]
    pub(crate) fn holds(&self, column: i64, row: i64) -> bool {
        ((column as u64) < self.columns as u64) & ((row as u64) < self.rows as u64)
    }

    /// The number of a cell that the grid [`holds`](Self::holds).
    #[inline(always)]
    pub(crate) fn number(&self, column: i64, row: i64) -> usize {
        row.wrapping_mul(self.columns).wrapping_add(column) as usize
    }

    /// The numbers of the segments and discs that touch a cell.
    #[inline(always)]
    pub(crate) fn things(&self, cell: usize) -> &[u32] {
        &self.things[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Makes a segment with these ends NaN, which no ray hits; false where there is none.
    pub(crate) fn forget(&mut self, segment: &Segment) -> bool {
        let place = self.place(segment.a);
        if !self.holds(place.column, place.row) {
            return false;
        }
        let cell = self.number(place.column, place.row);
        for k in self.starts[cell] as usize..self.starts[cell + 1] as usize {
            // discs have numbers beyond those of segments
            if let Some(own) = self.segments.get_mut(self.things[k] as usize)
                && own == segment
            {
                let nowhere = Point2::new(f64::NAN, f64::NAN);
                *own = Segment::new(nowhere, nowhere);
                return true;
            }
        }
        false
    }

    #[inline(always)]
    pub(crate) fn segment(&self, number: u32) -> &Segment {
        &self.segments[number as usize]
    }

    /// Calls `visit` with each cell of ring number `ring` about a place.
    pub(crate) fn each_in_ring(&self, place: &GridCell, ring: i64, mut visit: impl FnMut(usize)) {
        let (left, right) = (place.column - ring, place.column + ring);
        let (low, high) = (place.row - ring, place.row + ring);
        let mut cell = |i: i64, j: i64| visit(self.number(i, j));
        let rows = low.max(0)..=high.min(self.rows - 1);
        for j in [low, high].into_iter().take(if ring == 0 { 1 } else { 2 }) {
            if rows.contains(&j) {
                (left.max(0)..=right.min(self.columns - 1)).for_each(|i| cell(i, j));
            }
        }
        for j in (low + 1).max(0)..=(high - 1).min(self.rows - 1) {
            if left >= 0 && left < self.columns {
                cell(left, j);
            }
            if right >= 0 && right < self.columns {
                cell(right, j);
            }
        }
    }
}

fn segment_box(s: &Segment) -> [f64; 4] {
    [lesser(s.a.x, s.b.x), lesser(s.a.y, s.b.y), greater(s.a.x, s.b.x), greater(s.a.y, s.b.y)]
}

fn circle_box(c: &Circle) -> [f64; 4] {
    let (p, r) = (c.centre, c.radius);
    [p.x - r, p.y - r, p.x + r, p.y + r]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    #[test]
    fn every_point_of_every_segment_is_in_a_cell_that_lists_it() {
        let mut draws = Stream::new(Seed(1), "cells");
        let mut soup = SegmentSoup::default();
        let segments: Vec<Segment> = (0..300)
            .map(|i| {
                // every third on a lattice, where segments run along the sides of cells
                let mut x = || if i % 3 == 0 { draws.below(20) as f64 } else { draws.uniform(0.0, 20.0) };
                Segment::new(Point2::new(x(), x()), Point2::new(x(), x()))
            })
            .collect();
        segments.iter().for_each(|s| soup.push_segment(*s));
        let grid = Cells::new(&soup).unwrap();
        for s in &segments {
            for k in 0..=100 {
                let p = s.a + (s.b - s.a) * (f64::from(k) / 100.0);
                let place = grid.place(p);
                let listed = grid.things(grid.number(place.column, place.row));
                assert!(listed.iter().any(|&number| grid.segment(number) == s), "{s:?} at {p}");
            }
        }
    }

    #[test]
    fn the_rings_about_a_place_hold_every_cell_once() {
        let mut soup = SegmentSoup::default();
        for k in 0..40 {
            let x = f64::from(k);
            soup.push_segment(Segment::new(Point2::new(x, 0.0), Point2::new(x, 30.0)));
        }
        let grid = Cells::new(&soup).unwrap();
        for p in [Point2::new(3.0, 4.0), Point2::new(-9.0, 50.0), Point2::new(100.0, 10.0)] {
            let place = grid.place(p);
            let (first, last) = grid.rings(&place);
            let mut seen = std::collections::BTreeSet::new();
            for ring in first..=last {
                grid.each_in_ring(&place, ring, |cell| assert!(seen.insert(cell), "{cell} twice"));
            }
            assert_eq!(seen.len() as i64, grid.columns * grid.rows);
        }
    }
}
