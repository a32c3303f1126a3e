//! `Grid`, a world as occupied cells: derived from the world, never the other way round.

use crate::geometry::{Aabb, Point2};
use crate::num::greater;
use crate::worlds::{Obstacle, World};

/// Largest number of cells of a grid. They take 16 megabytes, and 128 more for a distance transform.
pub const MAX_CELLS: u64 = 1 << 24;

/// Why a grid can't be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A cell size that is not finite or not positive.
    #[error("a resolution of {0} m: it must be finite and positive")]
    Resolution(f64),
    /// More than `MAX_CELLS` cells.
    #[error("a resolution of {resolution} m gives more than {MAX_CELLS} cells for {width} x {height} m")]
    TooManyCells {
        /// The cell size asked for, metres.
        resolution: f64,
        /// The world's width, metres.
        width: f64,
        /// The world's height, metres.
        height: f64,
    },
}

/// Square cells over a world's bounds, each occupied or not.
///
/// Cell `(column, row)` is the closed square between the grid lines `column` and `column + 1`, `row` and `row + 1`;
/// line `k` lies at `origin + k * resolution`, rounded, so that neighbours share their line to the bit. Columns count
/// from the left, rows from below. The last column and row may reach beyond the bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    pub(crate) origin: Point2,
    resolution: f64,
    columns: u32,
    rows: u32,
    occupied: Vec<bool>,
}

impl Grid {
    /// The grid of a world with cells of `resolution` metres.
    ///
    /// A cell is occupied if its closed square meets an obstacle; touching counts. The grid is therefore conservative:
    /// every obstacle point within the bounds lies in an occupied cell. The test is exact for segments, boxes and
    /// polygons. For shapes with a radius it compares squared distances and errs, within rounding, towards occupied.
    /// Obstacles beyond the cells have no effect.
    ///
    /// # Errors
    /// [`GridError`] for a resolution that is not finite and positive, or so fine that there would be more than
    /// [`MAX_CELLS`] cells.
    ///
    /// ```
    /// use motion_lab_core::worlds::{Grid, World};
    /// use motion_lab_core::geometry::Point2;
    /// let grid = Grid::rasterize(&World::workbench(), 0.05).unwrap();
    /// let (column, row) = grid.cell_at(Point2::new(0.75, 1.25)).unwrap();
    /// assert!(grid.is_occupied(column, row)); // the block
    /// ```
    pub fn rasterize(world: &World, resolution: f64) -> Result<Grid, GridError> {
        let mut grid = Grid::empty(&world.bounds, resolution)?;
        let doors: Vec<Obstacle> = world.closed_doors().collect();
        for shape in world.obstacles.iter().chain(&doors).flat_map(|o| o.placed()) {
            grid.add(&shape);
        }
        Ok(grid)
    }

    /// The grid over these bounds with no cell occupied.
    ///
    /// # Errors
    /// As [`rasterize`](Self::rasterize).
    pub fn empty(bounds: &Aabb, resolution: f64) -> Result<Grid, GridError> {
        if !(resolution > 0.0 && resolution.is_finite()) {
            return Err(GridError::Resolution(resolution));
        }
        let (min, max) = (bounds.min, bounds.max);
        let (width, height) = (max.x - min.x, max.y - min.y);
        let too_many = GridError::TooManyCells { resolution, width, height };
        let columns = count(min.x, max.x, resolution).ok_or(too_many)?;
        let rows = count(min.y, max.y, resolution).ok_or(too_many)?;
        let cells = u64::from(columns) * u64::from(rows);
        if cells > MAX_CELLS {
            return Err(too_many);
        }
        Ok(Grid { origin: min, resolution, columns, rows, occupied: vec![false; cells as usize] })
    }

    /// Creates a grid from its cells, row after row from the lowest; `None` if there are none, or not `columns * rows`.
    pub fn of_cells(origin: Point2, resolution: f64, columns: u32, rows: u32, occupied: Vec<bool>) -> Option<Grid> {
        let fits = columns > 0 && rows > 0 && occupied.len() as u64 == u64::from(columns) * u64::from(rows);
        fits.then_some(Grid { origin, resolution, columns, rows, occupied })
    }

    /// The number of columns, at least 1.
    pub fn columns(&self) -> u32 {
        self.columns
    }

    /// The number of rows, at least 1.
    pub fn rows(&self) -> u32 {
        self.rows
    }

    /// The size of a cell, metres.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Whether a cell is occupied. A cell outside the grid is unknown and counts as occupied.
    pub fn is_occupied(&self, column: u32, row: u32) -> bool {
        self.index(column, row).is_none_or(|i| self.occupied[i])
    }

    /// Marks a cell as occupied or not. A cell outside the grid is ignored.
    pub fn set_occupied(&mut self, column: u32, row: u32, occupied: bool) {
        if let Some(i) = self.index(column, row) {
            self.occupied[i] = occupied;
        }
    }

