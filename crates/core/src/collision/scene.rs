//! `Scene`, named obstacles under one index.

use std::ops::Range;
use std::sync::Arc;

use super::boundary::scene_boundary::SceneBoundary;
use super::broad::frames::Frames;
use super::broad::index::Index;
use super::layers::SceneLayers;
use super::motion::lanes::outlines::PieceOutlines;
use super::narrow::convex::NearestPoints;
use super::narrow::distance::depth;
use super::narrow::nearest::{NearestSearch, PieceList};
use super::narrow::pair::{pair, touch};
use super::{ObstacleId, Overlap};
use crate::geometry::{Aabb, Footprint, Placed, Point2, Pose2, Segment, Shape, Vertices, largest_coordinate};
use crate::worlds::{Obstacle, World};

/// Named obstacles under one index: a few side by side, many in a grid or under a bounding-volume tree.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::collision::{Collision, Scene};
/// let wall = Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))]);
/// let rusty = Footprint::disc(Point2::new(2.0, 1.0), 0.11);
/// assert!((wall.distance(&rusty) - 0.89).abs() < 1e-12);
/// ```
#[derive(Clone)]
pub struct Scene {
    pub(super) bounds: Aabb,
    /// The obstacles in file order.
    pub(super) obstacles: Vec<SceneObstacle>,
    /// The convex pieces: those of an obstacle after one another, the obstacles in file order. What was put into the
    /// scene later comes last, and what was taken out is still there.
    pub(super) pieces: Vec<Placed>,
    /// The number of the obstacle that each piece belongs to; [`GONE`] for a piece that is not there any more.
    pub(super) owners: Vec<u32>,
    /// The boundary of the pieces that the scene was made of.
    pub(super) boundary: SceneBoundary,
    pub(super) index: Index,
    /// The pieces' turned boxes; `None` in a large scene.
    pub(super) frames: Option<Frames>,
    /// The pieces in single precision; `None` where they are too large for it, or one is not convex or not valid.
    pub(super) outlines: Option<PieceOutlines>,
    /// An upper bound on the size of the pieces' coordinates, metres; infinite where a piece is not valid.
    pub(super) size: f64,
    /// What has changed since the scene was made; `None` where nothing has.
    pub(super) layers: Option<Box<SceneLayers>>,
}

/// The owner of a piece that is not there any more.
pub(super) const GONE: u32 = u32::MAX;

/// An obstacle of a scene.
#[derive(Clone, Debug)]
pub(super) struct SceneObstacle {
    pub(super) name: Arc<str>,
    /// The number of its first piece.
    pub(super) first: u32,
    /// How many pieces it has.
    pub(super) count: u32,
}

impl SceneObstacle {
    /// The numbers of its pieces.
    pub(super) fn pieces(&self) -> Range<usize> {
        let first = self.first as usize;
        first..first + self.count as usize
    }
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names: Vec<&str> = self.obstacles.iter().map(|obstacle| &*obstacle.name).collect();
        f.debug_struct("Scene").field("bounds", &self.bounds).field("obstacles", &names).finish_non_exhaustive()
    }
}

impl Scene {
    /// A scene without obstacles. The bounds are not an obstacle.
    pub fn empty(bounds: Aabb) -> Self {
        Self::of_pieces(bounds, Vec::new(), Vec::new(), Vec::new())
    }

    /// The scene with one more obstacle, given in world coordinates. Rebuilds the index; for many obstacles at once use
    /// [`of_world`](Self::of_world), for one after another [`insert_obstacle`](Self::insert_obstacle).
    ///
    /// A shape that breaks its constructor's rules counts as contact with everything.
    #[must_use]
    pub fn with_obstacle(self, name: &str, shape: Shape) -> Self {
        self.with_obstacle_at(name, Pose2::IDENTITY, shape)
    }

    /// As [`with_obstacle`](Self::with_obstacle), with the shape given in the frame `pose`: a disc's centre is the
    /// frame's origin.
    #[must_use]
    pub fn with_obstacle_at(mut self, name: &str, pose: Pose2, shape: Shape) -> Self {
        self.list(self.obstacles.len(), name.into(), vec![shape.place(&pose)]);
        self.made_of(Placed::clone)
    }

