//! `Point2` and `Vector2`, with the exact sign of a turn and the limits of worlds.

/// A point of the plane, in metres.
pub type Point2 = nalgebra::Point2<f64>;

/// A displacement in the plane, in metres.
pub type Vector2 = nalgebra::Vector2<f64>;

/// The smallest feature a world or robot may have, in metres: radii (unless exactly 0), edges and segment lengths.
pub const MIN_FEATURE: f64 = 1e-3;

/// The largest coordinate a world or robot may have, in metres.
pub const MAX_COORDINATE: f64 = 1e4;

/// `a x b`, the z component of the cross product.
#[inline]
pub fn cross(a: Vector2, b: Vector2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The sign of the turn `a`, `b`, `c`: positive when counter-clockwise, exactly 0 when the three points lie on one
/// line.
///
/// The sign is exact for every `f64` input (Shewchuk's adaptive predicate, 1997).
#[inline]
pub fn orientation(a: Point2, b: Point2, c: Point2) -> f64 {
    let coord = |p: Point2| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}
