//! `Boxes`, the boxes around a few shapes in structure-of-arrays order: measured all at once.

use crate::collision::boundary::segments::LANES;
use crate::geometry::{Aabb, square};
use crate::num::{greater, lesser};

/// Axis-parallel boxes; the arrays are padded to a multiple of eight with boxes infinitely far away.
#[derive(Clone, Debug, Default)]
pub(crate) struct Boxes {
    count: usize,
    x0: Vec<f64>,
    y0: Vec<f64>,
    x1: Vec<f64>,
    y1: Vec<f64>,
}

/// Largest number of boxes that are measured all at once.
pub(crate) const FEW: usize = 64;

impl Boxes {
    /// The first `FEW` of these boxes, known by their numbers.
    pub(crate) fn new(extents: &[Aabb]) -> Self {
        let mut boxes = Boxes { count: extents.len().min(FEW), ..Boxes::default() };
        let room = boxes.count.next_multiple_of(LANES);
        for array in [&mut boxes.x0, &mut boxes.y0, &mut boxes.x1, &mut boxes.y1] {
            array.resize(room, f64::INFINITY);
        }
        for (i, e) in extents.iter().enumerate().take(FEW) {
            (boxes.x0[i], boxes.y0[i], boxes.x1[i], boxes.y1[i]) = (e.min.x, e.min.y, e.max.x, e.max.y);
        }
        boxes
    }

    fn sides(&self) -> [&[f64]; 4] {
        [&self.x0, &self.y0, &self.x1, &self.y1]
    }

    /// Passes the squared distances of all boxes, and the least of them, to `work`.
    fn measured(&self, from: &Aabb, work: impl FnOnce(&[f64], f64)) {
        // the shorter array where it is long enough
        let (mut few, mut many);
        let squares: &mut [f64] = if self.count <= LANES {
            few = [f64::INFINITY; LANES];
            &mut few
        } else {
            many = [f64::INFINITY; FEW];
            &mut many
        };
        let least = squared_distances(self.sides(), from, squares);
        work(&squares[..self.count], least);
    }

    /// Calls `look` with every box that may hold something no farther than the least distance so far, which `look`
    /// returns. The nearest box comes first, because most others can then be passed over.
    pub(crate) fn nearest(&self, from: &Aabb, within: f64, mut look: impl FnMut(usize) -> f64) {
        self.measured(from, |squares, nearest| {
            if nearest > square(within) || squares.is_empty() {
                return;
            }
            let first = squares.iter().position(|s| *s == nearest).unwrap_or(0);
            let mut least = square(look(first));
            for (i, distance) in squares.iter().enumerate() {
                if *distance <= least && i != first {
                    least = square(look(i));
                }
            }
        });
    }

    /// Calls `visit` with each box at most `range` away, until it returns true.
    pub(crate) fn each_near(&self, from: &Aabb, range: f64, mut visit: impl FnMut(usize) -> bool) {
        self.measured(from, |squares, nearest| {
            if nearest <= range * range {
                let mut near = squares.iter().enumerate().filter(|(_, distance)| **distance <= range * range);
                near.any(|(i, _)| visit(i));
            }
        });
    }
}

/// Writes the [`Aabb::squared_distance`] from a box to each of the others, and returns the least of them.
#[cfg_attr(
    not(baseline),
    multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
)]
fn squared_distances([x0, y0, x1, y1]: [&[f64]; 4], from: &Aabb, squares: &mut [f64]) -> f64 {
    let Aabb { min, max } = *from;
    let mut least = [f64::INFINITY; LANES];
    let blocks = x0.as_chunks().0.iter().zip(y0.as_chunks().0).zip(x1.as_chunks().0.iter().zip(y1.as_chunks().0));
    for (((x0, y0), (x1, y1)), squares) in blocks.zip(squares.as_chunks_mut::<LANES>().0) {
        let (x0, y0, x1, y1): (&[f64; LANES], &[f64; LANES], &[f64; LANES], &[f64; LANES]) = (x0, y0, x1, y1);
        for i in 0..LANES {
            let dx = greater(greater(x0[i] - max.x, min.x - x1[i]), 0.0);
            let dy = greater(greater(y0[i] - max.y, min.y - y1[i]), 0.0);
            squares[i] = (dx * dx + dy * dy) * (1.0 - 1e-13);
            least[i] = lesser(squares[i], least[i]);
        }
    }
    least.into_iter().fold(f64::INFINITY, lesser)
}