    /// The closed square of a cell, in world coordinates.
    pub fn square(&self, column: u32, row: u32) -> Aabb {
        let max = self.corner(column.saturating_add(1), row.saturating_add(1));
        Aabb { min: self.corner(column, row), max }
    }

    /// The middle of a cell, in world coordinates.
    pub fn centre(&self, column: u32, row: u32) -> Point2 {
        let Aabb { min, max } = self.square(column, row);
        Point2::new(0.5 * (min.x + max.x), 0.5 * (min.y + max.y))
    }

    /// The cell that holds a point; `None` outside the grid. A point on a grid line belongs to the cell right of it or
    /// above it.
    pub fn cell_at(&self, p: Point2) -> Option<(u32, u32)> {
        let column = find(self.origin.x, self.resolution, self.columns, p.x)?;
        let row = find(self.origin.y, self.resolution, self.rows, p.y)?;
        Some((column, row))
    }

    /// Where the grid lines `column` and `row` cross.
    pub fn corner(&self, column: u32, row: u32) -> Point2 {
        Point2::new(line(self.origin.x, self.resolution, column), line(self.origin.y, self.resolution, row))
    }

    fn index(&self, column: u32, row: u32) -> Option<usize> {
        (column < self.columns && row < self.rows).then(|| row as usize * self.columns as usize + column as usize)
    }
}

/// Coordinate of grid line `k`, metres.
fn line(origin: f64, resolution: f64, k: u32) -> f64 {
    origin + f64::from(k) * resolution
}

/// The number of cells from `min` to `max`, at least 1; `None` if it exceeds `MAX_CELLS` or is NaN.
fn count(min: f64, max: f64, resolution: f64) -> Option<u32> {
    let quotient = ((max - min) / resolution).ceil();
    // the comparison fails for NaN, too
    let cells = Some(quotient).filter(|cells| *cells <= MAX_CELLS as f64)?;
    let mut n = greater(cells, 1.0) as u32;
    // the quotient is rounded: let the lines themselves decide
    while n > 1 && line(min, resolution, n - 1) >= max {
        n -= 1;
    }
    while line(min, resolution, n) < max {
        n += 1;
    }
    Some(n)
}

/// Index of the last cell whose first line is not beyond `x`; `None` outside the grid.
fn find(origin: f64, resolution: f64, n: u32, x: f64) -> Option<u32> {
    if !(x >= origin && x <= line(origin, resolution, n)) {
        return None;
    }
    let mut k = std::cmp::min(((x - origin) / resolution).floor() as u32, n - 1);
    while k > 0 && line(origin, resolution, k) > x {
        k -= 1;
    }
    while k + 1 < n && line(origin, resolution, k + 1) <= x {
        k += 1;
    }
    Some(k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lines_cover_the_bounds_and_no_more() {
        for resolution in [0.05, 0.1, 0.3, 1.0 / 3.0, 0.7, 5.0, 100.0] {
            let world = World::lot();
            let grid = Grid::empty(&world.bounds, resolution).unwrap();
            let (n, m) = (grid.columns(), grid.rows());
            let Aabb { min: start, max: last } = grid.square(n - 1, m - 1);
            assert!(last.x >= 16.0 && last.y >= 10.0, "{resolution}");
            assert!(start.x < 16.0 && start.y < 10.0, "{resolution}");
            for k in 0..n {
                let Aabb { min, max } = grid.square(k, 0);
                assert_eq!(grid.cell_at(min), Some((k, 0)), "a line belongs to the right cell");
                assert_eq!(grid.cell_at(Point2::new(0.5 * (min.x + max.x), 0.0)), Some((k, 0)));
            }
            assert_eq!(grid.cell_at(last), Some((n - 1, m - 1)));
            assert_eq!(grid.cell_at(Point2::new(-0.001, 1.0)), None);
            assert_eq!(grid.cell_at(Point2::new(f64::NAN, 1.0)), None);
            assert!(grid.is_occupied(n, 0) && grid.is_occupied(0, u32::MAX));
        }
    }

    #[test]
    fn a_quotient_that_rounds_up_adds_no_column() {
        // 2.1 / 0.3 is 7.000000000000001, but line 7 lies at 2.1
        let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(2.1, 4.2) };
        let grid = Grid::empty(&bounds, 0.3).unwrap();
        assert_eq!((grid.columns(), grid.rows()), (7, 14));
    }

    #[test]
    fn resolutions_out_of_range_are_refused() {
        let world = World::lot();
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Grid::rasterize(&world, bad), Err(GridError::Resolution(_))));
        }
        for fine in [1e-3, 1e-9, 1e-300, f64::MIN_POSITIVE] {
            assert!(matches!(Grid::rasterize(&world, fine), Err(GridError::TooManyCells { .. })));
        }
    }
}
