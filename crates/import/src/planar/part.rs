//! `CurvedPart`, one part of a drawn path: straight and curved pieces.

use super::affine::Affine;
use super::ellipse::EllipticArc;
use motion_lab_core::geometry::Point2;

/// A piece of a drawn line. It begins where the one before ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PathPiece {
    Line(Point2),
    /// Two control points and the end.
    Cubic(Point2, Point2, Point2),
    /// An arc and its end.
    Arc(EllipticArc, Point2),
}

/// One part of a drawn path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CurvedPart {
    pub start: Point2,
    pub pieces: Vec<PathPiece>,
    pub closed: bool,
}

impl CurvedPart {
    pub fn new(start: Point2) -> Self {
        CurvedPart { start, pieces: Vec::new(), closed: false }
    }

    /// The closed line through these points.
    pub fn ring(points: &[Point2]) -> Self {
        let mut part = CurvedPart::new(points.first().copied().unwrap_or_default());
        part.pieces = points.iter().skip(1).map(|p| PathPiece::Line(*p)).collect();
        part.closed = true;
        part
    }

    /// The image of the part.
    pub fn mapped(&self, map: &Affine) -> Self {
        let piece = |piece: &PathPiece| match *piece {
            PathPiece::Line(p) => PathPiece::Line(map.point(p)),
            PathPiece::Cubic(a, b, c) => PathPiece::Cubic(map.point(a), map.point(b), map.point(c)),
            PathPiece::Arc(arc, end) => PathPiece::Arc(arc.mapped(map), map.point(end)),
        };
        CurvedPart {
            start: map.point(self.start),
            pieces: self.pieces.iter().map(piece).collect(),
            closed: self.closed,
        }
    }
}
