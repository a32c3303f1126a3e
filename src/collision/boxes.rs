//! `Boxes`, the boxes around a few shapes in structure-of-arrays order: looked at all at once instead of by a tree.

use super::segments::LANES;
use crate::geometry::Point2;
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

/// At most so many boxes are meant to be looked at all at once.
pub(super) const FEW: usize = 64;

impl Boxes {
    /// The boxes with these least and greatest corners.
    pub(super) fn new(corners: impl Iterator<Item = (Point2, Point2)>) -> Self {
        let mut boxes = Boxes::default();
        for (min, max) in corners {
            if boxes.count == boxes.x0.len() {
                for array in [&mut boxes.x0, &mut boxes.y0, &mut boxes.x1, &mut boxes.y1] {
                    array.extend([f64::INFINITY; LANES]);
                }
            }
            let i = boxes.count;
            (boxes.x0[i], boxes.y0[i], boxes.x1[i], boxes.y1[i]) = (min.x, min.y, max.x, max.y);
            boxes.count += 1;
        }
        boxes
    }

    /// Whether there are no more boxes than are looked at all at once.
    pub(super) fn are_few(&self) -> bool {
        self.count <= FEW
    }

    /// Lower bounds of the squared distances from the box with these corners to each box, rounded down by more than the
    /// arithmetic can have rounded up; of a few boxes.
    pub(super) fn squared_distances<'a>(&self, min: Point2, max: Point2, room: &'a mut [f64; FEW]) -> &'a [f64] {
        let sides = self.x0.iter().zip(&self.x1).zip(self.y0.iter().zip(&self.y1));
        for (square, ((x0, x1), (y0, y1))) in room.iter_mut().zip(sides) {
            let dx = greater(greater(x0 - max.x, min.x - x1), 0.0);
            let dy = greater(greater(y0 - max.y, min.y - y1), 0.0);
            *square = (dx * dx + dy * dy) * (1.0 - 1e-14);
        }
        &room[..self.count.min(FEW)]
    }
}
