//! Marks the cells of a grid that a shape meets.

use crate::geometry::{Aabb, Placed, Point2, Segment, orientation};
use crate::num::{self, greater, lesser};
use crate::worlds::Grid;

impl Grid {
    /// Marks every cell whose closed square meets the shape as occupied.
    pub(crate) fn add(&mut self, shape: &Placed) {
        let Aabb { min: lo, max: hi } = shape.bounds();
        for row in self.span(self.origin.y, self.rows(), lo.y, hi.y) {
            let Aabb { min, max } = self.square(0, row);
            let Some((left, right)) = extent(shape, min.y, max.y) else { continue };
            for column in self.span(self.origin.x, self.columns(), left, right) {
                if !self.is_occupied(column, row) && meets(shape, self.square(column, row)) {
                    self.set_occupied(column, row, true);
                }
            }
        }
    }

    /// The cells along one axis that may meet `[lo, hi]`, with one more at either end against rounding.
    fn span(&self, origin: f64, n: u32, lo: f64, hi: f64) -> std::ops::Range<u32> {
        // `as` saturates: below 0 becomes 0, beyond the range its end
        let first = ((lo - origin) / self.resolution() - 1.0).floor() as u32;
        let last = ((hi - origin) / self.resolution() + 2.0).floor() as u32;
        first..std::cmp::min(last, n)
    }
}

