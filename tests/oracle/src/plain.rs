//! The questions about two placed shapes in everyday `f64`, by the textbook's methods instead of the library's:
//! crossing numbers, parametric segment intersection, separating axes.
//!
//! The answers are right to within rounding. Tests that use them leave a margin of some ulps, or stay on a lattice,
//! where products are exact.

use motion_lab_core::geometry::{Placed, Point2, Vector2};

/// The nearest points of two shapes and their distance, 0 on contact.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    pub on_a: Point2,
    pub on_b: Point2,
    pub dist: f64,
}

/// Whether two shapes have a point in common.
pub fn intersects(a: &Placed, b: &Placed) -> bool {
    nearest(a, b).dist == 0.0
}

/// The distance of two shapes, 0 on contact.
pub fn distance(a: &Placed, b: &Placed) -> f64 {
    nearest(a, b).dist
}

/// A pair of nearest points; on contact, one point near both.
pub fn nearest(a: &Placed, b: &Placed) -> Near {
    let reach = a.radius() + b.radius();
    if let Some(p) = common_point(a.core(), b.core()) {
        return Near { on_a: p, on_b: p, dist: 0.0 };
    }
    let core = nearest_cores(a.core(), b.core());
    let gap = core.dist - reach;
    if gap <= 0.0 {
        let p = core.on_a + (core.on_b - core.on_a) * (a.radius() / (reach + f64::MIN_POSITIVE));
        return Near { on_a: p, on_b: p, dist: 0.0 };
    }
    let unit = (core.on_b - core.on_a) / core.dist;
    Near { on_a: core.on_a + unit * a.radius(), on_b: core.on_b - unit * b.radius(), dist: gap }
}

/// How far `p` is outside the shape, metres; 0 inside.
pub fn point_distance(p: Point2, shape: &Placed) -> f64 {
    let core = shape.core();
    if inside_by_crossings(core, p) {
        return 0.0;
    }
    let d = sides(core).map(|(a, b)| (p - foot(p, a, b)).norm()).fold(f64::INFINITY, |m, d| if d < m { d } else { m });
    let outside = d - shape.radius();
    if outside > 0.0 { outside } else { 0.0 }
}

/// A core's sides: a point is one side of length 0, a segment one side.
pub fn sides(core: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    let n = core.len();
    (0..if n > 2 { n } else { 1 }).map(move |i| (core[i], core[(i + 1) % n]))
}

/// A point that two cores have in common.
fn common_point(a: &[Point2], b: &[Point2]) -> Option<Point2> {
    if a.len() > 2 && b.len() > 2 && separated_by_an_axis(a, b) {
        return None;
    }
    let mut crossings = sides(a).flat_map(|p| sides(b).filter_map(move |q| crossing(p, q)));
    crossings.next().or_else(|| {
        if inside_by_crossings(b, a[0]) {
            Some(a[0])
        } else if inside_by_crossings(a, b[0]) {
            Some(b[0])
        } else {
            None
        }
    })
}

/// Whether the normal of some side separates two convex polygons strictly (the separating axis theorem).
pub fn separated_by_an_axis(a: &[Point2], b: &[Point2]) -> bool {
    sides(a).chain(sides(b)).any(|(p, q)| {
        let axis = Vector2::new(q.y - p.y, p.x - q.x);
        let span = |core: &[Point2]| {
            core.iter().map(|v| (v - p).dot(&axis)).fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| {
                (if x < lo { x } else { lo }, if x > hi { x } else { hi })
            })
        };
        let (a, b) = (span(a), span(b));
        a.1 < b.0 || b.1 < a.0
    })
}

/// Whether two polygons meet, by brute force: some sides cross, or one holds the other's first vertex.
pub fn meet_by_brute_force(a: &[Point2], b: &[Point2]) -> bool {
    sides(a).any(|p| sides(b).any(|q| crossing(p, q).is_some()))
        || inside_by_crossings(b, a[0])
        || inside_by_crossings(a, b[0])
}