    /// A scene of walls, named `wall 0`, `wall 1`, ..; its bounds are the box around them.
    pub fn of_walls(walls: &[Segment]) -> Self {
        let pieces: Vec<Placed> =
            walls.iter().map(|s| Shape::Segment { a: s.a, b: s.b }.place(&Pose2::IDENTITY)).collect();
        let names = (0..walls.len()).map(|i| format!("wall {i}").into()).collect();
        let bounds = pieces.iter().map(Placed::bounds).reduce(|a, b| a.merged(&b));
        let bounds = bounds.unwrap_or(Aabb::new(Point2::origin(), Point2::origin()));
        Self::of_pieces(bounds, names, pieces, (0..walls.len() as u32).collect())
    }

    /// The obstacles of a world, in file order, then its closed doors.
    pub fn of_world(world: &World) -> Self {
        let doors: Vec<Obstacle> = world.closed_doors().collect();
        Self::of_obstacles(world.bounds, world.obstacles.iter().chain(&doors))
    }

    /// These obstacles, in their order. The bounds are not an obstacle.
    pub fn of_obstacles<'a>(bounds: Aabb, obstacles: impl IntoIterator<Item = &'a Obstacle>) -> Self {
        let (mut names, mut pieces, mut owners) = (Vec::new(), Vec::new(), Vec::new());
        for (owner, obstacle) in obstacles.into_iter().enumerate() {
            names.push(obstacle.name.as_str().into());
            pieces.extend(obstacle.placed());
            owners.resize(pieces.len(), owner as u32);
        }
        Self::of_pieces(bounds, names, pieces, owners)
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

    /// The scene whose obstacles are larger by a distance all round, metres. What is free there has a clearance of more
    /// than that here, but for the rounding of the radii. The bounds stay. An obstacle that was not valid still is not;
    /// nor is any where the distance is not finite, or takes more than the obstacle's radius away.
    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        self.made_of(|piece| Placed::new(Vertices::from_slice(piece.core()), piece.radius() + by))
    }

    /// A scene made of this one's obstacles, with their pieces changed.
    pub(super) fn made_of(&self, piece: impl Fn(&Placed) -> Placed) -> Self {
        let names = self.obstacles.iter().map(|obstacle| Arc::clone(&obstacle.name)).collect();
        let (owners, pieces) = self.pieces().map(|(owner, own)| (owner.0, piece(own))).unzip();
        Self::of_pieces(self.bounds, names, pieces, owners)
    }

    fn of_pieces(bounds: Aabb, names: Vec<Arc<str>>, pieces: Vec<Placed>, owners: Vec<u32>) -> Self {
        let extents: Vec<Aabb> = pieces.iter().map(Placed::padded_bounds).collect();
        let mut obstacles: Vec<SceneObstacle> =
            names.into_iter().map(|name| SceneObstacle { name, first: 0, count: 0 }).collect();
        for (piece, owner) in owners.iter().enumerate() {
            let obstacle = &mut obstacles[*owner as usize];
            obstacle.first = piece as u32 - obstacle.count;
            obstacle.count += 1;
        }
        let boundary = SceneBoundary::new(&pieces);
        let valid = pieces.iter().all(Placed::is_valid);
        let size = if valid { largest_coordinate(&pieces) } else { f64::INFINITY };
        let (index, frames, outlines) = (Index::new(&extents), Frames::new(&pieces), PieceOutlines::new(&pieces, size));
        Scene { bounds, obstacles, pieces, owners, boundary, index, frames, outlines, size, layers: None }
    }

    /// The part of the plane the scene shows; not an obstacle.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The number of obstacles.
    pub fn obstacle_count(&self) -> usize {
        self.obstacles.len()
    }

    /// The name of an obstacle; `None` for an id that is not one of this scene's.
    pub fn obstacle_name(&self, id: ObstacleId) -> Option<&str> {
        self.obstacles.get(id.0 as usize).map(|obstacle| &*obstacle.name)
    }

    /// The convex pieces of all obstacles in file order, each with its obstacle.
    pub fn pieces(&self) -> impl Iterator<Item = (ObstacleId, &Placed)> {
        let pieces = |(number, obstacle): (usize, &SceneObstacle)| {
            let id = ObstacleId(number as u32);
            self.pieces[obstacle.pieces()].iter().map(move |piece| (id, piece))
        };
        self.obstacles.iter().enumerate().flat_map(pieces)
    }

    /// The boundary, for rays, of what the scene was made of.
    pub(crate) fn boundary(&self) -> &SceneBoundary {
        &self.boundary
    }

    /// The boundaries of what was put into the scene later.
    pub(crate) fn later_boundaries(&self) -> &[SceneBoundary] {
        self.layers.as_ref().map_or(&[], |layers| layers.boundaries())
    }

    /// The obstacles that the footprint overlaps or touches, in file order. Empty exactly when
    /// [`intersects`](super::Collision::intersects) is false or the footprint is not finite: such a footprint is in
    /// contact, but with no obstacle in particular.
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

    /// The same scene, which lists nothing.
    #[cfg(test)]
    pub(crate) fn without_lists(&self) -> Self {
        Scene { boundary: SceneBoundary::without_lists(&self.pieces), ..self.clone() }
    }

    /// Whether a shape, such as a point or a line, touches an obstacle; true for a shape that is not valid.
    pub(crate) fn holds(&self, shape: &Placed) -> bool {
        if !shape.is_valid() {
            return true;
        }
        let mut found = false;
        self.each_within(shape, 0.0, |piece| {
            found = touch(shape, &self.pieces[piece]);
            found
        });
        found
    }

    /// A lower bound on how far the footprint must move to become free, metres: no displacement that moves every point
    /// by less can free it. 0 when it is free; infinity for a footprint that is not finite.
    pub fn depth(&self, footprint: &Footprint) -> f64 {
        if footprint.is_valid() { self.deepest(footprint).map_or(0.0, |overlap| overlap.depth) } else { f64::INFINITY }
    }

    /// Where the footprint is deepest in an obstacle, by the bound of [`depth`](Self::depth); among equals the first
    /// part and piece in file order. `None` where that bound is 0, and for a footprint that is not finite.
    pub fn deepest(&self, footprint: &Footprint) -> Option<Overlap> {
        let mut deepest: Option<(usize, Overlap)> = None;
        let parts = if footprint.is_valid() { footprint.parts() } else { &[] };
        for (part, shape) in parts.iter().map(|part| part.placed()).enumerate() {
            self.each_within(shape, 0.0, |piece| {
                let (found, owner) = (depth(shape, &self.pieces[piece]), self.owners[piece]);
                let is_deeper = |(before, overlap): &(usize, Overlap)| {
                    let is_first = || (owner, piece) < (overlap.obstacle.0, *before);
                    found > overlap.depth || (found == overlap.depth && part == overlap.part && is_first())
                };
                if found > 0.0 && deepest.as_ref().is_none_or(is_deeper) {
                    deepest = Some((piece, Overlap { part, obstacle: ObstacleId(owner), depth: found }));
                }
                false
            });
        }
        deepest.map(|(_, overlap)| overlap)
    }

    /// A search for the piece nearest to `shape`, if any is nearer than `within`.
    pub(super) fn search<'a>(&'a self, shape: &'a Placed, within: f64) -> NearestSearch<'a> {
        let among = PieceList { pieces: &self.pieces, owners: &self.owners, size: self.size };
        NearestSearch::new(shape, among, within)
    }

    /// The nearest piece to `shape`, the first in file order among equals, if any is nearer than `within`.
    pub(super) fn nearest_piece(&self, shape: &Placed, within: f64) -> Option<(usize, NearestPoints)> {
        let mut search = self.search(shape, within);
        self.index.nearest(&search.extent(), within, |piece| search.look(piece));
        search.found()
    }

    /// The pieces whose boxes meet the shape's box, in the order of a scene made whole.
    pub(crate) fn pieces_near(&self, shape: &Placed) -> Vec<&Placed> {
        let (mut near, whole) = (Vec::new(), self.whole());
        whole.index.each_near(&shape.padded_bounds(), 0.0, |number| {
            near.push(&self.pieces[whole.piece(number)]);
            false
        });
        near
    }

    /// Calls `visit` with each piece whose box is at most `range` from the shape's box, until it returns true.
    pub(super) fn each_within(&self, shape: &Placed, range: f64, visit: impl FnMut(usize) -> bool) {
        self.index.each_near(&shape.padded_bounds(), range, visit);
    }
}
