//! The boxes around curved parts, without following the curves.

use super::affine::Affine;
use super::curves::{along, end_of};
use super::part::{CurvedPart, PathPiece};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num;

/// Farthest from the origin along an axis that lines are cut, metres: so far double precision keeps a micrometre, and
/// a count of millimetres is a whole number of 64 bits. What is left of them must lie within a world's own, lesser
/// limit.
pub(super) const MAX_PLANAR_COORDINATE: f64 = 1e9;

/// The smallest box around these parts, but for rounding; `None` around none.
pub(crate) fn extent<'p>(parts: impl IntoIterator<Item = &'p CurvedPart>) -> Option<Aabb> {
    Aabb::around(&parts.into_iter().flat_map(outermost).collect::<Vec<Point2>>())
}

/// A point of these parts that lies farther out than [`MAX_PLANAR_COORDINATE`], or is not finite; `None` if there is
/// none.
pub(crate) fn beyond<'p>(parts: impl IntoIterator<Item = &'p CurvedPart>) -> Option<Point2> {
    parts.into_iter().flat_map(outermost).find(|p| !is_within(p))
}

/// Whether numbers of these parts stand for more than [`MAX_PLANAR_COORDINATE`] before a map displaces them: wherever
/// it puts them, they have no micrometres.
pub(crate) fn is_coarse(parts: &[CurvedPart], map: &Affine) -> bool {
    let linear = map.linear();
    let is_coarse_piece = |piece: &PathPiece| match piece {
        PathPiece::Arc(arc, _) => !arc.frame().iter().all(is_within),
        PathPiece::Line(_) | PathPiece::Cubic(..) => false,
    };
    let mut images = parts.iter().map(|part| part.mapped(&linear));
    images.any(|part| beyond([&part]).is_some() || part.pieces.iter().any(is_coarse_piece))
}

/// Written so that NaN is not.
fn is_within(p: &Point2) -> bool {
    p.x.abs() <= MAX_PLANAR_COORDINATE && p.y.abs() <= MAX_PLANAR_COORDINATE
}

/// Points of a part, among them those with its least and greatest coordinates.
fn outermost(part: &CurvedPart) -> Vec<Point2> {
    let mut points = vec![part.start];
    let mut from = part.start;
    for piece in &part.pieces {
        points.extend(turning_points(from, piece).into_iter().map(|t| along(from, piece, t)));
        from = end_of(piece);
        points.push(from);
    }
    points
}

/// Where a piece turns back along an axis, from 0 to 1.
fn turning_points(from: Point2, piece: &PathPiece) -> Vec<f64> {
    match *piece {
        PathPiece::Line(_) => Vec::new(),
        PathPiece::Arc(arc, _) => arc.turning_points(),
        PathPiece::Cubic(a, b, end) => {
            let along_axis = |of: fn(Point2) -> f64| stationary([from, a, b, end].map(of));
            [along_axis(|p| p.x), along_axis(|p| p.y)].concat()
        }
    }
}

/// Where the cubic polynomial with these coefficients of Bernstein has its derivative's roots, between 0 and 1.
fn stationary([p, q, r, s]: [f64; 4]) -> Vec<f64> {
    // a third of the derivative is `c + b t + a t^2`
    let (a, b, c) = ((q - p) - 2.0 * (r - q) + (s - r), 2.0 * ((r - q) - (q - p)), q - p);
    let root = num::sqrt(b * b - 4.0 * a * c);
    // the sum of two numbers of one sign, so that no digits are lost
    let half = -0.5 * (b + root.copysign(b));
    // written so that NaN, of no roots or no numbers, is none
    [half / a, c / half].into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect()
}

#[cfg(test)]
mod tests {
    use super::super::affine::Affine;
    use super::super::curves::outline;
    use super::super::ellipse::{EllipticArc, arc_between};
    use super::*;
    use motion_lab_core::geometry::Vector2;
    use motion_lab_core::random::{Seed, Stream};

    fn part(start: Point2, pieces: Vec<PathPiece>) -> CurvedPart {
        CurvedPart { start, pieces, closed: true }
    }

    fn circle(center: Point2, r: f64) -> CurvedPart {
        let arc = EllipticArc::whole(center, Vector2::new(r, 0.0), Vector2::new(0.0, r));
        part(arc.point(0.0), vec![PathPiece::Arc(arc, arc.point(0.0))])
    }

    #[test]
    fn the_box_around_a_circle_of_any_size_touches_it_on_four_sides() {
        for r in [1e-3, 1.0, 3_000.0, 1e6, 1e9] {
            let found = extent(&[circle(Point2::new(2.0 * r, -r), r)]).unwrap();
            assert_eq!(found, Aabb::new(Point2::new(r, -2.0 * r), Point2::new(3.0 * r, 0.0)), "{r}");
        }
        assert_eq!(extent(&[]), None);
    }

