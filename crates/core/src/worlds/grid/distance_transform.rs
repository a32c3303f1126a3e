//! The exact Euclidean distance transform of a grid.

use crate::num;
use crate::worlds::Grid;

/// The distance from the centre of every cell of a grid to the centre of the nearest occupied cell.
///
/// The transform is exact: squared distances, in cells, are whole numbers and are computed as such. It takes a lower
/// envelope of parabolas along every column, then along every row, in linear time (Felzenszwalb and Huttenlocher,
/// "Distance transforms of sampled functions", 2012). For a cell within the bounds it differs from the exact distance
/// to the obstacles by at most half a cell's diagonal, as long as the nearest obstacle point lies within the bounds
/// too.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceTransform {
    resolution: f64,
    columns: u32,
    rows: u32,
    squared: Vec<u64>,
}

/// Stands for no occupied cell. Squared distances are far smaller: at most (2^24)^2 * 2.
pub(super) const NONE: u64 = u64::MAX;

impl DistanceTransform {
    /// The distance transform of a grid.
    pub fn of(grid: &Grid) -> Self {
        let (columns, rows) = (grid.columns(), grid.rows());
        let (width, height) = (columns as usize, rows as usize);
        let mut squared = vec![NONE; width * height];
        let mut envelope = Envelope::default();
        let mut line = Vec::new();
        for column in 0..columns {
            line.clear();
            line.extend((0..rows).map(|row| if grid.is_occupied(column, row) { 0 } else { NONE }));
            envelope.transform(&mut line, |_, _| {});
            for (row, d) in line.iter().enumerate() {
                squared[row * width + column as usize] = *d;
            }
        }
        for row in squared.chunks_exact_mut(width) {
            envelope.transform(row, |_, _| {});
        }
        DistanceTransform { resolution: grid.resolution(), columns, rows, squared }
    }

    /// Squared distance of a cell, in units of cells. It is 0 for an occupied cell, and outside the grid, where nothing
    /// is known; `None` if no cell is occupied.
    pub fn squared_cells(&self, column: u32, row: u32) -> Option<u64> {
        if column >= self.columns || row >= self.rows {
            return Some(0);
        }
        let d = self.squared[row as usize * self.columns as usize + column as usize];
        (d != NONE).then_some(d)
    }

    /// The distance of a cell in metres: the root of [`squared_cells`](Self::squared_cells) times the cell size;
    /// infinity when no cell is occupied.
    pub fn distance(&self, column: u32, row: u32) -> f64 {
        // below 2^53, hence exact as an f64
        self.squared_cells(column, row).map_or(f64::INFINITY, |d| num::sqrt(d as f64) * self.resolution)
    }
}

/// The lower envelope of the parabolas `f(q) + (x - q)^2` over whole numbers x.
#[derive(Default)]
pub(super) struct Envelope {
    /// Each parabola's vertex and height, and the first x at which it is the lowest, from left to right.
    parabolas: Vec<(u64, u64, u64)>,
}

impl Envelope {
    /// Replaces every `f(x)` by the least `f(q) + (x - q)^2` over all q. `found` gets each x with such a q.
    pub(super) fn transform(&mut self, f: &mut [u64], mut found: impl FnMut(usize, usize)) {
        let n = f.len() as u64;
        self.parabolas.clear();
        let value = |q: u64, height: u64, x: u64| height + x.abs_diff(q) * x.abs_diff(q);
        for (q, &height) in (0..n).zip(f.iter()) {
            if height == NONE {
                continue;
            }
            // a parabola that the new one undercuts at its start is undercut from there on
            while self.parabolas.last().is_some_and(|&(v, h, start)| value(q, height, start) <= value(v, h, start)) {
                self.parabolas.pop();
            }
            let start = match self.parabolas.last() {
                None => 0,
                // the first whole x with f(q) + (x - q)^2 < f(v) + (x - v)^2, v < q; the numerator is not negative,
                // as the older parabola still wins at its own beginning, which is not negative
                Some(&(v, h, _)) => (height + q * q).saturating_sub(h + v * v) / (2 * (q - v)) + 1,
            };
            if start < n {
                self.parabolas.push((q, height, start));
            }
        }
        let mut at = 0;
        for (x, out) in (0..n).zip(f.iter_mut()) {
            while self.parabolas.get(at + 1).is_some_and(|&(_, _, start)| start <= x) {
                at += 1;
            }
            if let Some(&(q, height, _)) = self.parabolas.get(at) {
                *out = value(q, height, x);
                found(x as usize, q as usize);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::Point2;
    use crate::random::{Seed, Stream};
    use crate::worlds::World;
    use crate::worlds::tests::point_distance;

    #[test]
    fn equals_brute_force_on_random_grids() {
        let mut s = Stream::new(Seed(5), "edt");
        for i in 0..300 {
            let (w, h) = (1 + s.below(14), 1 + s.below(14));
            let max = Point2::new(w as f64, h as f64);
            let mut grid = Grid::empty(&Aabb { min: Point2::new(0.0, 0.0), max }, 1.0).unwrap();
            let mut cells = Vec::new();
            for row in 0..grid.rows() {
                for column in 0..grid.columns() {
                    if s.below(1 + i % 40) == 0 {
                        grid.set_occupied(column, row, true);
                        cells.push((i64::from(column), i64::from(row)));
                    }
                }
            }
            let transform = DistanceTransform::of(&grid);
            for row in 0..grid.rows() {
                for column in 0..grid.columns() {
                    let square = |&(c, r): &(i64, i64)| {
                        let (dx, dy) = (c - i64::from(column), r - i64::from(row));
                        (dx * dx + dy * dy) as u64
                    };
                    assert_eq!(transform.squared_cells(column, row), cells.iter().map(square).min());
                }
            }
        }
    }

    #[test]
    fn an_empty_grid_is_infinitely_far_from_everything() {
        let grid = Grid::empty(&World::lot().bounds, 0.5).unwrap();
        let transform = DistanceTransform::of(&grid);
        assert_eq!(transform.distance(3, 4), f64::INFINITY);
        assert_eq!(transform.squared_cells(1000, 0), Some(0));
    }

    #[test]
    fn agrees_with_the_exact_point_distance_within_half_a_diagonal_on_the_three_worlds() {
        for (world, resolution) in [(World::apartment(), 0.07), (World::workbench(), 0.05), (World::lot(), 0.13)] {
            let grid = Grid::rasterize(&world, resolution).unwrap();
            let transform = DistanceTransform::of(&grid);
            let half_diagonal = 0.5 * resolution * 2.0_f64.sqrt() + 1e-12;
            let mut farthest = 0.0;
            for row in 0..grid.rows() {
                for column in 0..grid.columns() {
                    let p = grid.centre(column, row);
                    let exact = point_distance(&world, p);
                    let derived = transform.distance(column, row);
                    assert!((derived - exact).abs() <= half_diagonal, "{}: {p} {derived} {exact}", world.name);
                    farthest = num::greater(farthest, exact);
                }
            }
            assert!(farthest > 0.5, "{}: the worlds have room in them", world.name);
        }
    }
}
