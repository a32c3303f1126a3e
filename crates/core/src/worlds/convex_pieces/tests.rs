//! Pieces against other ways to cut, and against the polygon itself.

use super::*;
use crate::random::{Seed, Stream};

fn points(p: &[(f64, f64)]) -> Vec<Point2> {
    p.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

fn doubled_area(p: &[Point2]) -> f64 {
    (0..p.len()).map(|i| (p[i], p[(i + 1) % p.len()])).map(|(a, b)| a.x * b.y - a.y * b.x).sum()
}

/// Even-odd crossing number, an oracle that shares no code with the above. For points off the boundary.
fn inside(outline: &[Point2], p: Point2) -> bool {
    let n = outline.len();
    let crosses = |i: &usize| {
        let (a, b) = (outline[*i], outline[(i + 1) % n]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..n).filter(crosses).count() % 2 == 1
}

/// Checks that the pieces have the polygon's area and cover exactly its points. Returns their number.
fn check(outline: &[Point2], s: &mut Stream) -> usize {
    let pieces = convex_pieces(outline).unwrap();
    let area: f64 = pieces.iter().map(|p| doubled_area(p.vertices())).sum();
    assert!((area - doubled_area(outline).abs()).abs() <= 1e-9 * area, "{outline:?}");
    for _ in 0..100 {
        let p = Point2::new(s.uniform(-6.0, 6.0), s.uniform(-6.0, 6.0));
        let holding = pieces.iter().filter(|piece| inside(piece.vertices(), p)).count();
        assert_eq!(holding, usize::from(inside(outline, p)), "{p:?} in {outline:?}");
    }
    pieces.len()
}

#[test]
fn concave_outlines_in_both_orientations_are_cut_into_few_pieces() {
    let mut s = Stream::new(Seed(1), "concave");
    let ell = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
    // two are the fewest for one reflex corner
    assert_eq!(check(&points(&ell), &mut s), 2);
    let mut clockwise = points(&ell);
    clockwise.reverse();
    assert_eq!(check(&clockwise, &mut s), 2);
    // a square with a straight corner is not strictly convex, but a polygon
    check(&points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]), &mut s);
    check(&points(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0001), (1.0, 3.0)]), &mut s);
    let comb = [(0., 0.), (5., 0.), (5., 3.), (4., 3.), (4., 1.), (3., 1.), (3., 3.), (2., 3.), (2., 1.), (0., 1.)];
    check(&points(&comb), &mut s);
}

#[test]
fn random_stars_are_cut_exactly() {
    let mut s = Stream::new(Seed(2), "stars");
    for _ in 0..200 {
        let n = 4 + s.below(40) as usize;
        // star-shaped about the origin, hence simple
        let vertex = |k: usize, r: f64| {
            let (sin, cos) = num::sin_cos(std::f64::consts::TAU * k as f64 / n as f64);
            Point2::new(r * cos, r * sin)
        };
        let outline: Vec<Point2> = (0..n).map(|k| vertex(k, s.uniform(0.5, 6.0))).collect();
        check(&outline, &mut s);
    }
}

/// `triangulate` without its memory: every corner is tried again for every triangle.
fn triangulate_plainly(outline: &[Point2]) -> Vec<Vec<usize>> {
    let turn = |i: usize, j: usize, k: usize| orientation(outline[i], outline[j], outline[k]);
    let mut ring: Vec<usize> = (0..outline.len()).collect();
    if clockwise(outline) {
        ring.reverse();
    }
    let mut triangles = Vec::new();
    while ring.len() > 3 {
        let m = ring.len();
        let around = |at: usize| (ring[(at + m - 1) % m], ring[at], ring[(at + 1) % m]);
        let is_ear = |&at: &usize| {
            let (i, j, k) = around(at);
            let inside = |&p: &usize| {
                p != i && p != j && p != k && turn(i, j, p) >= 0.0 && turn(j, k, p) >= 0.0 && turn(k, i, p) >= 0.0
            };
            turn(i, j, k) > 0.0 && !ring.iter().any(inside)
        };
        // a simple polygon always has an ear; the loop would end without one rather than hang
        let Some(ear) = (0..m).find(is_ear) else { break };
        let (i, j, k) = around(ear);
        triangles.push(vec![i, j, k]);
        ring.remove(ear);
    }
    triangles.push(ring);
    triangles
}

/// Joins two rings along an edge that they share in opposite directions; `None` if they share none.
fn join(a: &[usize], b: &[usize]) -> Option<Vec<usize>> {
    for i in 0..a.len() {
        let (from, to) = (a[i], a[(i + 1) % a.len()]);
        if let Some(j) = (0..b.len()).find(|&j| b[j] == to && b[(j + 1) % b.len()] == from) {
            // all of `a` from `to` around to `from`, then `b`'s vertices between `from` and `to`
            let mut ring: Vec<usize> = (1..=a.len()).map(|k| a[(i + k) % a.len()]).collect();
            ring.extend((2..b.len()).map(|k| b[(j + k) % b.len()]));
            return Some(ring);
        }
    }
    None
}

