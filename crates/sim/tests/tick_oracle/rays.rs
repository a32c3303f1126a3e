//! Rays against shapes, one by one.

use libm::{cos, sin};
use motion_lab_core::geometry::{Placed, Point2, Vector2};

use oracle::plain;

/// The angle by which rays are turned to either side where a hit may be a miss, radians.
const BEND: f64 = 1e-9;

/// Largest difference of two ranges of one ray, metres.
const TOLERANCE: f64 = 1e-9;

/// Whether a ray from `from` at this bearing may read `range`. A ray that barely hits or barely misses something may
/// read either.
pub fn is_range(range: f64, from: Point2, bearing: f64, most: f64, obstacles: &[Placed]) -> bool {
    if obstacles.iter().any(|obstacle| plain::point_distance(from, obstacle) == 0.0) {
        return range == 0.0;
    }
    let cast = |bearing: f64| {
        let direction = Vector2::new(cos(bearing), sin(bearing));
        let hits = obstacles.iter().map(|obstacle| hit(from, direction, obstacle));
        let first = hits.fold(f64::INFINITY, |first, t| if t < first { t } else { first });
        if first <= most { first } else { f64::INFINITY }
    };
    let straight = cast(bearing);
    if straight == range || (straight - range).abs() <= TOLERANCE {
        return true;
    }
    let bent = [straight, cast(bearing - BEND), cast(bearing + BEND)];
    bent.iter().any(|t| *t <= range + TOLERANCE) && bent.iter().any(|t| *t >= range - TOLERANCE)
}

/// The distance along a ray to the shape, metres; infinity for a miss. The ray begins outside.
fn hit(from: Point2, direction: Vector2, shape: &Placed) -> f64 {
    let (core, radius) = (shape.core(), shape.radius());
    let mut first = f64::INFINITY;
    let mut meet = |t: f64| first = if t >= 0.0 && t < first { t } else { first };
    // the circles about the corners
    for corner in core {
        let to = corner - from;
        let middle = to.dot(&direction);
        let under = middle * middle - to.norm_squared() + radius * radius;
        if radius > 0.0 && under >= 0.0 {
            meet(middle - under.sqrt());
        }
    }
    // the sides, moved out by the radius to either side
    for (a, b) in plain::sides(core) {
        let side = b - a;
        let across = direction.x * side.y - direction.y * side.x;
        if across == 0.0 {
            continue;
        }
        let out = Vector2::new(side.y, -side.x) * (radius / side.norm());
        for a in [a + out, a - out] {
            let to = a - from;
            let along_side = (to.x * direction.y - to.y * direction.x) / across;
            if (0.0..=1.0).contains(&along_side) {
                meet((to.x * side.y - to.y * side.x) / across);
            }
        }
    }
    first
}