/// Whether a ray from `p` to the right crosses the polygon's boundary an odd number of times.
pub fn inside_by_crossings(core: &[Point2], p: Point2) -> bool {
    if core.len() < 3 {
        return false;
    }
    sides(core)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        .count()
        % 2
        == 1
}

/// A common point of two closed segments, from the parameters at which their lines cross; parallel ones by projection.
fn crossing((p, q): (Point2, Point2), (r, s): (Point2, Point2)) -> Option<Point2> {
    let (u, v, w) = (q - p, s - r, r - p);
    let det = u.x * v.y - u.y * v.x;
    if det != 0.0 {
        let t_det = w.x * v.y - w.y * v.x;
        let s_det = w.x * u.y - w.y * u.x;
        let unit = |x: f64| if det > 0.0 { x >= 0.0 && x <= det } else { x <= 0.0 && x >= det };
        return (unit(t_det) && unit(s_det)).then(|| p + u * (t_det / det));
    }
    // parallel, or one of them is a point
    let ends = [(p, r, s), (q, r, s), (r, p, q), (s, p, q)];
    ends.into_iter()
        .find(|&(x, a, b)| {
            let (d, e) = (b - a, x - a);
            let along = d.dot(&e);
            d.x * e.y - d.y * e.x == 0.0 && along >= 0.0 && along <= d.dot(&d) && (d != Vector2::zeros() || x == a)
        })
        .map(|(x, _, _)| x)
}

/// The point of the segment `a b` nearest to `p`, by the clamped parameter.
fn foot(p: Point2, a: Point2, b: Point2) -> Point2 {
    let d = b - a;
    let t = (p - a).dot(&d) / d.dot(&d);
    // a segment of length 0 has t = NaN
    if t >= 1.0 {
        b
    } else if t > 0.0 {
        a + d * t
    } else {
        a
    }
}

/// The nearest points of two disjoint cores: attained at a vertex of one of them.
fn nearest_cores(a: &[Point2], b: &[Point2]) -> Near {
    let mut best = Near { on_a: a[0], on_b: b[0], dist: f64::INFINITY };
    for &p in a {
        for (r, s) in sides(b) {
            let q = foot(p, r, s);
            let dist = (q - p).norm();
            if dist < best.dist {
                best = Near { on_a: p, on_b: q, dist };
            }
        }
    }
    for &q in b {
        for (r, s) in sides(a) {
            let p = foot(q, r, s);
            let dist = (q - p).norm();
            if dist < best.dist {
                best = Near { on_a: p, on_b: q, dist };
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::Vertices;

    fn placed(points: &[(f64, f64)], radius: f64) -> Placed {
        Placed::new(points.iter().map(|&(x, y)| Point2::new(x, y)).collect::<Vertices>(), radius)
    }

    #[test]
    fn known_distances() {
        let square = placed(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], 0.0);
        let disc = placed(&[(5.0, 6.0)], 1.0);
        let near = nearest(&disc, &square);
        assert_eq!(near.dist, 4.0, "3-4-5 from the corner");
        assert_eq!(near.on_b, Point2::new(2.0, 2.0));
        assert_eq!(distance(&placed(&[(1.0, 1.0)], 0.5), &square), 0.0, "inside");
        let (p, q) = (placed(&[(0.0, 0.0), (4.0, 4.0)], 0.0), placed(&[(0.0, 4.0), (4.0, 0.0)], 0.0));
        assert!(intersects(&p, &q) && nearest(&p, &q).on_a == Point2::new(2.0, 2.0));
        let (p, q) = (placed(&[(0.0, 0.0), (4.0, 2.0)], 0.0), placed(&[(6.0, 3.0), (8.0, 4.0)], 0.0));
        assert!(!intersects(&p, &q), "collinear and apart");
        assert!(point_distance(Point2::new(3.0, 1.0), &square) == 1.0);
    }
}
