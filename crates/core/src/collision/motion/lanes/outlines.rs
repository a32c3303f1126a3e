//! `PieceOutlines`, the pieces of a scene in single precision, each about its own centre.

use crate::collision::narrow::convex::edges;
use crate::geometry::{Aabb, Placed, Point2, Segment, Vector2};
use crate::num::{greater, lesser, sqrt};

/// Largest coordinate of a scene whose pieces have outlines, metres. No product of single precision overflows below it.
pub(crate) const MAX_SIZE: f64 = 1e6;

/// How far a piece may be from convex or from a parallelogram, in parts of its size.
const ROUNDING: f64 = 1e-9;

/// A corner, or an axis, by x and y.
pub(crate) type SinglePoint = [f32; 2];

/// A direction along which a piece may be separated from something, and what the piece's core covers of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceAxis {
    /// The unit vector.
    pub(crate) ahead: SinglePoint,
    /// The least and the greatest height of the core's corners along it, from the centre, metres.
    pub(crate) low: f32,
    pub(crate) high: f32,
}

/// A convex piece, in single precision about its centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceOutline<'a> {
    /// The centre, metres.
    pub(crate) centre: Point2,
    /// The corners of the core, from the centre, metres.
    pub(crate) corners: &'a [SinglePoint],
    /// The normals of the core's sides, parallel ones once; of a segment also its direction; of a point none.
    pub(crate) axes: &'a [PieceAxis],
    /// The radius around the core, metres.
    pub(crate) radius: f32,
    /// The sum of the greatest coordinates of the corners from the centre, metres.
    pub(crate) size: f32,
}

/// The outlines of a scene's pieces.
#[derive(Clone, Debug)]
pub(crate) struct PieceOutlines {
    outlines: Vec<OutlineRow>,
    corners: Vec<SinglePoint>,
    axes: Vec<PieceAxis>,
}

/// What a [`PieceOutline`] is made of, and where its corners and axes end in the lists of all.
#[derive(Clone, Copy, Debug)]
struct OutlineRow {
    centre: Point2,
    radius: f32,
    size: f32,
    corners_end: u32,
    axes_end: u32,
}

impl PieceOutlines {
    /// The outlines of valid pieces whose coordinates are at most `size`; `None` where that is too large, or where a
    /// piece is not convex, as one written by hand may be.
    pub(crate) fn new(pieces: &[Placed], size: f64) -> Option<Self> {
        if size > MAX_SIZE {
            return None;
        }
        let mut all = PieceOutlines { outlines: Vec::with_capacity(pieces.len()), corners: vec![], axes: vec![] };
        pieces.iter().all(|piece| all.push(piece)).then_some(all)
    }

    /// Adds a valid piece whose coordinates are at most `size`; false where that is too large, or where it is not
    /// convex. Then the pieces as a whole have no outlines.
    pub(crate) fn add(&mut self, piece: &Placed, size: f64) -> bool {
        size <= MAX_SIZE && self.push(piece)
    }

    /// Adds a piece; false where it is not convex.
    fn push(&mut self, piece: &Placed) -> bool {
        let core = piece.core();
        let Some(around) = Aabb::around(core) else { return false };
        let (centre, half) = (around.centre(), (around.max - around.min) * 0.5);
        let size = half.x + half.y;
        for edge in distinct_sides(core, size) {
            let Segment { a, b } = edge;
            let u = b - a;
            let ahead = Vector2::new(u.y, -u.x) / sqrt(u.norm_squared());
            let (low, high) = heights(core, centre, ahead);
            // all corners of a convex core are behind each of its sides
            if core.len() > 2 && high > (a - centre).dot(&ahead) + ROUNDING * size {
                return false;
            }
            self.push_axis(ahead, low, high);
            if core.len() == 2 {
                let along = Vector2::new(-ahead.y, ahead.x);
                let (low, high) = heights(core, centre, along);
                self.push_axis(along, low, high);
            }
        }
        self.corners.extend(core.iter().map(|p| [(p.x - centre.x) as f32, (p.y - centre.y) as f32]));
        let (corners_end, axes_end) = (self.corners.len() as u32, self.axes.len() as u32);
        let (radius, size) = (piece.radius() as f32, size as f32);
        self.outlines.push(OutlineRow { centre, radius, size, corners_end, axes_end });
        true
    }

    fn push_axis(&mut self, ahead: Vector2, low: f64, high: f64) {
        self.axes.push(PieceAxis { ahead: [ahead.x as f32, ahead.y as f32], low: low as f32, high: high as f32 });
    }

    /// The outline of piece number `piece`.
    pub(crate) fn outline(&self, piece: usize) -> PieceOutline<'_> {
        let OutlineRow { centre, radius, size, corners_end, axes_end } = self.outlines[piece];
        let before = piece.checked_sub(1).map(|before| &self.outlines[before]);
        let (corner, axis) = before.map_or((0, 0), |row| (row.corners_end, row.axes_end));
        PieceOutline {
            centre,
            corners: &self.corners[corner as usize..corners_end as usize],
            axes: &self.axes[axis as usize..axes_end as usize],
            radius,
            size,
        }
    }
}

/// The sides of a core, without those that have no length; of a parallelogram two, as the others are parallel to them.
fn distinct_sides(core: &[Point2], size: f64) -> impl Iterator<Item = Segment> {
    let count = match core {
        [a, b, c, d] if (a - b + (c - d)).norm() <= ROUNDING * size => 2,
        _ => core.len(),
    };
    edges(core).take(count).filter(|edge| edge.a != edge.b)
}

/// The least and the greatest height of a core's corners along a direction, from its centre.
fn heights(core: &[Point2], centre: Point2, ahead: Vector2) -> (f64, f64) {
    let heights = core.iter().map(|p| (p - centre).dot(&ahead));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), h| (lesser(h, lo), greater(h, hi)))
}
