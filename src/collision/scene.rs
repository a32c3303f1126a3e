//! `Scene`, named obstacles under one index.

use std::sync::Arc;

use super::ObstacleId;
use super::boundary::grid::Cells;
use super::boundary::segments::SegmentSoup;
use super::broad::index::Index;
use super::motion::time_of_impact::{arc_distance, arc_meets, translation_meets};
use super::narrow::distance::{Nearest, depth};
use super::narrow::nearest::Search;
use super::narrow::pair::{pair, touch};
use crate::geometry::{Aabb, CircularArc, Footprint, Placed, Pose2, Segment, Shape, largest_coordinate};
use crate::num::{greater, lesser};
use crate::worlds::{Bounds, World};

/// From so many segments and discs on, a scan walks through a grid.
const MANY: usize = 128;

/// Named obstacles under one index: a few side by side, many in a grid or under a bounding-volume tree.
///
/// ```
/// use motion_lab::prelude::*;
/// use motion_lab::collision::{Collision, Scene};
/// let wall = Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))]);
/// let rusty = Footprint::disc(Point2::new(2.0, 1.0), 0.11);
/// assert!((wall.distance(&rusty) - 0.89).abs() < 1e-12);
/// ```
#[derive(Clone)]
pub struct Scene {
    bounds: Bounds,
    names: Vec<Arc<str>>,
    /// All convex pieces in file order, and the obstacle that each belongs to.
    pub(super) pieces: Vec<Placed>,
    pub(super) owners: Vec<u32>,
    soup: SegmentSoup,
    /// Of a large scene.
    cells: Option<Cells>,
    pub(super) index: Index,
    /// No coordinate of a piece is larger; infinite where a piece is not valid.
    pub(super) size: f64,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scene").field("bounds", &self.bounds).field("obstacles", &self.names).finish_non_exhaustive()
    }
}

impl Scene {
    /// A scene without obstacles. The bounds are not an obstacle.
    pub fn empty(bounds: Bounds) -> Self {
        Self::of_pieces(bounds, Vec::new(), Vec::new(), Vec::new())
    }

    /// The scene with one more obstacle, given in world coordinates. Builds the tree anew; for many obstacles at once use
    /// [`of_world`](Self::of_world).
    ///
    /// A shape that breaks its constructor's rules counts as contact with everything.
    #[must_use]
    pub fn with_obstacle(self, name: &str, shape: Shape) -> Self {
        self.with_obstacle_at(name, Pose2::IDENTITY, shape)
    }

    /// As [`with_obstacle`](Self::with_obstacle), with the shape given in the frame `pose`: a disc's centre is the frame's
    /// origin.
    #[must_use]
    pub fn with_obstacle_at(mut self, name: &str, pose: Pose2, shape: Shape) -> Self {
        let owner = self.names.len() as u32;
        self.names.push(name.into());
        self.pieces.push(shape.place(&pose));
        self.owners.push(owner);
        Self::of_pieces(self.bounds, self.names, self.pieces, self.owners)
    }

