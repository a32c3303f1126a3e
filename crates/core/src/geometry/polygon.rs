//! `ConvexPolygon`, a convex polygon that is checked once, when it is made.

use std::sync::Arc;

use super::{MAX_COORDINATE, MIN_FEATURE, Point2, orientation};
use crate::num;

/// A strictly convex polygon, its vertices in counter-clockwise order, at least three.
///
/// Cheap to clone: the vertices are shared.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolygon {
    vertices: Arc<[Point2]>,
}

/// Why a list of vertices is not a convex polygon.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PolygonError {
    /// Fewer than three vertices.
    #[error("a polygon needs at least 3 vertices, found {0}")]
    TooFewVertices(usize),
    /// A vertex with a coordinate that is not finite or out of range.
    #[error("vertex {0} is not finite or lies beyond {MAX_COORDINATE} m")]
    BadVertex(usize),
    /// An edge shorter than [`MIN_FEATURE`].
    #[error("the edge after vertex {0} is shorter than {MIN_FEATURE} m: each corner is named once, the first one too")]
    ShortEdge(usize),
    /// The boundary turns right, or not at all, at this vertex.
    #[error("not strictly convex at vertex {0} (a concave or straight corner); split it into convex pieces")]
    NotConvex(usize),
    /// The boundary winds around more than once or crosses itself.
    #[error("the boundary crosses itself")]
    SelfCrossing,
}

impl ConvexPolygon {
    /// The polygon with these vertices, in either orientation (stored counter-clockwise, the first vertex kept first).
    ///
    /// # Errors
    /// [`PolygonError`] names the vertex: too few, not finite, an edge that is too short, a corner that is concave or
    /// straight (tested exactly), a boundary that crosses itself.
    pub fn try_new(vertices: &[Point2]) -> Result<Self, PolygonError> {
        let n = vertices.len();
        if n < 3 {
            return Err(PolygonError::TooFewVertices(n));
        }
        for (i, v) in vertices.iter().enumerate() {
            // written so that NaN fails it
            if !(v.x.abs() <= MAX_COORDINATE && v.y.abs() <= MAX_COORDINATE) {
                return Err(PolygonError::BadVertex(i));
            }
        }
        for i in 0..n {
            let d = vertices[(i + 1) % n] - vertices[i];
            if num::hypot(d.x, d.y) < MIN_FEATURE {
                return Err(PolygonError::ShortEdge(i));
            }
        }
        let lowest = (0..n)
            .reduce(|l, i| {
                let (a, b) = (vertices[l], vertices[i]);
                if (b.y, b.x) < (a.y, a.x) { i } else { l }
            })
            .unwrap_or(0);
        let turn = |v: &[Point2], i: usize| orientation(v[(i + n - 1) % n], v[i], v[(i + 1) % n]);
        let mut stored = vertices.to_vec();
        // the lowest, leftmost vertex is a true corner of the hull, so its turn gives the orientation
        if turn(vertices, lowest) < 0.0 {
            stored[1..].reverse();
        }
        for i in 0..n {
            if turn(&stored, i) <= 0.0 {
                let original = if stored[1] == vertices[1] { i } else { (n - i) % n };
                return Err(PolygonError::NotConvex(original));
            }
        }
        // A closed chain that only turns left winds once exactly when its edges' directions pass from the lower to the
        // upper half-plane once.
        let upward = |i: usize| {
            let (a, b) = (stored[i % n], stored[(i + 1) % n]);
            b.y > a.y || (b.y == a.y && b.x > a.x)
        };
        if (0..n).filter(|&i| !upward(i) && upward(i + 1)).count() != 1 {
            return Err(PolygonError::SelfCrossing);
        }
        Ok(ConvexPolygon { vertices: stored.into() })
    }

    /// The vertices, counter-clockwise.
    pub fn vertices(&self) -> &[Point2] {
        &self.vertices
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(p: &[(f64, f64)]) -> Vec<Point2> {
        p.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    #[test]
    fn clockwise_input_is_turned_and_keeps_its_first_vertex() {
        let p = ConvexPolygon::try_new(&points(&[(0.0, 0.0), (0.0, 1.0), (1.0, 1.0)])).unwrap();
        assert_eq!(p.vertices(), &points(&[(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)])[..]);
    }

    #[test]
    fn what_is_not_a_convex_polygon_is_refused_with_the_vertex() {
        let refuse = |p: &[(f64, f64)]| ConvexPolygon::try_new(&points(p)).unwrap_err();
        assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0)]), PolygonError::TooFewVertices(2));
        assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0), (f64::NAN, 1.0)]), PolygonError::BadVertex(2));
        assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0), (1.0, 2e4)]), PolygonError::BadVertex(2));
        assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)]), PolygonError::ShortEdge(1));
        // concave at vertex 3, then the same list the other way round: the vertex is named in the caller's order
        assert_eq!(refuse(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5), (0.0, 2.0)]), PolygonError::NotConvex(3));
        assert_eq!(refuse(&[(0.0, 2.0), (1.0, 0.5), (2.0, 2.0), (2.0, 0.0), (0.0, 0.0)]), PolygonError::NotConvex(1));
        assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 1.0)]), PolygonError::NotConvex(1));
        // a bow-tie turns both ways; a pentagram only left, but twice around
        assert!(matches!(refuse(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]), PolygonError::NotConvex(_)));
        let star: Vec<(f64, f64)> =
            (0..5).map(|k| crate::num::sin_cos(f64::from(k) * 0.8 * std::f64::consts::PI)).collect();
        assert_eq!(refuse(&star), PolygonError::SelfCrossing);
    }
}
