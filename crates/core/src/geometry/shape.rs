//! `Shape`, the convex shapes that footprints and worlds consist of.

use std::sync::Arc;

use super::{
    ConvexPolygon, MAX_COORDINATE, MIN_FEATURE, Placed, Point2, PolygonError, Pose2, SinCos, Vertices, convex_hull,
};
use crate::num::{self, greater};

/// A closed convex shape in its own frame, in metres.
///
/// Every shape is a convex core of vertices and a radius around it ([`Placed`]). Make one with the `try_` constructors,
/// which check finiteness and size; a shape written out by hand that breaks their rules fails safe in every query (it
/// is in contact), it never panics.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A disc around the frame's origin.
    Disc {
        /// The radius, metres.
        radius: f64,
    },
    /// A line segment without thickness.
    Segment {
        /// One end.
        a: Point2,
        /// The other end.
        b: Point2,
    },
    /// All points within `radius` of a segment.
    Capsule {
        /// One end of the core segment.
        a: Point2,
        /// The other end of the core segment.
        b: Point2,
        /// The radius, metres. 0 gives the segment.
        radius: f64,
    },
    /// A rectangle with sides along the frame's axes.
    Rectangle {
        /// The corner with the least coordinates.
        min: Point2,
        /// The corner with the greatest coordinates.
        max: Point2,
    },
    /// A strictly convex polygon.
    Polygon(ConvexPolygon),
    /// All points within `radius` of the convex hull of some points: what a part sweeps over.
    Hull {
        /// The hull's vertices, counter-clockwise; one or two points are allowed.
        vertices: Arc<[Point2]>,
        /// The radius, metres.
        radius: f64,
    },
}

/// Why a shape's numbers are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A radius that is not finite, negative, too small or too large.
    #[error("radius {0} m: it must be finite, from {MIN_FEATURE} to {MAX_COORDINATE} m")]
    Radius(f64),
    /// A coordinate that is not finite or too large.
    #[error("point ({0}, {1}): coordinates must be finite and at most {MAX_COORDINATE} m in size")]
    Coordinate(f64, f64),
    /// A segment, or a side of a rectangle, shorter than [`MIN_FEATURE`].
    #[error("length {0} m: the smallest feature is {MIN_FEATURE} m")]
    TooShort(f64),
    /// Not a convex polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

fn check_radius(radius: f64) -> Result<f64, ShapeError> {
    if (MIN_FEATURE..=MAX_COORDINATE).contains(&radius) { Ok(radius) } else { Err(ShapeError::Radius(radius)) }
}

fn check_length(length: f64) -> Result<(), ShapeError> {
    if length >= MIN_FEATURE { Ok(()) } else { Err(ShapeError::TooShort(length)) }
}

impl Shape {
    pub(super) fn check_point(p: Point2) -> Result<Point2, ShapeError> {
        // written so that NaN fails it
        if p.x.abs() <= MAX_COORDINATE && p.y.abs() <= MAX_COORDINATE {
            Ok(p)
        } else {
            Err(ShapeError::Coordinate(p.x, p.y))
        }
    }

    /// A disc around the frame's origin.
    ///
    /// # Errors
    /// [`ShapeError::Radius`] unless `radius` lies in [[`MIN_FEATURE`], [`MAX_COORDINATE`]].
    pub fn try_disc(radius: f64) -> Result<Self, ShapeError> {
        Ok(Shape::Disc { radius: check_radius(radius)? })
    }

    /// A segment without thickness.
    ///
    /// # Errors
    /// [`ShapeError`] for a bad coordinate or a length below [`MIN_FEATURE`].
    pub fn try_segment(a: Point2, b: Point2) -> Result<Self, ShapeError> {
        let (a, b) = (Self::check_point(a)?, Self::check_point(b)?);
        check_length(num::hypot(b.x - a.x, b.y - a.y))?;
        Ok(Shape::Segment { a, b })
    }

    /// A capsule; a radius of exactly 0 gives the segment.
    ///
    /// # Errors
    /// [`ShapeError`] for a bad coordinate or radius, or a core shorter than [`MIN_FEATURE`].
    pub fn try_capsule(a: Point2, b: Point2, radius: f64) -> Result<Self, ShapeError> {
        Self::try_segment(a, b)?;
        let radius = if radius == 0.0 { 0.0 } else { check_radius(radius)? };
        Ok(Shape::Capsule { a, b, radius })
    }

    /// All points within `radius` of the convex hull of some points, at least two of which differ; a radius of exactly
    /// 0 gives the hull itself.
    ///
    /// # Errors
    /// [`ShapeError`] for a bad coordinate or radius, or a side of the hull shorter than [`MIN_FEATURE`]; for points
    /// that are all one, a length of 0.
    pub fn try_rounded(points: &[Point2], radius: f64) -> Result<Self, ShapeError> {
        let vertices = convex_hull(points);
        match vertices[..] {
            [] | [_] => return Err(ShapeError::TooShort(0.0)),
            [a, b] => return Self::try_capsule(a, b, radius),
            _ => {}
        }
        let radius = if radius == 0.0 { 0.0 } else { check_radius(radius)? };
        for (i, a) in vertices.iter().enumerate() {
            Self::try_segment(*a, vertices[(i + 1) % vertices.len()])?;
        }
        Ok(Shape::Hull { vertices: vertices[..].into(), radius })
    }