    /// A scene of walls, named `wall 0`, `wall 1`, ..; its bounds are the box around them.
    pub fn of_walls(walls: &[Segment]) -> Self {
        let pieces: Vec<Placed> =
            walls.iter().map(|s| Shape::Segment { a: s.a, b: s.b }.place(&Pose2::IDENTITY)).collect();
        let names = (0..walls.len()).map(|i| format!("wall {i}").into()).collect();
        let bounds = pieces.iter().map(Placed::bounds).reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1)));
        let bounds =
            bounds.map_or(Bounds { min: [0.0; 2].into(), max: [0.0; 2].into() }, |(min, max)| Bounds { min, max });
        Self::of_pieces(bounds, names, pieces, (0..walls.len() as u32).collect())
    }

    /// The obstacles of a world, in file order.
    pub fn of_world(world: &World) -> Self {
        let (mut names, mut pieces, mut owners) = (Vec::new(), Vec::new(), Vec::new());
        for (owner, obstacle) in world.obstacles.iter().enumerate() {
            names.push(obstacle.name.as_str().into());
            for (pose, shape) in &obstacle.pieces {
                pieces.push(shape.place(pose));
                owners.push(owner as u32);
            }
        }
        Self::of_pieces(world.bounds, names, pieces, owners)
    }

    /// The Apartment.
    pub fn apartment() -> Self {
        Self::of_world(&World::apartment())
    }

    /// The Workbench.
    pub fn workbench() -> Self {
        Self::of_world(&World::workbench())
    }

    /// The Lot.
    pub fn lot() -> Self {
        Self::of_world(&World::lot())
    }

    fn of_pieces(bounds: Bounds, names: Vec<Arc<str>>, pieces: Vec<Placed>, owners: Vec<u32>) -> Self {
        let extents: Vec<Aabb> = pieces.iter().map(Aabb::of).collect();
        let soup = SegmentSoup::of_pieces(&pieces);
        let many = soup.segments().len() + soup.circles().len() > MANY;
        let cells = if many { Cells::new(&soup) } else { None };
        let valid = pieces.iter().all(Placed::is_valid);
        let size = if valid { largest_coordinate(&pieces) } else { f64::INFINITY };
        Scene { bounds, names, pieces, owners, soup, cells, index: Index::new(&extents), size }
    }

    /// The part of the plane the scene shows; not an obstacle.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The number of obstacles.
    pub fn obstacle_count(&self) -> usize {
        self.names.len()
    }

    /// The name of an obstacle; `None` for an id that is not one of this scene's.
    pub fn obstacle_name(&self, id: ObstacleId) -> Option<&str> {
        self.names.get(id.0 as usize).map(|name| &**name)
    }

    /// The convex pieces of all obstacles in file order, each with its obstacle.
    pub fn pieces(&self) -> impl Iterator<Item = (ObstacleId, &Placed)> {
        self.owners.iter().map(|&owner| ObstacleId(owner)).zip(&self.pieces)
    }

    /// The obstacles' boundary as segments and discs, for rays.
    pub(crate) fn soup(&self) -> &SegmentSoup {
        &self.soup
    }

    /// Every obstacle that the footprint overlaps or touches, in file order: none exactly when
    /// [`intersects`](super::Collision::intersects) is false, and for a footprint that is not finite, which touches nothing in particular.
    pub fn touched(&self, footprint: &Footprint) -> Vec<ObstacleId> {
        let mut touched = std::collections::BTreeSet::new();
        if footprint.is_valid() {
            for part in footprint.parts() {
                self.each_within(part.placed(), 0.0, |piece| {
                    if pair(part.placed(), &self.pieces[piece]).dist == 0.0 {
                        touched.insert(ObstacleId(self.owners[piece]));
                    }
                    false
                });
            }
        }
        touched.into_iter().collect()
    }

    /// The grid over the boundary of a large scene.
    pub(crate) fn cells(&self) -> Option<&Cells> {
        self.cells.as_ref()
    }

    /// Whether the point, a disc of radius 0, is inside an obstacle or on one; true for a point that is not valid.
    pub(crate) fn holds(&self, point: &Placed) -> bool {
        if !point.is_valid() {
            return true;
        }
        let mut found = false;
        self.each_within(point, 0.0, |piece| {
            found = touch(point, &self.pieces[piece]);
            found
        });
        found
    }

    /// A lower bound on how far the footprint must move to become free, metres: no displacement that moves every point by
    /// less can free it. 0 when it is free; infinity for a footprint that is not finite.
    pub fn depth(&self, footprint: &Footprint) -> f64 {
        if !footprint.is_valid() {
            return f64::INFINITY;
        }
        let mut bound = 0.0;
        for part in footprint.parts() {
            self.each_within(part.placed(), 0.0, |piece| {
                bound = greater(depth(part.placed(), &self.pieces[piece]), bound);
                false
            });
        }
        bound
    }

    /// A search for the piece nearest to `shape`, if any is nearer than `within`.
    pub(super) fn search<'a>(&'a self, shape: &'a Placed, within: f64) -> Search<'a> {
        Search::new(shape, &self.pieces, self.size, within)
    }

    /// The nearest piece to `shape`, the first in file order among equals, if any is nearer than `within`.
    pub(super) fn nearest_piece(&self, shape: &Placed, within: f64) -> Option<(usize, Nearest)> {
        let mut search = self.search(shape, within);
        self.index.nearest(&search.extent(), within, |piece| search.look(piece));
        search.found()
    }

    /// When a footprint that goes from `start` to `end` without turning first touches a piece, as a part of its way; rounded.
    pub(super) fn translation_meets(&self, start: &Footprint, end: &Footprint) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (a, b) in start.parts().iter().zip(end.parts()) {
            let (a, b) = (a.placed(), b.placed());
            let v = b.core()[0] - a.core()[0];
            self.index.each_near(&Aabb::of(a).merged(&Aabb::of(b)), 0.0, |piece| {
                if let Some(s) = translation_meets(a, v, &self.pieces[piece]) {
                    first = Some(first.map_or(s, |f| lesser(s, f)));
                }
                false
            });
        }
        first
    }

    /// When a disc of this radius whose centre runs along the arc first touches a piece; rounded.
    pub(super) fn arc_meets(&self, arc: &CircularArc, radius: f64) -> Option<f64> {
        let mut first: Option<f64> = None;
        self.index.each_near(&arc_box(arc, radius), 0.0, |piece| {
            let piece = &self.pieces[piece];
            if let Some(s) = arc_meets(arc, piece.core(), radius + piece.radius()) {
                first = Some(first.map_or(s, |f| lesser(s, f)));
            }
            false
        });
        first
    }

    /// The least clearance of a disc of this radius whose centre runs along the arc as far as `until`, metres; rounded. It is
    /// not positive in contact, and infinity in an empty scene.
    pub(super) fn arc_clearance(&self, arc: &CircularArc, until: f64, radius: f64) -> f64 {
        let mut least = f64::INFINITY;
        self.index.nearest(&arc_box(arc, 0.0), least, |piece| {
            let piece = &self.pieces[piece];
            least = lesser(arc_distance(arc, until, piece.core()) - piece.radius(), least);
            least
        });
        least - radius
    }

    /// Calls `visit` with each piece whose box is at most `range` from the shape's box, until it returns true.
    pub(super) fn each_within(&self, shape: &Placed, range: f64, visit: impl FnMut(usize) -> bool) {
        self.index.each_near(&Aabb::of(shape), range, visit);
    }
}

/// A box around what a disc of this radius touches along the arc: every point of it is at most half its length from one end.
fn arc_box(arc: &CircularArc, radius: f64) -> Aabb {
    let grown = radius + lesser(0.5 * arc.length(), 2.0 * arc.radius);
    let ends = [arc.at(0.0), arc.at(1.0)].map(|p| Placed::new([p], grown));
    Aabb::of(&ends[0]).merged(&Aabb::of(&ends[1]))
}
