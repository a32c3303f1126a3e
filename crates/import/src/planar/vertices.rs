//! `VertexPool`, points that are never closer together than the smallest feature of a world.

use std::collections::BTreeMap;

use motion_lab_core::geometry::{MIN_FEATURE, Point2};
use motion_lab_core::num;

/// Points at least [`MIN_FEATURE`] apart, found by place.
#[derive(Default)]
pub(super) struct VertexPool {
    pub points: Vec<Point2>,
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

impl VertexPool {
    /// The index of the point at `p`, or of the first one closer to it than the smallest feature; otherwise of a new
    /// one. No coordinate of `p` may be larger than [`MAX_PLANAR_COORDINATE`](super::extent::MAX_PLANAR_COORDINATE).
    pub fn vertex(&mut self, p: Point2) -> usize {
        let cell = |x: f64| (x / MIN_FEATURE).floor() as i64;
        let (column, row) = (cell(p.x), cell(p.y));
        let is_near = |q: Point2| num::hypot(p.x - q.x, p.y - q.y) < MIN_FEATURE;
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| (column + i, row + j)));
        let near = around.filter_map(|key| self.cells.get(&key)).flatten();
        if let Some(found) = near.copied().filter(|&v| is_near(self.points[v])).min() {
            return found;
        }
        self.points.push(p);
        self.cells.entry((column, row)).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_closer_than_a_millimetre_are_one() {
        let mut pool = VertexPool::default();
        let at = |x: f64, y: f64| Point2::new(x, y);
        assert_eq!((pool.vertex(at(0.0, 0.0)), pool.vertex(at(0.0, 0.001))), (0, 1));
        // across the borders of cells, on both sides of zero
        assert_eq!((pool.vertex(at(-0.0009, 0.0)), pool.vertex(at(-0.0006, -0.0006))), (0, 0));
        assert_eq!((pool.vertex(at(-0.0008, -0.0007)), pool.points.len()), (2, 3));
    }
}
