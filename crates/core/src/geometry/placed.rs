//! `Placed`, a shape in the world: what every exact query works on.

use super::{Aabb, Point2, Vertices, convex_hull};
use crate::num::{greater, ulp};
use crate::short_list::ShortList;

/// A placed shape: all points within `radius` of the convex core with these vertices, in world coordinates.
///
/// The rounded `f64` vertices *are* the shape: exactness of the queries is meant against them. One vertex is a disc's
/// centre, two are a segment, three or more a simple polygon in counter-clockwise order.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    core: Vertices,
    radius: f64,
}

impl Placed {
    /// The placed shape with this core and radius. With an empty core it is not valid: every query counts it as
    /// contact.
    #[inline]
    pub fn new(core: impl Into<Vertices>, radius: f64) -> Self {
        Placed { core: core.into(), radius }
    }

    /// The core's vertices.
    #[inline]
    pub fn core(&self) -> &[Point2] {
        &self.core
    }

    /// The radius around the core, metres.
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether there is at least one vertex, the radius is not negative, and no number is NaN or beyond 1e60 in size,
    /// where the fourth powers that the queries form would overflow.
    pub fn is_valid(&self) -> bool {
        const LIMIT: f64 = 1e60;
        !self.core.is_empty()
            && (0.0..=LIMIT).contains(&self.radius)
            && self.core.iter().all(|p| p.x.abs() <= LIMIT && p.y.abs() <= LIMIT)
    }

    /// The smallest axis-parallel box around the shape, radius included; rounded.
    pub fn bounds(&self) -> Aabb {
        const NOTHING: Aabb = Aabb {
            min: Point2::new(f64::INFINITY, f64::INFINITY),
            max: Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        Aabb::around(&self.core).unwrap_or(NOTHING).grown(self.radius)
    }

    /// A box that holds the shape in spite of rounding, so that a broad phase drops nothing by it. All of the plane for
    /// a shape that is not valid.
    #[doc(hidden)]
    pub fn padded_bounds(&self) -> Aabb {
        if !self.is_valid() {
            return Aabb::new(Point2::new(-1e200, -1e200), Point2::new(1e200, 1e200));
        }
        self.padded_bounds_of_valid()
    }

    /// [`padded_bounds`](Self::padded_bounds) of a shape known to be valid.
    #[inline]
    #[doc(hidden)]
    pub fn padded_bounds_of_valid(&self) -> Aabb {
        let bounds = self.bounds();
        bounds.grown(64.0 * ulp(bounds.size()))
    }

    /// The hull of this shape and `other`, with the greater of the two radii: all that a part whose vertices move in
    /// straight lines from here to there can touch.
    #[must_use]
    pub fn hull_with(&self, other: &Placed) -> Placed {
        let mut points: ShortList<Point2, 16> = ShortList::from_slice(&self.core);
        points.extend_from_slice(&other.core);
        // a NaN radius stays NaN, and such a shape is not valid
        let radius = if self.radius.is_nan() { self.radius } else { greater(self.radius, other.radius) };
        Placed { core: convex_hull(&points), radius }
    }
}

/// `max(1, the largest coordinate or radius in size)`: the number M that the tolerances of the collision queries are
/// stated in ulps of.
pub fn largest_coordinate<'a>(shapes: impl IntoIterator<Item = &'a Placed>) -> f64 {
    shapes
        .into_iter()
        .fold(1.0, |m, s| s.core.iter().fold(greater(m, s.radius), |m, p| greater(greater(m, p.x.abs()), p.y.abs())))
}
