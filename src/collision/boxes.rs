//! `Boxes`, the boxes around a few shapes in structure-of-arrays order: looked at all at once.

use super::extent::{Extent, square};
use super::segments::LANES;
use crate::num::greater;

/// Axis-parallel boxes; the arrays are filled up to whole eights with boxes infinitely far away.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes {
    count: usize,
    x0: Vec<f64>,
    y0: Vec<f64>,
    x1: Vec<f64>,
    y1: Vec<f64>,
}

/// At most so many boxes are looked at all at once.
pub(super) const FEW: usize = 16;

impl Boxes {
    /// A few boxes, known by their numbers.
    pub(super) fn new(extents: &[Extent]) -> Self {
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

    /// [`Extent::squared_distance`] from a box to each.
    fn squared_distances<'a>(&self, from: &Extent, room: &'a mut [f64; FEW]) -> &'a [f64] {
        let sides = self.x0.iter().zip(&self.x1).zip(self.y0.iter().zip(&self.y1));
        for (square, ((x0, x1), (y0, y1))) in room.iter_mut().zip(sides) {
            let dx = greater(greater(x0 - from.max.x, from.min.x - x1), 0.0);
            let dy = greater(greater(y0 - from.max.y, from.min.y - y1), 0.0);
            *square = (dx * dx + dy * dy) * (1.0 - 1e-13);
        }
        &room[..self.count]
    }

    /// Calls `look`, which gives the least distance so far, with every box that may hold something as near as that; the
    /// nearest box first, because most others need not be looked at then.
    pub(super) fn nearest(&self, from: &Extent, within: f64, mut look: impl FnMut(usize) -> f64) {
        let mut room = [0.0; FEW];
        let squares = self.squared_distances(from, &mut room);
        let (mut first, mut nearest) = (usize::MAX, square(within));
        for (i, square) in squares.iter().enumerate() {
            if *square < nearest || (*square == nearest && first == usize::MAX) {
                (first, nearest) = (i, *square);
            }
        }
        if first == usize::MAX {
            return;
        }
        let mut least = square(look(first));
        for (i, distance) in squares.iter().enumerate() {
            if *distance <= least && i != first {
                least = square(look(i));
            }
        }
    }

    /// Calls `visit` with each box at most `range` away, until it returns true.
    pub(super) fn each_near(&self, from: &Extent, range: f64, mut visit: impl FnMut(usize) -> bool) {
        let mut room = [0.0; FEW];
        for (i, distance) in self.squared_distances(from, &mut room).iter().enumerate() {
            if *distance <= range * range && visit(i) {
                return;
            }
        }
    }
}
