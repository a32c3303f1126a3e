//! `Aabb`, the axis-parallel box around something: what searches prune by.

use super::{Placed, Point2};
use crate::num::{greater, lesser, ulp};

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub(crate) min: Point2,
    pub(crate) max: Point2,
}

impl Aabb {
    /// The box around a placed shape, a little larger, so that rounding prunes nothing. All of the plane for a shape that is
    /// not valid.
    pub(crate) fn of(shape: &Placed) -> Self {
        if !shape.is_valid() {
            return Aabb { min: Point2::new(-1e200, -1e200), max: Point2::new(1e200, 1e200) };
        }
        Self::of_valid(shape)
    }

    /// As [`of`](Self::of), of a shape known to be valid.
    #[inline]
    pub(crate) fn of_valid(shape: &Placed) -> Self {
        let (min, max) = shape.bounds();
        Aabb { min, max }.grown(64.0 * ulp(Aabb { min, max }.size()))
    }

    /// The larger of 1 and the largest coordinate in size.
    pub(crate) fn size(&self) -> f64 {
        let Aabb { min, max } = self;
        [min.x, min.y, max.x, max.y].iter().fold(1.0, |m, x| greater(m, x.abs()))
    }

    /// The box with each side moved outward.
    pub(crate) fn grown(&self, by: f64) -> Self {
        let Aabb { min, max } = self;
        Aabb { min: Point2::new(min.x - by, min.y - by), max: Point2::new(max.x + by, max.y + by) }
    }

    /// The box around both.
    pub(crate) fn merged(&self, other: &Aabb) -> Self {
        Aabb {
            min: Point2::new(lesser(self.min.x, other.min.x), lesser(self.min.y, other.min.y)),
            max: Point2::new(greater(self.max.x, other.max.x), greater(self.max.y, other.max.y)),
        }
    }

    /// A lower bound of the squared distance between what two boxes hold: rounded down by more than the arithmetic can have
    /// rounded up.
    #[inline]
    pub(crate) fn squared_distance(&self, other: &Aabb) -> f64 {
        let gap = |a0: f64, a1: f64, b0: f64, b1: f64| greater(greater(b0 - a1, a0 - b1), 0.0);
        let dx = gap(self.min.x, self.max.x, other.min.x, other.max.x);
        let dy = gap(self.min.y, self.max.y, other.min.y, other.max.y);
        (dx * dx + dy * dy) * (1.0 - 1e-13)
    }
}

/// The square of a distance for comparison with [`Aabb::squared_distance`]: no square that underflows is told from another, so
/// none of them prunes.
#[inline]
pub(crate) fn square(distance: f64) -> f64 {
    if distance > 1e-100 { distance * distance } else { 1e-200 }
}