/// The least and greatest x, up to rounding, of a shape within the strip `bottom <= y <= top`; `None` if the shape
/// misses the strip.
fn extent(shape: &Placed, bottom: f64, top: f64) -> Option<(f64, f64)> {
    // a nanometre more, against rounding
    let r = shape.radius() + 1e-9;
    let (bottom, top) = (bottom - r, top + r);
    let core = shape.core();
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut widen = |x: f64| (left, right) = (lesser(x, left), greater(x, right));
    for (i, &a) in core.iter().enumerate() {
        let b = core[(i + 1) % core.len()];
        if a.y >= bottom && a.y <= top {
            widen(a.x);
        }
        for y in [bottom, top] {
            if (a.y < y) != (b.y < y) {
                widen(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
            }
        }
    }
    (left <= right).then_some((left - r, right + r))
}

/// Whether a shape meets a closed square.
fn meets(shape: &Placed, square: Aabb) -> bool {
    let Aabb { min, max } = square;
    let core = shape.core();
    let corners = [min, Point2::new(max.x, min.y), max, Point2::new(min.x, max.y)];
    let r = shape.radius();
    let cores_meet = core_meets(core, &corners);
    if r == 0.0 || cores_meet {
        return cores_meet;
    }
    // When core and square are apart, one of the two nearest points is a vertex: of the core, or of the square.
    let to_square = |p: &Point2| {
        let dx = greater(0.0, greater(min.x - p.x, p.x - max.x));
        let dy = greater(0.0, greater(min.y - p.y, p.y - max.y));
        dx * dx + dy * dy
    };
    let edges = || (0..core.len()).map(|i| Segment::new(core[i], core[(i + 1) % core.len()]));
    let to_core =
        |p: &Point2| edges().map(|e| (e.closest_point(*p) - p).norm_squared()).fold(f64::INFINITY, |m, d| lesser(d, m));
    // A few ulps of the largest number involved, so that rounding errs to occupied.
    let scale = [min.x, min.y, max.x, max.y, r].iter().fold(1.0, |m, x| greater(m, x.abs()));
    let reach = r + 8.0 * num::ulp(scale);
    core.iter().any(|p| to_square(p) <= reach * reach) || corners.iter().any(|p| to_core(p) <= reach * reach)
}

/// Whether a convex core and a square have a point in common, exactly. Two convex polygons are apart exactly if an edge
/// of one has the other strictly on its outer side. A core that is a segment has two outer sides.
fn core_meets(core: &[Point2], corners: &[Point2; 4]) -> bool {
    let (min, max) = (corners[0], corners[2]);
    let beside = core.iter().all(|p| p.x < min.x)
        || core.iter().all(|p| p.x > max.x)
        || core.iter().all(|p| p.y < min.y)
        || core.iter().all(|p| p.y > max.y);
    let outside = |i: usize| {
        let (a, b) = (core[i], core[(i + 1) % core.len()]);
        corners.iter().all(|&c| orientation(a, b, c) < 0.0)
    };
    // a segment is walked both ways, which tests both its sides; a single point has no edge
    let beyond_an_edge = core.len() > 1 && (0..core.len()).any(outside);
    !(beside || beyond_an_edge)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose2, Shape, convex_hull};
    use crate::random::{Seed, Stream};

    fn bounds(x: f64, y: f64) -> Aabb {
        Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(x, y) }
    }

    fn occupied(grid: &Grid) -> Vec<(u32, u32)> {
        let cells = (0..grid.rows()).flat_map(|row| (0..grid.columns()).map(move |column| (column, row)));
        cells.filter(|&(column, row)| grid.is_occupied(column, row)).collect()
    }

    #[test]
    fn touching_counts_and_the_next_cell_does_not() {
        let mut grid = Grid::empty(&bounds(4.0, 4.0), 1.0).unwrap();
        // on the line between columns 0 and 1, ending in a corner of four cells
        grid.add(&Shape::Segment { a: Point2::new(1.0, 0.5), b: Point2::new(1.0, 1.0) }.place(&Pose2::IDENTITY));
        assert_eq!(occupied(&grid), [(0, 0), (1, 0), (0, 1), (1, 1)]);
        let mut grid = Grid::empty(&bounds(4.0, 4.0), 1.0).unwrap();
        // a disc that touches the cells above and below, left and right in one point each
        grid.add(&Shape::Disc { radius: 0.5 }.place(&Pose2::new(1.5, 1.5, 0.0)));
        assert_eq!(occupied(&grid), [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2)]);
        let mut grid = Grid::empty(&bounds(4.0, 4.0), 1.0).unwrap();
        // a diagonal through corners also touches the cells on both its sides
        grid.add(&Shape::Segment { a: Point2::new(1.25, 1.25), b: Point2::new(2.75, 2.75) }.place(&Pose2::IDENTITY));
        assert_eq!(occupied(&grid), [(1, 1), (2, 1), (1, 2), (2, 2)]);
    }

    #[test]
    fn rasterizing_row_by_row_finds_the_cells_that_testing_each_cell_finds() {
        let mut s = Stream::new(Seed(4), "raster");
        for i in 0..600 {
            let mut point = || Point2::new(s.below(64) as f64 / 8.0 - 1.0, s.below(64) as f64 / 8.0 - 1.0);
            let (a, b, c) = (point(), point(), point());
            let shape = match i % 4 {
                0 => Shape::Segment { a, b },
                1 => Shape::Hull { vertices: convex_hull(&[a, b, c])[..].into(), radius: 0.0 },
                2 => Shape::Hull { vertices: convex_hull(&[a, b, c])[..].into(), radius: 0.375 },
                _ => Shape::Capsule { a, b, radius: 0.7 },
            };
            let placed = shape.place(&Pose2::IDENTITY);
            let mut grid = Grid::empty(&bounds(6.0, 5.0), 0.25).unwrap();
            grid.add(&placed);
            for row in 0..grid.rows() {
                for column in 0..grid.columns() {
                    let all = meets(&placed, grid.square(column, row));
                    assert_eq!(grid.is_occupied(column, row), all, "{shape:?} ({column}, {row})");
                    // an oracle for plain cores: a sampled point of the shape within the square
                    if shape.radius() == 0.0 && !all {
                        let Aabb { min, max } = grid.square(column, row);
                        let inside = |p: Point2| p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
                        for k in 0..=16 {
                            let t = f64::from(k) / 16.0;
                            let p = a + (b - a) * t; // exact in sixteenths of an eighth
                            let q = if i % 4 == 1 { p + (c - p) * 0.5 } else { p };
                            assert!(!inside(p) && !inside(q));
                        }
                    }
                }
            }
        }
    }
}
