//! `Index`, the boxes of a scene's pieces in the structure that suits their number and spread.

use super::super::parry::box_tree::BoxTree;
use super::grid::PieceGrid;
use super::linear::{Boxes, FEW};
use crate::geometry::Aabb;

/// The boxes around pieces, known by their numbers.
#[derive(Clone)]
pub struct Index(BoxStructure);

/// A few side by side, many in a grid, or under a tree where no grid fits them; in layers where some came later.
#[derive(Clone)]
enum BoxStructure {
    Few(Boxes),
    Grid(PieceGrid),
    Tree(BoxTree),
    Layers(IndexLayers),
}

/// Indices of pieces that follow one another by their numbers, and which pieces are gone.
#[derive(Clone)]
struct IndexLayers {
    layers: Vec<IndexLayer>,
    gone: Vec<bool>,
}

/// An index with the number of its first piece.
#[derive(Clone)]
struct IndexLayer {
    first: usize,
    index: Index,
}

impl Index {
    /// The index of these boxes.
    pub fn new(extents: &[Aabb]) -> Self {
        if extents.len() <= FEW {
            return Index(BoxStructure::Few(Boxes::new(extents)));
        }
        Index(PieceGrid::new(extents).map_or_else(|| BoxStructure::Tree(BoxTree::new(extents)), BoxStructure::Grid))
    }

    /// Calls `look` with every piece that may be as near as the least distance so far, which `look` returns, until no
    /// other can be. `within` is the least distance before the first call.
    pub fn nearest(&self, from: &Aabb, within: f64, mut look: impl FnMut(usize) -> f64) {
        match &self.0 {
            BoxStructure::Few(boxes) => boxes.nearest(from, within, look),
            BoxStructure::Grid(grid) => grid.nearest(from, within, look),
            rare => rare.nearest(from, within, &mut look),
        }
    }

    /// Calls `visit` with each piece whose box is at most `range` from this box, until it returns true.
    pub fn each_near(&self, from: &Aabb, range: f64, mut visit: impl FnMut(usize) -> bool) {
        match &self.0 {
            BoxStructure::Few(boxes) => boxes.each_near(from, range, visit),
            BoxStructure::Grid(grid) => grid.each_near(from, range, visit),
            rare => rare.each_near(from, range, &mut visit),
        }
    }

    /// Makes the boxes of the pieces from number `first` on these. Those before stay as they are.
    pub(crate) fn put_from(&mut self, first: usize, extents: &[Aabb]) {
        self.change(|layers| {
            layers.layers.retain(|layer| layer.first < first);
            layers.layers.push(IndexLayer { first, index: Index::new(extents) });
        });
    }

    /// Takes a piece away. Its number stays unused.
    pub(crate) fn forget(&mut self, piece: usize) {
        self.change(|layers| {
            layers.gone.resize(layers.gone.len().max(piece + 1), false);
            layers.gone[piece] = true;
        });
    }

    /// Changes its layers, of which it is the first where it had none.
    fn change(&mut self, change: impl FnOnce(&mut IndexLayers)) {
        let mut layers = match std::mem::replace(&mut self.0, BoxStructure::Few(Boxes::default())) {
            BoxStructure::Layers(layers) => layers,
            only => IndexLayers { layers: vec![IndexLayer { first: 0, index: Index(only) }], gone: Vec::new() },
        };
        change(&mut layers);
        self.0 = BoxStructure::Layers(layers);
    }
}

/// The same walks, compiled once for all questions: a tree and layers, which few scenes have, take no code of their own
/// in each.
impl BoxStructure {
    fn nearest(&self, from: &Aabb, within: f64, look: &mut dyn FnMut(usize) -> f64) {
        match self {
            BoxStructure::Few(boxes) => boxes.nearest(from, within, look),
            BoxStructure::Grid(grid) => grid.nearest(from, within, look),
            BoxStructure::Tree(tree) => tree.nearest(from, within, look),
            BoxStructure::Layers(layers) => layers.nearest(from, within, look),
        }
    }

    fn each_near(&self, from: &Aabb, range: f64, visit: &mut dyn FnMut(usize) -> bool) {
        match self {
            BoxStructure::Few(boxes) => boxes.each_near(from, range, visit),
            BoxStructure::Grid(grid) => grid.each_near(from, range, visit),
            BoxStructure::Tree(tree) => tree.each_near(from, range, visit),
            BoxStructure::Layers(layers) => layers.each_near(from, range, visit),
        }
    }
}

