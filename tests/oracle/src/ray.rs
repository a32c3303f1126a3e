//! Rays from lattice points against lattice segments, hit or missed without any rounding.
//!
//! A ray's direction is its `f64` pair times 2^62, which are whole numbers again.

/// A lattice point.
pub type Lattice = (i128, i128);

/// Twice the signed area of the triangle of the origin, `a` and `b`.
fn cross(a: Lattice, b: Lattice) -> i128 {
    a.0 * b.1 - a.1 * b.0
}

fn dot(a: Lattice, b: Lattice) -> i128 {
    a.0 * b.0 + a.1 * b.1
}

/// A direction times 2^62; `None` where that is not whole.
pub fn whole((x, y): (f64, f64)) -> Option<Lattice> {
    let scale = (1_u64 << 62) as f64; // exact, and so is the product
    let component = |c: f64| ((c * scale).fract() == 0.0).then_some((c * scale) as i128);
    Some((component(x)?, component(y)?))
}

/// Whether the closed segment from `p` to `q`, seen from the origin, holds the origin.
pub fn holds_origin(p: Lattice, q: Lattice) -> bool {
    cross(p, q) == 0 && dot(p, q) <= 0
}

/// The distance along the ray of this direction to the segment from `p` to `q`; `None` for a miss. The origin is not on
/// the segment.
pub fn meets(p: Lattice, q: Lattice, direction: Lattice) -> Option<f64> {
    let area = cross(p, q);
    if area == 0 {
        let near = if dot(p, p) <= dot(q, q) { p } else { q };
        let ahead = cross(near, direction) == 0 && dot(near, direction) > 0;
        return ahead.then(|| (dot(near, near) as f64).sqrt());
    }
    let (p, q) = if area > 0 { (p, q) } else { (q, p) };
    if cross(p, direction) < 0 || cross(direction, q) < 0 {
        return None;
    }
    let closing = cross(direction, (q.0 - p.0, q.1 - p.1));
    Some(area.abs() as f64 / (closing as f64 / (1_u64 << 62) as f64))
}
