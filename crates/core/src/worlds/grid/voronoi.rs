//! The generalised Voronoi diagram of a grid, beside its distance transform.

use super::distance_transform::{Envelope, NONE};
use crate::worlds::Grid;

/// Stands for no occupied cell.
const NOWHERE: u32 = u32::MAX;

/// The generalised Voronoi diagram of a grid: the cells that are as far from two obstacle points, where these are the
/// nearest ones and lie apart. Whoever stays on it keeps as far from everything as there is room.
///
/// It is the integer medial axis of Hesselink and Roerdink ("Euclidean skeletons of digital image and volume data in
/// linear time by the integer medial axis transform", 2008), pruned by a constant, from the nearest occupied cell of
/// every cell, which is exact.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiDiagram {
    columns: u32,
    rows: u32,
    /// The number of the nearest occupied cell, row by row.
    nearest: Vec<u32>,
    is_on: Vec<bool>,
}

impl VoronoiDiagram {
    /// The diagram of a grid. Two obstacle points count as two where their cells are more than `apart` metres apart,
    /// and more than one cell. With 0 every bend of a wall has its branch; with a robot's diameter only ways on which
    /// it fits between two points have.
    pub fn of(grid: &Grid, apart: f64) -> Self {
        let (columns, rows) = (grid.columns(), grid.rows());
        let nearest = nearest(grid);
        let mut is_on = vec![false; nearest.len()];
        let width = columns as usize;
        let cells = apart / grid.resolution();
        let at = |index: usize| [(index % width) as i64, (index / width) as i64];
        for p in 0..nearest.len() {
            let [column, row] = at(p);
            let right = (column + 1 < i64::from(columns)).then_some(p + 1);
            let above = (row + 1 < i64::from(rows)).then_some(p + width);
            for q in [right, above].into_iter().flatten() {
                let is_free = |i: usize| nearest[i] != NOWHERE && nearest[i] as usize != i;
                if !is_free(p) || !is_free(q) {
                    continue;
                }
                let (a, b) = (at(nearest[p] as usize), at(nearest[q] as usize));
                let squared = |u: [i64; 2], v: [i64; 2]| (u[0] - v[0]) * (u[0] - v[0]) + (u[1] - v[1]) * (u[1] - v[1]);
                let between = squared(a, b) as f64;
                if between <= 1.0 || between <= cells * cells {
                    continue;
                }
                // twice the middle of the two cells: where it is nearer to the other's point, the border lies between
                // the middle and the cell
                let ends = [at(p), at(q)];
                let middle = [0, 1].map(|i| ends[0][i] + ends[1][i]);
                let [to_a, to_b] = [a, b].map(|site| squared(middle, site.map(|x| 2 * x)));
                is_on[p] |= to_b <= to_a;
                is_on[q] |= to_a <= to_b;
            }
        }
        VoronoiDiagram { columns, rows, nearest, is_on }
    }

    /// Whether a cell lies on the diagram. No occupied cell does, and none outside the grid, where nothing is known.
    pub fn is_on(&self, column: u32, row: u32) -> bool {
        self.index(column, row).is_some_and(|i| self.is_on[i])
    }

    /// The occupied cell nearest to a cell, its column and row; one of them where several are. `None` where no cell is
    /// occupied, and outside the grid.
    pub fn nearest(&self, column: u32, row: u32) -> Option<[u32; 2]> {
        let nearest = self.nearest[self.index(column, row)?];
        (nearest != NOWHERE).then_some([nearest % self.columns, nearest / self.columns])
    }

    fn index(&self, column: u32, row: u32) -> Option<usize> {
        (column < self.columns && row < self.rows).then(|| row as usize * self.columns as usize + column as usize)
    }
}

