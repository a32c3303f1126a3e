//! The sectors and the distances of the grid's cells about a sensor's own cell, ring by ring.

use std::sync::LazyLock;

use super::wedges::turns;
use crate::geometry::{Point2, Vector2};
use crate::num::{greater, lesser};

/// A cell, by its offset from the sensor's cell: `i` columns and `j` rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellOffset {
    pub(super) i: i64,
    pub(super) j: i64,
    /// The sectors of the world, a bit for each of 64, in which it may lie, wherever the sensor is in one quarter of
    /// its own cell.
    pub(super) sectors: u64,
    /// A lower bound on the square of its distance from the sensor, in cells.
    pub(super) near: f64,
}

/// The last ring whose cells are listed.
pub(super) const LISTED: i64 = 24;

/// An upper bound on the errors of the bearings, in turns.
const BEARING_ERROR: f64 = 1e-5;

/// The listed cells, ring by ring, as seen from each quarter of the sensor's cell.
static CELLS: LazyLock<[Vec<CellOffset>; 4]> = LazyLock::new(|| {
    [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)].map(|(x, y)| {
        let quarter = Point2::new(x, y);
        (0..=LISTED).flat_map(around).map(|(i, j)| CellOffset::seen(quarter, i, j)).collect()
    })
});

/// The cells of a ring, as offsets in columns and rows.
fn around(ring: i64) -> impl Iterator<Item = (i64, i64)> {
    (-ring..=ring).flat_map(move |j| {
        let step = if j.abs() == ring { 1 } else { 2 * ring as usize };
        (-ring..=ring).step_by(step.max(1)).map(move |i| (i, j))
    })
}

/// The cells of a ring up to [`LISTED`], in no particular order, as seen from one quarter of the sensor's cell: the
/// right or the left one, the upper or the lower one.
pub(super) fn ring(number: i64, right: bool, up: bool) -> &'static [CellOffset] {
    let before = |ring: i64| (if ring > 0 { (2 * ring - 1) * (2 * ring - 1) } else { 0 }) as usize;
    let seen = &CELLS[usize::from(right) + 2 * usize::from(up)];
    seen.get(before(number)..before(number + 1)).unwrap_or_default()
}

/// The sectors of the world between two bearings, a bit each. The bearings are in turns and at least -1, the second
/// less than a turn from the first.
fn sectors_between(begin: f64, end: f64) -> u64 {
    let (first, last) = ((64.0 * (begin + 1.0)) as u32, (64.0 * (end + 1.0)) as u32);
    let more = last.saturating_sub(first).min(63);
    (u64::MAX >> (63 - more)).rotate_left(first % 64)
}

/// How far a cell and a quarter of the sensor's cell together reach from their middles, in cells: 0.5 + 0.25.
const REACH: f64 = 0.75;

impl CellOffset {
    /// The cell with the offset `i`, `j`, as seen from anywhere in the quarter of the sensor's cell with this middle.
    /// Seen so, it lies in a box that reaches [`REACH`] from its own middle. Lengths are in cells.
    fn seen(quarter: Point2, i: i64, j: i64) -> Self {
        let middle = Vector2::new(i as f64 + 0.5 - quarter.x, j as f64 + 0.5 - quarter.y);
        let apart = |x: f64| greater(x.abs() - REACH, 0.0) * (1.0 - 1e-9);
        let (across, along) = (apart(middle.x), apart(middle.y));
        CellOffset { i, j, sectors: sectors(middle), near: across * across + along * along }
    }
}

/// The sectors in which the box about this point that reaches [`REACH`] to each side may lie, a bit each. The point is
/// given from the sensor, in cells.
fn sectors(point: Vector2) -> u64 {
    let (x, y) = (point.x, point.y);
    if lesser(REACH - x.abs(), REACH - y.abs()) > -1e-9 {
        return u64::MAX; // the sensor may be in it
    }
    let middle = turns(x, y);
    let off = [(-REACH, -REACH), (REACH, -REACH), (REACH, REACH), (-REACH, REACH)].map(|(dx, dy)| {
        let d = turns(x + dx, y + dy) - middle;
        if d > 0.5 {
            d - 1.0
        } else if d < -0.5 {
            d + 1.0
        } else {
            d
        }
    });
    let (least, most) = (off.into_iter().fold(0.0, lesser), off.into_iter().fold(0.0, greater));
    sectors_between(middle + least - BEARING_ERROR, middle + most + BEARING_ERROR)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::sin_cos;
    use crate::random::{Seed, Stream};

    #[test]
    fn every_line_of_sight_into_a_cell_is_in_its_sectors_and_no_shorter_than_said() {
        let mut draws = Stream::new(Seed(1), "bearings");
        for (cell, right, up) in quarters() {
            for _ in 0..10 {
                let from = |more: bool, draws: &mut Stream| 0.5 * (f64::from(u8::from(more)) + draws.uniform(0.0, 1.0));
                let x = cell.i as f64 + draws.uniform(0.0, 1.0) - from(right, &mut draws);
                let y = cell.j as f64 + draws.uniform(0.0, 1.0) - from(up, &mut draws);
                assert!(x * x + y * y >= cell.near, "{cell:?} {x} {y}");
                // the sector as a wedge between two directions, without the bearing that is under test
                let sector = (0..64).find(|&s| {
                    let edge = |s: u32| sin_cos(std::f64::consts::TAU * f64::from(s) / 64.0);
                    let ((s0, c0), (s1, c1)) = (edge(s), edge(s + 1));
                    c0 * y - s0 * x >= 0.0 && x * s1 - y * c1 >= 0.0
                });
                let sector = sector.unwrap();
                assert!(cell.sectors & (1 << sector) != 0, "{cell:?} {x} {y} {sector}");
            }
        }
    }

    fn quarters() -> impl Iterator<Item = (&'static CellOffset, bool, bool)> {
        let all = |right, up| (0..=LISTED).flat_map(move |n| ring(n, right, up)).map(move |cell| (cell, right, up));
        all(false, false).chain(all(true, false)).chain(all(false, true)).chain(all(true, true))
    }

    #[test]
    fn a_ring_holds_the_cells_so_many_columns_or_rows_off() {
        for number in 0..=LISTED {
            let cells = ring(number, true, false);
            assert_eq!(cells.len() as i64, (8 * number).max(1));
            assert!(cells.iter().all(|c| c.i.abs().max(c.j.abs()) == number));
        }
    }
}
