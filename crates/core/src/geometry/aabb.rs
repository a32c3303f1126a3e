//! `Aabb`, the axis-parallel box around something.

use super::Point2;
use crate::num::{greater, lesser};

/// An axis-parallel box, closed, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The corner with the least coordinates.
    pub min: Point2,
    /// The corner with the greatest coordinates.
    pub max: Point2,
}

impl Aabb {
    /// The box with these two corners.
    pub const fn new(min: Point2, max: Point2) -> Self {
        Aabb { min, max }
    }

    /// The smallest box around some points; `None` around none.
    pub fn around(points: &[Point2]) -> Option<Self> {
        let (first, rest) = points.split_first()?;
        let (mut min, mut max) = (*first, *first);
        for p in rest {
            (min.x, min.y) = (lesser(p.x, min.x), lesser(p.y, min.y));
            (max.x, max.y) = (greater(p.x, max.x), greater(p.y, max.y));
        }
        Some(Aabb { min, max })
    }

    /// The smallest box around both.
    #[must_use]
    pub fn merged(&self, other: &Aabb) -> Self {
        Aabb {
            min: Point2::new(lesser(self.min.x, other.min.x), lesser(self.min.y, other.min.y)),
            max: Point2::new(greater(self.max.x, other.max.x), greater(self.max.y, other.max.y)),
        }
    }

    /// The box with each side moved outward by `by` metres.
    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        let Aabb { min, max } = self;
        Aabb { min: Point2::new(min.x - by, min.y - by), max: Point2::new(max.x + by, max.y + by) }
    }

    /// The middle of the box.
    pub fn centre(&self) -> Point2 {
        self.min + (self.max - self.min) * 0.5
    }

    /// Whether a point lies in the box, whose sides belong to it.
    pub fn contains(&self, p: Point2) -> bool {
        (self.min.x..=self.max.x).contains(&p.x) && (self.min.y..=self.max.y).contains(&p.y)
    }

    /// Whether the two boxes have no point in common; boxes that touch have one.
    pub fn is_apart(&self, other: &Aabb) -> bool {
        self.max.x < other.min.x || other.max.x < self.min.x || self.max.y < other.min.y || other.max.y < self.min.y
    }

    /// The larger of 1 and the largest coordinate in size.
    pub(crate) fn size(&self) -> f64 {
        let Aabb { min, max } = self;
        [min.x, min.y, max.x, max.y].iter().fold(1.0, |m, x| greater(m, x.abs()))
    }

    /// A lower bound of the squared distance between what two boxes hold. It is rounded down by more than the
    /// arithmetic can have rounded up.
    #[inline]
    pub(crate) fn squared_distance(&self, other: &Aabb) -> f64 {
        let gap = |a0: f64, a1: f64, b0: f64, b1: f64| greater(greater(b0 - a1, a0 - b1), 0.0);
        let dx = gap(self.min.x, self.max.x, other.min.x, other.max.x);
        let dy = gap(self.min.y, self.max.y, other.min.y, other.max.y);
        (dx * dx + dy * dy) * (1.0 - 1e-13)
    }

    /// Whether `p` is farther from the box than the root of `square`; rounded.
    pub(crate) fn is_farther(&self, p: Point2, square: f64) -> bool {
        let dx = greater(greater(self.min.x - p.x, p.x - self.max.x), 0.0);
        let dy = greater(greater(self.min.y - p.y, p.y - self.max.y), 0.0);
        dx * dx + dy * dy > square
    }
}

/// The square of a distance for comparison with [`Aabb::squared_distance`]. Distances whose squares would underflow
/// share one square, so that none of them prunes.
#[inline]
pub(crate) fn square(distance: f64) -> f64 {
    if distance > 1e-100 { distance * distance } else { 1e-200 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_closed_and_hold_their_points() {
        let points = [Point2::new(1.0, -2.0), Point2::new(-3.0, 4.0), Point2::new(0.0, 0.0)];
        let around = Aabb::around(&points).unwrap();
        assert_eq!(around, Aabb::new(Point2::new(-3.0, -2.0), Point2::new(1.0, 4.0)));
        assert_eq!(around.centre(), Point2::new(-1.0, 1.0));
        assert_eq!(Aabb::around(&[]), None);
        assert!(points.iter().all(|p| around.contains(*p)) && !around.contains(Point2::new(1.000_000_1, 0.0)));
        assert!(!around.contains(Point2::new(0.0, -2.000_000_1)) && !around.contains(Point2::new(f64::NAN, 0.0)));
        let beside = |x: f64| Aabb::new(Point2::new(x, 0.0), Point2::new(x + 1.0, 1.0));
        assert!(!around.is_apart(&beside(1.0)) && !beside(1.0).is_apart(&around), "they touch");
        assert!(around.is_apart(&beside(1.000_000_1)) && beside(1.000_000_1).is_apart(&around));
        assert_eq!(around.merged(&beside(2.0)).max, Point2::new(3.0, 4.0));
        assert!(around.is_farther(Point2::new(4.0, 8.0), 24.9) && !around.is_farther(Point2::new(4.0, 8.0), 25.0));
    }
}