/// The number of the occupied cell nearest to each cell.
fn nearest(grid: &Grid) -> Vec<u32> {
    let (width, height) = (grid.columns() as usize, grid.rows() as usize);
    let (mut squared, mut sites) = (vec![NONE; width * height], vec![NOWHERE; width * height]);
    let mut envelope = Envelope::default();
    let mut line = Vec::new();
    for column in 0..grid.columns() {
        line.clear();
        line.extend((0..grid.rows()).map(|row| if grid.is_occupied(column, row) { 0 } else { NONE }));
        envelope.transform(&mut line, |row, from| {
            sites[row * width + column as usize] = (from * width) as u32 + column;
        });
        for (row, d) in line.iter().enumerate() {
            squared[row * width + column as usize] = *d;
        }
    }
    for (row, sites) in squared.chunks_exact_mut(width).zip(sites.chunks_exact_mut(width)) {
        let of_column = sites.to_vec();
        envelope.transform(row, |column, from| sites[column] = of_column[from]);
    }
    sites
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Aabb, Point2};
    use crate::num::sqrt;
    use crate::random::{Seed, Stream};

    /// A grid of cells of half a metre.
    fn grid(columns: u32, rows: u32, occupied: impl Fn(u32, u32) -> bool) -> Grid {
        let max = Point2::new(0.5 * f64::from(columns), 0.5 * f64::from(rows));
        let mut grid = Grid::empty(&Aabb { min: Point2::origin(), max }, 0.5).unwrap();
        for (column, row) in cells(&grid) {
            grid.set_occupied(column, row, occupied(column, row));
        }
        grid
    }

    fn cells(grid: &Grid) -> Vec<(u32, u32)> {
        (0..grid.rows()).flat_map(|row| (0..grid.columns()).map(move |column| (column, row))).collect()
    }

    #[test]
    fn a_corridor_has_its_middle() {
        let corridor = grid(12, 9, |_, row| row == 0 || row == 8);
        let diagram = VoronoiDiagram::of(&corridor, 0.0);
        for (column, row) in cells(&corridor) {
            assert_eq!(diagram.is_on(column, row), row == 4, "{column}, {row}");
        }
        assert_eq!((diagram.nearest(3, 1), diagram.nearest(3, 7)), (Some([3, 0]), Some([3, 8])));
        // its walls are 8 cells of half a metre apart
        let on = |apart: f64| VoronoiDiagram::of(&corridor, apart).is_on(5, 4);
        assert!(on(3.9) && !on(4.1));
        assert!(!diagram.is_on(12, 4) && diagram.nearest(12, 4).is_none(), "outside the grid");
        let empty = VoronoiDiagram::of(&grid(4, 4, |_, _| false), 0.0);
        assert!(empty.nearest(1, 1).is_none() && !empty.is_on(1, 1));
    }

    /// By looking at every occupied cell: a cell on the diagram is as far from two of them that lie apart, to a cell's
    /// side, and of two neighbours with one nearest cell each, which lie apart, one is on it.
    #[test]
    fn it_is_where_two_points_that_lie_apart_are_as_near() {
        let mut draws = Stream::new(Seed(5), "voronoi");
        let (mut on, mut borders) = (0, 0);
        for _ in 0..60 {
            let seeds: Vec<(u32, u32)> =
                (0..2 + draws.below(8)).map(|_| (draws.below(24) as u32, draws.below(20) as u32)).collect();
            let grid = grid(24, 20, |column, row| seeds.contains(&(column, row)));
            let apart = 0.5 * draws.uniform(1.0, 8.0);
            let diagram = VoronoiDiagram::of(&grid, apart);
            let distance = |p: (u32, u32), q: (u32, u32)| {
                let (dx, dy) = (f64::from(p.0) - f64::from(q.0), f64::from(p.1) - f64::from(q.1));
                0.5 * sqrt(dx * dx + dy * dy)
            };
            let least = |p: (u32, u32)| seeds.iter().map(|s| distance(p, *s)).fold(f64::INFINITY, crate::num::lesser);
            for p in cells(&grid) {
                let [column, row] = diagram.nearest(p.0, p.1).unwrap();
                assert_eq!(distance(p, (column, row)), least(p), "{p:?}");
                if diagram.is_on(p.0, p.1) {
                    on += 1;
                    let is_border = |s: &&(u32, u32)| {
                        distance(p, **s) <= least(p) + 0.5 + 1e-9 && distance((column, row), **s) > apart
                    };
                    assert!(seeds.iter().any(|s| is_border(&s)) && !seeds.contains(&p), "{p:?} of {seeds:?}");
                }
                let only = |p: (u32, u32)| {
                    let mut near = seeds.iter().filter(|s| distance(p, **s) == least(p));
                    let first = *near.next().unwrap();
                    near.all(|s| *s == first).then_some(first)
                };
                for q in [(p.0 + 1, p.1), (p.0, p.1 + 1)].into_iter().filter(|q| q.0 < 24 && q.1 < 20) {
                    let Some((a, b)) = only(p).zip(only(q)) else { continue };
                    if distance(a, b) > apart && distance(a, b) > 0.5 && !seeds.contains(&p) && !seeds.contains(&q) {
                        borders += 1;
                        assert!(diagram.is_on(p.0, p.1) || diagram.is_on(q.0, q.1), "{p:?} {q:?} of {seeds:?}");
                    }
                }
            }
        }
        assert!(on > 500 && borders > 500, "{on} {borders}");
    }
}