    #[test]
    fn boxes_around_curves_are_those_of_their_turning_points() {
        let at = |x: f64, y: f64| Point2::new(x, y);
        // y = 3 t (1 - t)^2 - 3 t^2 (1 - t) has its derivative's roots in (3 -+ sqrt(3)) / 6, where it is
        // +- sqrt(3) / 6
        let wave = part(at(0.0, 0.0), vec![PathPiece::Cubic(at(1.0, 1.0), at(2.0, -1.0), at(3.0, 0.0))]);
        let found = extent(&[wave]).unwrap();
        let high = 3.0_f64.sqrt() / 6.0;
        assert!((found.max.y - high).abs() < 1e-15 && (found.min.y + high).abs() < 1e-15, "{found:?}");
        assert_eq!((found.min.x, found.max.x), (0.0, 3.0));
        // a parabola, whose cubic has no term of the third power: y = 3 t (1 - t)
        let bow = part(at(0.0, 0.0), vec![PathPiece::Cubic(at(1.0, 1.0), at(2.0, 1.0), at(3.0, 0.0))]);
        assert_eq!(extent(&[bow]).unwrap(), Aabb::new(at(0.0, 0.0), at(3.0, 0.75)));
        // a quarter of a circle turns nowhere but at its ends, its complement three times
        for (is_large, expected) in [(false, [0.0, 0.0, 1.0, 1.0]), (true, [0.0, 0.0, 2.0, 2.0])] {
            let arc = arc_between([at(1.0, 0.0), at(0.0, 1.0)], Vector2::new(1.0, 1.0), 0.0, [is_large, is_large]);
            let found = extent(&[part(at(1.0, 0.0), vec![PathPiece::Arc(arc.unwrap(), at(0.0, 1.0))])]).unwrap();
            let corners = [found.min.x, found.min.y, found.max.x, found.max.y];
            assert!((0..4).all(|i| (corners[i] - expected[i]).abs() < 1e-15), "{found:?}");
        }
    }

    #[test]
    fn a_box_holds_its_curve_and_no_more_under_any_map() {
        let mut s = Stream::new(Seed(4), "boxes");
        for round in 0..600 {
            let mut place = || Point2::new(s.uniform(-5.0, 5.0), s.uniform(-5.0, 5.0));
            let (start, [a, b, end]) = (place(), [(); 3].map(|()| place()));
            let flags = [round % 2 == 0, round % 4 < 2];
            let piece = match arc_between([start, end], a - b, a.x * 50.0, flags) {
                Some(arc) if round % 3 > 0 => PathPiece::Arc(arc, end),
                _ => PathPiece::Cubic(a, b, end),
            };
            let map = Affine([(); 6].map(|()| s.uniform(-2.0, 2.0)));
            let bent = part(start, vec![piece]).mapped(&map);
            let found = extent(std::slice::from_ref(&bent)).unwrap();
            let points = outline(&bent, 1e-4, &mut 1_000_000).unwrap().points;
            assert!(points.iter().all(|p| found.grown(1e-12).contains(*p)), "{bent:?}");
            let followed = Aabb::around(&points).unwrap();
            assert!(followed.grown(1e-4).contains(found.min) && followed.grown(1e-4).contains(found.max), "{bent:?}");
        }
    }

    #[test]
    fn what_lies_too_far_out_or_nowhere_is_found() {
        let line = |x: f64, y: f64| CurvedPart::ring(&[Point2::origin(), Point2::new(x, y)]);
        assert_eq!(beyond(&[line(1e9, -1e9), circle(Point2::new(5e8, 0.0), 5e8)]), None);
        for (x, y) in [(1.000_001e9, 0.0), (0.0, -2e9), (f64::NAN, 0.0), (0.0, f64::NEG_INFINITY)] {
            let found = beyond(&[line(1.0, 1.0), line(x, y)]).unwrap();
            assert_eq!([found.x, found.y].map(f64::to_bits), [x, y].map(f64::to_bits));
        }
        // between its ends
        assert!(beyond(&[circle(Point2::new(5e8, 5.1e8), 5e8)]).is_some());
        let cubic = PathPiece::Cubic(Point2::new(0.0, 2e9), Point2::new(0.0, 2e9), Point2::origin());
        assert!(beyond(&[part(Point2::origin(), vec![cubic])]).is_some());
        assert!(beyond(&[circle(Point2::origin(), 1.0).mapped(&Affine::scale(1e200, 1e200))]).is_some());
        assert!(beyond(&[circle(Point2::origin(), 1.0).mapped(&Affine::scale(f64::INFINITY, 0.0))]).is_some());
    }
}