/// `merge` without its map of edges and its seams: every pair of pieces is tried again after every join, and all of
/// the result's corners.
fn merge_plainly(outline: &[Point2], mut pieces: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let mut at = 0;
    while at < pieces.len() {
        let joined = (at + 1..pieces.len()).find_map(|other| {
            let ring = join(&pieces[at], &pieces[other])?;
            ConvexPolygon::try_new(&corners(outline, &ring)).is_ok().then_some((other, ring))
        });
        match joined {
            Some((other, ring)) => {
                pieces[at] = ring;
                pieces.remove(other);
            }
            None => at += 1,
        }
    }
    pieces
}

/// A world's runs depend on its pieces, so the memory must not change which ear is clipped or which pieces are
/// joined.
#[test]
fn what_is_remembered_changes_no_piece() {
    let mut s = Stream::new(Seed(4), "pieces");
    let mut spirals = 0;
    for round in 0..60 {
        // the inside of a spiral's band of random width, out and back
        let n = 6 + s.below(60) as usize;
        let (wide, step) = (s.uniform(0.1, 0.45), s.uniform(0.15, 0.6));
        let at = |k: usize, r: f64| {
            let angle = step * k as f64;
            let r = r + 0.9 * angle / std::f64::consts::TAU + if round % 2 == 0 { 0.0 } else { 0.02 * (k % 3) as f64 };
            Point2::new(r * num::cos(angle), r * num::sin(angle))
        };
        let outline: Vec<Point2> = (0..n).map(|k| at(k, 1.0)).chain((0..n).rev().map(|k| at(k, 1.0 - wide))).collect();
        if check_simple(&outline).is_err() {
            continue;
        }
        spirals += 1;
        let triangles = triangulate_plainly(&outline);
        assert_eq!(triangulate(&outline), triangles, "{outline:?}");
        assert_eq!(merge(&outline, triangles.clone()), merge_plainly(&outline, triangles), "{outline:?}");
    }
    assert!(spirals > 40, "{spirals}");
    // stars whose pieces are joined to one of many corners; in some, edges are as short as the smallest feature
    let mut short = 0;
    for round in 0..60 {
        let n = 10 + s.below(60) as usize;
        let size = if round % 3 == 0 { 0.004 } else { 1.0 };
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
        let radius =
            |k: usize, s: &mut Stream| size * (if k.is_multiple_of(2) { 2.0 } else { 1.0 } + s.uniform(0.0, 0.05));
        let vertex = |k: usize, r: f64| Point2::new(r * num::cos(angle(k)), r * num::sin(angle(k)));
        let outline: Vec<Point2> = (0..n).map(|k| vertex(k, radius(k, &mut s))).collect();
        let triangles = triangulate(&outline);
        let merged = merge(&outline, triangles.clone());
        assert_eq!(merged, merge_plainly(&outline, triangles), "{outline:?}");
        short += usize::from(convex_pieces(&outline).is_err());
    }
    assert!((1..=20).contains(&short), "{short}");
}

#[test]
fn random_lattice_outlines_are_cut_exactly_or_refused() {
    // many collinear triples, coinciding vertices and crossings
    let mut s = Stream::new(Seed(3), "lattice");
    let mut cut = 0;
    for _ in 0..20_000 {
        let n = 4 + s.below(4) as usize;
        let outline: Vec<Point2> = (0..n).map(|_| Point2::new(s.below(4) as f64, s.below(4) as f64)).collect();
        if convex_pieces(&outline).is_ok() {
            check(&outline, &mut s);
            cut += 1;
        }
    }
    assert!(cut > 1000, "{cut}");
}

#[test]
fn what_is_no_outline_is_refused_with_its_vertices() {
    let refuse = |p: &[(f64, f64)]| convex_pieces(&points(p)).unwrap_err();
    let bow_tie = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
    assert_eq!(refuse(&bow_tie), OutlineError::Crossing { first: 0, second: 2 });
    // a spike, out and back on one line
    let spike = [(0.0, 0.0), (3.0, 0.0), (2.0, 0.0), (2.0, 2.0)];
    assert!(matches!(refuse(&spike), OutlineError::Crossing { first: 0, .. }));
    // a corner that touches the far edge
    let pinched = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 0.0), (0.0, 2.0)];
    assert!(matches!(refuse(&pinched), OutlineError::Crossing { first: 0, .. }));
    assert_eq!(refuse(&[(0.0, 0.0), (1.0, 0.0)]), OutlineError::Polygon(PolygonError::TooFewVertices(2)));
    let neck = [(0.0, 0.0), (2.0, 1.0), (4.0, 0.0), (4.0, 2.0), (2.0, 1.0005), (0.0, 2.0)];
    assert_eq!(refuse(&neck), OutlineError::TooNarrow);
    let many: Vec<(f64, f64)> = (0..1001).map(|k| (f64::from(k), f64::from(k % 2))).collect();
    assert_eq!(refuse(&many), OutlineError::TooManyVertices(1001));
}
