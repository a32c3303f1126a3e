//! `Bearings`, where the cells about a sensor's own lie, ring by ring.

use std::sync::LazyLock;

use super::ready::turns;
use crate::num::{greater, lesser};

/// A cell by how many columns and rows it is off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) i: i64,
    pub(super) j: i64,
    /// In which of 64 sectors of the world it may lie, wherever in its own cell the sensor is.
    pub(super) sectors: u64,
    /// No point of it is nearer than this many cells, squared.
    pub(super) near: f64,
}

/// Cells up to so many rings off are listed.
pub(super) const LISTED: i64 = 40;

/// More than the errors of the bearings, in turns.
const SLACK: f64 = 1e-5;

/// The listed cells, ring by ring.
static CELLS: LazyLock<Vec<Cell>> = LazyLock::new(|| (0..=LISTED).flat_map(around).map(Cell::off).collect());

/// The cells of a ring by how many columns and rows they are off.
fn around(ring: i64) -> impl Iterator<Item = (i64, i64)> {
    (-ring..=ring).flat_map(move |j| {
        let step = if j.abs() == ring { 1 } else { 2 * ring as usize };
        (-ring..=ring).step_by(step.max(1)).map(move |i| (i, j))
    })
}

/// The cells of a ring up to [`LISTED`], in no particular order.
pub(super) fn ring(number: i64) -> &'static [Cell] {
    let before = |ring: i64| (if ring > 0 { (2 * ring - 1) * (2 * ring - 1) } else { 0 }) as usize;
    CELLS.get(before(number)..before(number + 1)).unwrap_or_default()
}

/// The sectors of the world between two bearings in turns from -1 on, the second less than a turn from the first.
fn sectors_between(begin: f64, end: f64) -> u64 {
    let (first, last) = ((64.0 * (begin + 1.0)) as u32, (64.0 * (end + 1.0)) as u32);
    let more = last.saturating_sub(first).min(63);
    (u64::MAX >> (63 - more)).rotate_left(first % 64)
}

impl Cell {
    fn off((i, j): (i64, i64)) -> Self {
        let apart = |n: i64| (n.abs() - 1).max(0) as f64 * (1.0 - 1e-9);
        let near = apart(i) * apart(i) + apart(j) * apart(j);
        Cell { i, j, sectors: sectors(i as f64, j as f64), near }
    }
}

/// Seen from anywhere in its own cell, a cell lies in a box of twice its size.
fn sectors(i: f64, j: f64) -> u64 {
    if i.abs() < 1.5 && j.abs() < 1.5 {
        return u64::MAX;
    }
    let middle = turns(i, j);
    let off = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
        let d = turns(i + x, j + y) - middle;
        if d > 0.5 {
            d - 1.0
        } else if d < -0.5 {
            d + 1.0
        } else {
            d
        }
    });
    let (least, most) = (off.into_iter().fold(0.0, lesser), off.into_iter().fold(0.0, greater));
    sectors_between(middle + least - SLACK, middle + most + SLACK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::sin_cos;
    use crate::random::{Seed, Stream};

    #[test]
    fn every_line_of_sight_into_a_cell_is_in_its_sectors_and_no_shorter_than_said() {
        let mut draws = Stream::new(Seed(1), "bearings");
        for cell in (0..=LISTED).flat_map(ring) {
            for _ in 0..20 {
                let mut from = || draws.uniform(0.0, 1.0);
                let (x, y) = (cell.i as f64 + from() - from(), cell.j as f64 + from() - from());
                assert!(x * x + y * y >= cell.near, "{cell:?} {x} {y}");
                // the sector as a wedge between two directions, not by the bearing that is judged
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

    #[test]
    fn a_ring_holds_the_cells_so_many_columns_or_rows_off() {
        for number in 0..=LISTED {
            let cells = ring(number);
            assert_eq!(cells.len() as i64, (8 * number).max(1));
            assert!(cells.iter().all(|c| c.i.abs().max(c.j.abs()) == number));
        }
    }
}
