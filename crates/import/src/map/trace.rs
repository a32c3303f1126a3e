//! Traces the borders of a grid's occupied cells as closed lines.

use motion_lab_core::worlds::Grid;

/// A corner of cells: the lower left one of the cell in this column and row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BorderCorner {
    /// The upright grid line it lies on, from the left.
    pub(crate) column: u32,
    /// The level grid line it lies on, from below.
    pub(crate) row: u32,
}

/// The direction in which a border runs, with the occupied cell on its left.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BorderDirection {
    East,
    North,
    West,
    South,
}

use BorderDirection::{East, North, South, West};

impl BorderDirection {
    fn left(self) -> BorderDirection {
        match self {
            East => North,
            North => West,
            West => South,
            South => East,
        }
    }

    fn right(self) -> BorderDirection {
        self.left().left().left()
    }

    fn step(self, from: BorderCorner) -> BorderCorner {
        let BorderCorner { column, row } = from;
        match self {
            East => BorderCorner { column: column + 1, row },
            North => BorderCorner { column, row: row + 1 },
            West => BorderCorner { column: column - 1, row },
            South => BorderCorner { column, row: row - 1 },
        }
    }

    /// The cells to the left and to the right of the edge ahead of a corner, as offsets from it.
    fn ahead(self) -> [(u32, u32); 2] {
        // a cell lies up and right of its own corner: 1 stands for the cell before it
        match self {
            East => [(0, 0), (0, 1)],
            North => [(1, 0), (0, 0)],
            West => [(1, 1), (1, 0)],
            South => [(0, 1), (1, 1)],
        }
    }
}

/// Traces every border between occupied cells and others as a closed line, given by the corners where it turns.
/// Occupied cells lie on its left, so outer borders run counter-clockwise. Everything outside the grid counts as free.
///
/// The lines are in the order of their lowest, leftmost edges. Cells that meet only in a corner have separate lines.
pub(crate) fn trace(grid: &Grid) -> Vec<Vec<BorderCorner>> {
    let (columns, rows) = (grid.columns(), grid.rows());
    let occupied = |at: BorderCorner, (dx, dy): (u32, u32)| match (at.column.checked_sub(dx), at.row.checked_sub(dy)) {
        (Some(column), Some(row)) => column < columns && row < rows && grid.is_occupied(column, row),
        _ => false,
    };
    let is_lower_border = |at: BorderCorner| occupied(at, (0, 0)) && !occupied(at, (0, 1));
    // every closed line runs east somewhere: below an occupied cell
    let mut traced = vec![false; columns as usize * rows as usize];
    let index = |at: BorderCorner| at.row as usize * columns as usize + at.column as usize;
    let mut lines = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let start = BorderCorner { column, row };
            if !is_lower_border(start) || traced[index(start)] {
                continue;
            }
            let (mut at, mut way) = (start, East);
            let mut corners = Vec::new();
            loop {
                if way == East {
                    traced[index(at)] = true;
                }
                at = way.step(at);
                let [left, right] = way.ahead().map(|cell| occupied(at, cell));
                let next = match (left, right) {
                    (false, _) => way.left(),
                    (true, false) => way,
                    (true, true) => way.right(),
                };
                if next != way {
                    corners.push(at);
                }
                way = next;
                if (at, way) == (start, East) {
                    break;
                }
            }
            // the walk ended at the corner where it began: the lowest, leftmost one comes first
            corners.rotate_right(1);
            lines.push(corners);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::Point2;
    use motion_lab_core::random::{Seed, Stream};

    /// A grid drawn with the highest row first; `#` is occupied.
    fn grid(drawing: &[&str]) -> Grid {
        let rows: Vec<Vec<bool>> = drawing.iter().rev().map(|r| r.chars().map(|c| c == '#').collect()).collect();
        Grid::of_cells(Point2::origin(), 1.0, rows[0].len() as u32, rows.len() as u32, rows.concat()).unwrap()
    }

    fn corners(at: &[(u32, u32)]) -> Vec<BorderCorner> {
        at.iter().map(|&(column, row)| BorderCorner { column, row }).collect()
    }

    #[test]
    fn a_ring_has_an_outer_line_to_the_left_and_an_inner_to_the_right() {
        let lines = trace(&grid(&["####", "#..#", "####"]));
        let (outer, inner) = ([(0, 0), (4, 0), (4, 3), (0, 3)], [(1, 2), (3, 2), (3, 1), (1, 1)]);
        assert_eq!(lines, [corners(&outer), corners(&inner)]);
    }

    #[test]
    fn straight_runs_are_one_edge_and_a_corner_joins_nothing() {
        assert_eq!(trace(&grid(&["#....", "#...#", "###.."])).len(), 2);
        let ell = trace(&grid(&["#..", "###"]));
        assert_eq!(ell, [corners(&[(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)])]);
        let diagonal = trace(&grid(&[".#", "#."]));
        let (low, high) = ([(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 1), (2, 1), (2, 2), (1, 2)]);
        assert_eq!(diagonal, [corners(&low), corners(&high)]);
        assert!(trace(&grid(&["..", ".."])).is_empty());
    }

    /// The lines of random grids are exactly the set of borders: every unit edge between an occupied cell and another
    /// once, and no other edge.
    #[test]
    fn every_border_is_in_exactly_one_line() {
        let mut s = Stream::new(Seed(7), "trace");
        for round in 0..300 {
            let (columns, rows) = (1 + s.below(9) as u32, 1 + s.below(9) as u32);
            let density = 1 + s.below(4);
            let cells: Vec<bool> = (0..columns * rows).map(|_| s.below(5) < density).collect();
            let grid = Grid::of_cells(Point2::origin(), 1.0, columns, rows, cells).unwrap();
            let mut units = Vec::new();
            for line in trace(&grid) {
                let line: Vec<(u32, u32)> = line.iter().map(|c| (c.column, c.row)).collect();
                for (i, &(x0, y0)) in line.iter().enumerate() {
                    let (x1, y1) = line[(i + 1) % line.len()];
                    assert!((x0 == x1) != (y0 == y1), "round {round}: edges run along the grid and have a length");
                    let (x2, _) = line[(i + 2) % line.len()];
                    assert!((x0 == x1) != (x1 == x2), "round {round}: neighbours are not in line");
                    for x in x0.min(x1)..x0.max(x1) {
                        units.push((x, y0, 'h'));
                    }
                    for y in y0.min(y1)..y0.max(y1) {
                        units.push((x0, y, 'v'));
                    }
                }
            }
            units.sort_unstable();
            let at = |x: i64, y: i64| {
                let inside = x >= 0 && y >= 0 && x < i64::from(columns) && y < i64::from(rows);
                inside && grid.is_occupied(x as u32, y as u32)
            };
            let mut borders = Vec::new();
            for x in 0..=i64::from(columns) {
                for y in 0..=i64::from(rows) {
                    if at(x, y) != at(x, y - 1) {
                        borders.push((x as u32, y as u32, 'h'));
                    }
                    if at(x, y) != at(x - 1, y) {
                        borders.push((x as u32, y as u32, 'v'));
                    }
                }
            }
            borders.sort_unstable();
            assert_eq!(units, borders, "round {round}");
        }
    }
}
