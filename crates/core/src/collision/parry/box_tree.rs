//! `BoxTree`, the bounding-volume tree over many pieces.

use std::cell::Cell;

use parry2d_f64::bounding_volume;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};

use crate::geometry::{Aabb, Point2, square};

/// parry's tree; it only prunes.
#[derive(Clone)]
pub(crate) struct BoxTree(Bvh);

impl BoxTree {
    /// The tree over boxes, known by their numbers.
    pub(crate) fn new(extents: &[Aabb]) -> Self {
        let vector = |p: Point2| Vector::new(p.x, p.y);
        let boxes: Vec<bounding_volume::Aabb> =
            extents.iter().map(|e| bounding_volume::Aabb::new(vector(e.min), vector(e.max))).collect();
        BoxTree(Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes))
    }

    /// Calls `look` with every box that may hold something no farther than the least distance so far, which `look`
    /// returns.
    pub(crate) fn nearest(&self, from: &Aabb, within: f64, mut look: impl FnMut(usize) -> f64) {
        let least = Cell::new(within);
        let look = std::cell::RefCell::new(&mut look);
        self.0.find_best(
            square(within),
            |node: &BvhNode, _| from.squared_distance(&extent(node)),
            |piece, _| {
                least.set(look.borrow_mut()(piece as usize));
                Some(square(least.get()))
            },
        );
        // A box's lower bound is below the distance of its piece, so every piece as near as the nearest was visited. At
        // distance 0 the bound is 0 too, and contacts may be missing: visit them all.
        if least.get() == 0.0 {
            self.each_near(from, 0.0, |piece| {
                look.borrow_mut()(piece);
                false
            });
        }
    }

    /// Calls `visit` with each box at most `range` away, until it returns true.
    pub(crate) fn each_near(&self, from: &Aabb, range: f64, mut visit: impl FnMut(usize) -> bool) {
        self.0.traverse(|node| {
            if from.squared_distance(&extent(node)) > range * range {
                return TraversalAction::Prune;
            }
            match node.leaf_data() {
                Some(piece) if visit(piece as usize) => TraversalAction::EarlyExit,
                _ => TraversalAction::Continue,
            }
        });
    }
}

fn extent(node: &BvhNode) -> Aabb {
    let (min, max) = (node.mins(), node.maxs());
    Aabb { min: Point2::new(min.x, min.y), max: Point2::new(max.x, max.y) }
}