    /// A rectangle from two opposite corners.
    ///
    /// # Errors
    /// [`ShapeError`] for a bad coordinate or a side shorter than [`MIN_FEATURE`].
    pub fn try_rectangle(corner: Point2, opposite: Point2) -> Result<Self, ShapeError> {
        let (p, q) = (Self::check_point(corner)?, Self::check_point(opposite)?);
        let min = Point2::new(num::lesser(p.x, q.x), num::lesser(p.y, q.y));
        let max = Point2::new(greater(p.x, q.x), greater(p.y, q.y));
        check_length(max.x - min.x)?;
        check_length(max.y - min.y)?;
        Ok(Shape::Rectangle { min, max })
    }

    /// The convex polygon with these vertices, metres, in the shape's frame. They may go round in either direction; it
    /// stores them counter-clockwise, the first one first.
    ///
    /// # Errors
    /// [`ShapeError::Polygon`] says why they are not the vertices of a strictly convex polygon.
    pub fn try_polygon(vertices: &[Point2]) -> Result<Self, ShapeError> {
        Ok(Shape::Polygon(ConvexPolygon::try_new(vertices)?))
    }

    /// The radius around the core: 0 for segments, rectangles and polygons.
    #[inline]
    pub fn radius(&self) -> f64 {
        match self {
            Shape::Disc { radius } | Shape::Capsule { radius, .. } | Shape::Hull { radius, .. } => *radius,
            Shape::Segment { .. } | Shape::Rectangle { .. } | Shape::Polygon(_) => 0.0,
        }
    }

    /// The core's vertices in the shape's frame: 1 for a disc, 2 for a segment or capsule, else the boundary
    /// counter-clockwise.
    #[inline]
    pub fn core(&self) -> Vertices {
        self.core_by(|p| p)
    }

    /// The core's vertices, each of them mapped.
    #[inline]
    fn core_by(&self, map: impl Fn(Point2) -> Point2) -> Vertices {
        match self {
            Shape::Disc { .. } => Vertices::from([map(Point2::origin())]),
            Shape::Segment { a, b } | Shape::Capsule { a, b, .. } => Vertices::from([map(*a), map(*b)]),
            Shape::Rectangle { min, max } => {
                Vertices::from([map(*min), map(Point2::new(max.x, min.y)), map(*max), map(Point2::new(min.x, max.y))])
            }
            Shape::Polygon(p) => p.vertices().iter().copied().map(map).collect(),
            Shape::Hull { vertices, .. } => vertices.iter().copied().map(map).collect(),
        }
    }

    /// The distance from the frame's origin to the farthest point of the core, metres: rotating the frame by `dtheta`
    /// moves no point of the core farther than this times `|dtheta|`. The radius is left out: rotation moves the core
    /// only.
    pub fn core_reach(&self) -> f64 {
        self.core().iter().fold(0.0, |r, p| greater(r, num::hypot(p.x, p.y)))
    }

    /// The shape placed in the world: its vertices rounded to `f64`, and its radius.
    #[inline]
    pub fn place(&self, pose: &Pose2) -> Placed {
        self.place_by(pose, SinCos::of(pose.theta))
    }

    /// As [`place`](Self::place), given the sine and the cosine of the frame's angle.
    #[inline]
    pub(crate) fn place_by(&self, pose: &Pose2, sin_cos: SinCos) -> Placed {
        let is_identity = *pose == Pose2::IDENTITY;
        let core = self.core_by(|p| if is_identity { p } else { pose.transform_by(sin_cos, p) });
        Placed::new(core, self.radius())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructors_refuse_what_is_not_a_shape() {
        let p = Point2::new;
        assert_eq!(Shape::try_disc(0.0), Err(ShapeError::Radius(0.0)));
        assert!(Shape::try_disc(f64::NAN).is_err() && Shape::try_disc(f64::INFINITY).is_err());
        assert_eq!(Shape::try_segment(p(0.0, 0.0), p(0.0, 0.0)), Err(ShapeError::TooShort(0.0)));
        assert_eq!(Shape::try_segment(p(0.0, 1e5), p(0.0, 0.0)), Err(ShapeError::Coordinate(0.0, 1e5)));
        assert!(Shape::try_capsule(p(0.0, 0.0), p(1.0, 0.0), 0.0).is_ok());
        assert!(Shape::try_capsule(p(0.0, 0.0), p(1.0, 0.0), -0.1).is_err());
        let r = Shape::try_rectangle(p(1.0, 2.0), p(0.0, 0.0)).unwrap();
        assert_eq!(r, Shape::Rectangle { min: p(0.0, 0.0), max: p(1.0, 2.0) });
        assert!(Shape::try_rectangle(p(1.0, 2.0), p(1.0, 0.0)).is_err());
        assert!(Shape::try_polygon(&[p(0.0, 0.0), p(1.0, 0.0)]).is_err());
    }

    #[test]
    fn reach_is_the_farthest_core_point() {
        let r = Shape::try_rectangle(Point2::new(-1.0, -0.5), Point2::new(3.0, 4.0)).unwrap();
        assert_eq!(r.core_reach(), 5.0);
        assert_eq!(Shape::Disc { radius: 2.0 }.core_reach(), 0.0);
    }
}