impl IndexLayers {
    fn nearest(&self, from: &Aabb, within: f64, look: &mut dyn FnMut(usize) -> f64) {
        let mut least = within;
        for IndexLayer { first, index } in &self.layers {
            index.0.nearest(from, least, &mut |piece| {
                if !self.is_gone(first + piece) {
                    least = look(first + piece);
                }
                least
            });
        }
    }

    fn each_near(&self, from: &Aabb, range: f64, visit: &mut dyn FnMut(usize) -> bool) {
        let mut found = false;
        for IndexLayer { first, index } in &self.layers {
            index.0.each_near(from, range, &mut |piece| {
                found = found || (!self.is_gone(first + piece) && visit(first + piece));
                found
            });
            if found {
                return;
            }
        }
    }

    fn is_gone(&self, piece: usize) -> bool {
        self.gone.get(piece).is_some_and(|gone| *gone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::num::{greater, lesser, sqrt};
    use crate::random::{Seed, Stream};

    fn extent(x: f64, y: f64, w: f64, h: f64) -> Aabb {
        Aabb { min: Point2::new(x, y), max: Point2::new(x + w, y + h) }
    }

    /// Boxes on a lattice, their corners in a square of side `spread` metres, so that many touch and lie on the sides
    /// of cells.
    fn boxes(count: usize, spread: u64, draws: &mut Stream) -> Vec<Aabb> {
        let mut lattice = |n: u64| draws.below(n) as f64;
        (0..count).map(|_| extent(lattice(spread), lattice(spread), lattice(3), lattice(3))).collect()
    }

    #[test]
    fn every_kind_of_index_finds_the_same() {
        let mut draws = Stream::new(Seed(5), "index");
        for (count, spread, grid) in
            [(40, 9, false), (64, 20, false), (300, 30, true), (300, 2000, true), (300, 6, false)]
        {
            let extents = boxes(count, spread, &mut draws);
            let index = Index::new(&extents);
            assert_eq!(matches!(index.0, BoxStructure::Grid(_)), grid, "{count} in {spread}");
            let tree = Index(BoxStructure::Tree(BoxTree::new(&extents)));
            // layers, one of which takes the place of others, and a piece that is gone beside each
            let there = |piece: &usize| piece % 7 != 3;
            let mut layers = Index::new(&extents[..count / 2]);
            for (first, end) in [(count / 2, count / 2 + 5), (count / 2 + 5, count), (count / 2 + 5, count)] {
                layers.put_from(first, &extents[first..end]);
            }
            (0..count).filter(|piece| !there(piece)).for_each(|piece| layers.forget(piece));
            for _ in 0..300 {
                let side = 2.0 * spread as f64;
                let (x, y) = (draws.uniform(-side, side), draws.uniform(-side, side));
                let from = extent(x.round(), y.round(), draws.below(4) as f64, 0.0);
                let exact = |piece: usize| sqrt(from.squared_distance(&extents[piece]));
                let of_all = (0..count).map(exact).fold(f64::INFINITY, lesser);
                let of_those_there = (0..count).filter(there).map(exact).fold(f64::INFINITY, lesser);
                for within in [f64::INFINITY, 1.0, 0.0] {
                    for (index, all) in [(&index, of_all), (&tree, of_all), (&layers, of_those_there)] {
                        let mut least = within;
                        index.nearest(&from, within, |piece| {
                            least = lesser(exact(piece), least);
                            least
                        });
                        assert_eq!(least, lesser(all, within), "{from:?}");
                    }
                }
                let range = draws.below(3) as f64;
                let near: Vec<usize> = (0..count).filter(|&p| exact(p) <= greater(range, 0.0)).collect();
                let near_there: Vec<usize> = near.iter().copied().filter(there).collect();
                for (index, near) in [(&index, &near), (&tree, &near), (&layers, &near_there)] {
                    let mut seen = Vec::new();
                    index.each_near(&from, range, |piece| {
                        seen.push(piece);
                        false
                    });
                    seen.sort_unstable();
                    assert_eq!(&seen, near, "once each: {from:?} {range}");
                }
            }
        }
    }
}
