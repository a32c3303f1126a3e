//! Cuts a simple polygon into convex pieces, by exact predicates and without new vertices.

use std::collections::BTreeMap;

use crate::geometry::{ConvexPolygon, MIN_FEATURE, Point2, PolygonError, orientation};
use crate::num;

/// Largest number of vertices of a concave polygon. Cutting it up takes at least quadratic time.
pub const MAX_CONCAVE_VERTICES: usize = 1000;

/// Why a list of vertices is not the outline of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// Too few vertices, one out of range, an edge too short.
    #[error(transparent)]
    Polygon(PolygonError),
    /// Two edges cross, or touch elsewhere than at their common vertex.
    #[error("the edges after vertex {first} and vertex {second} cross or touch")]
    Crossing {
        /// The vertex before one edge.
        first: usize,
        /// The vertex before the other.
        second: usize,
    },
    /// Concave, with more than [`MAX_CONCAVE_VERTICES`] vertices.
    #[error("{0} vertices: a polygon that is not convex may have at most {MAX_CONCAVE_VERTICES}")]
    TooManyVertices(usize),
    /// Two vertices so close that no cut between them gives pieces of the smallest size.
    #[error("a part is narrower than {MIN_FEATURE} m")]
    TooNarrow,
}

/// Cuts a simple polygon into convex pieces, which overlap in their edges only. `outline` holds its vertices in either
/// orientation; straight corners are allowed. A strictly convex polygon is returned whole.
///
/// First ears are clipped: every simple polygon has one (Meisters, 1975). Then triangles are merged across their common
/// edges as long as the result is strictly convex (Hertel and Mehlhorn, 1983). This leaves at most four times the
/// fewest pieces possible.
///
/// # Errors
/// [`OutlineError`] names the vertices: an outline that crosses or touches itself, too few vertices, numbers out of
/// range.
pub fn convex_pieces(outline: &[Point2]) -> Result<Vec<ConvexPolygon>, OutlineError> {
    match ConvexPolygon::try_new(outline) {
        Ok(convex) => return Ok(vec![convex]),
        Err(PolygonError::NotConvex(_) | PolygonError::SelfCrossing) => {}
        Err(error) => return Err(OutlineError::Polygon(error)),
    }
    if outline.len() > MAX_CONCAVE_VERTICES {
        return Err(OutlineError::TooManyVertices(outline.len()));
    }
    check_simple(outline)?;
    let triangles = triangulate(outline);
    let pieces = merge(outline, triangles);
    let convex = |piece: &Vec<usize>| ConvexPolygon::try_new(&corners(outline, piece));
    // the pieces are strictly convex by construction, so only a short edge can be refused
    pieces.iter().map(convex).collect::<Result<_, _>>().map_err(|_| OutlineError::TooNarrow)
}

fn corners(outline: &[Point2], piece: &[usize]) -> Vec<Point2> {
    piece.iter().map(|&i| outline[i]).collect()
}

/// Whether the closed segments `a b` and `c d` have a point in common, exactly.
fn segments_meet([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> bool {
    let apart =
        |p: f64, q: f64, r: f64, s: f64| (p < r && p < s && q < r && q < s) || (p > r && p > s && q > r && q > s);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    // for collinear segments each sign is 0, and the boxes have decided
    let sign = |x: f64| if x == 0.0 { 0 } else { x.signum() as i32 };
    let (c_side, d_side) = (sign(orientation(a, b, c)), sign(orientation(a, b, d)));
    let (a_side, b_side) = (sign(orientation(c, d, a)), sign(orientation(c, d, b)));
    c_side * d_side <= 0 && a_side * b_side <= 0
}

/// Checks that no two edges meet, except neighbours in their common vertex.
fn check_simple(outline: &[Point2]) -> Result<(), OutlineError> {
    let n = outline.len();
    let edge = |i: usize| [outline[i], outline[(i + 1) % n]];
    for first in 0..n {
        for second in first + 1..n {
            let ([a, b], [c, d]) = (edge(first), edge(second));
            let neighbours = second == first + 1 || (first == 0 && second == n - 1);
            let meet = if neighbours {
                // `q` is the common vertex; a spike turns by half a circle there
                let [p, q, r] = if second == first + 1 { [a, b, d] } else { [c, d, b] };
                orientation(p, q, r) == 0.0 && (p - q).dot(&(r - q)) > 0.0
            } else {
                segments_meet([a, b], [c, d])
            };
            if meet {
                return Err(OutlineError::Crossing { first, second });
            }
        }
    }
    Ok(())
}

/// Triangulates a simple polygon by clipping the first ear along the ring. Returns the vertex indices of each triangle,
/// counter-clockwise. No triangle is flat.
///
/// For each corner that is not an ear, one obstructing vertex is remembered: the corner itself if it is not convex, or
/// a vertex within its triangle. It obstructs the corner until it is clipped or the corner gets another neighbour.
/// Without this memory a spiral of n corners takes n^3 steps.
fn triangulate(outline: &[Point2]) -> Vec<Vec<usize>> {
    let turn = |i: usize, j: usize, k: usize| orientation(outline[i], outline[j], outline[k]);
    let mut ring: Vec<usize> = (0..outline.len()).collect();
    if clockwise(outline) {
        ring.reverse();
    }
    let mut in_the_way: Vec<Option<usize>> = vec![None; outline.len()];
    let mut clipped = vec![false; outline.len()];
    let mut triangles = Vec::new();
    while ring.len() > 3 {
        let m = ring.len();
        let around = |at: usize| (ring[(at + m - 1) % m], ring[at], ring[(at + 1) % m]);
        let mut is_ear = |&at: &usize| {
            let (i, j, k) = around(at);
            if in_the_way[j].is_some_and(|p| !clipped[p]) {
                return false;
            }
            let inside = |&p: &usize| {
                p != i && p != j && p != k && turn(i, j, p) >= 0.0 && turn(j, k, p) >= 0.0 && turn(k, i, p) >= 0.0
            };
            in_the_way[j] = if turn(i, j, k) > 0.0 { ring.iter().copied().find(inside) } else { Some(j) };
            in_the_way[j].is_none()
        };
        // a simple polygon always has an ear; the loop would end without one rather than hang
        let Some(ear) = (0..m).find(&mut is_ear) else { break };
        let (i, j, k) = around(ear);
        triangles.push(vec![i, j, k]);
        (in_the_way[i], in_the_way[k], clipped[j]) = (None, None, true);
        ring.remove(ear);
    }
    triangles.push(ring);
    triangles
}

/// Whether an outline is clockwise, by the turn at its lowest, leftmost corner.
fn clockwise(outline: &[Point2]) -> bool {
    let n = outline.len();
    let lowest = (0..n).reduce(|l, i| if (outline[i].y, outline[i].x) < (outline[l].y, outline[l].x) { i } else { l });
    let lowest = lowest.unwrap_or(0);
    // lexicographically extreme, hence a vertex of the hull and never straight in a simple polygon
    orientation(outline[(lowest + n - 1) % n], outline[lowest], outline[(lowest + 1) % n]) < 0.0
}

/// Joins pieces across common edges while the result stays strictly convex. Each piece is joined with the first later
/// piece that fits.
///
/// Both are strictly convex, so only the two corners where they are joined are tested, and that no edge stays that is
/// shorter than the smallest feature.
fn merge(outline: &[Point2], pieces: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let edges = |ring: &[usize]| (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()])).collect::<Vec<_>>();
    let length = |i: usize, j: usize| num::hypot(outline[j].x - outline[i].x, outline[j].y - outline[i].y);
    let is_short = |&(i, j): &(usize, usize)| length(i, j) < MIN_FEATURE;
    let mut short: Vec<usize> = pieces.iter().map(|ring| edges(ring).iter().filter(|e| is_short(e)).count()).collect();
    // each directed edge is in one piece, and its neighbour across it has the edge the other way round
    let mut owners: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (piece, ring) in pieces.iter().enumerate() {
        owners.extend(edges(ring).into_iter().map(|edge| (edge, piece)));
    }
    let mut pieces: Vec<Option<Vec<usize>>> = pieces.into_iter().map(Some).collect();
    for at in 0..pieces.len() {
        while let Some(ring) = &pieces[at] {
            // convex pieces share one edge at most
            let across = |edge: (usize, usize)| Some((*owners.get(&(edge.1, edge.0))?, edge));
            let beside: BTreeMap<usize, (usize, usize)> = edges(ring).into_iter().filter_map(across).collect();
            let joined = beside.range(at + 1..).find_map(|(&other, edge)| {
                let left = (short[at] + short[other]).checked_sub(2 * usize::from(is_short(edge)))?;
                let seam = Seam::of(ring, pieces[other].as_ref()?, *edge)?;
                (left == 0 && seam.is_convex(outline)).then(|| (other, seam.ring()))
            });
            let Some((other, ring)) = joined else { break };
            owners.extend(edges(&ring).into_iter().map(|edge| (edge, at)));
            (pieces[at], pieces[other], short[at]) = (Some(ring), None, 0);
        }
    }
    pieces.into_iter().flatten().collect()
}

/// Two rings beside one another, and where in them their common edge is.
struct Seam<'a> {
    a: &'a [usize],
    b: &'a [usize],
    /// Where in `a` the edge begins, and where in `b` the same edge does, which goes the other way there.
    at: (usize, usize),
}

impl<'a> Seam<'a> {
    fn of(a: &'a [usize], b: &'a [usize], (from, to): (usize, usize)) -> Option<Self> {
        let at = (a.iter().position(|&v| v == from)?, b.iter().position(|&v| v == to)?);
        Some(Seam { a, b, at })
    }

    /// Whether both corners where the rings are joined turn to the left.
    fn is_convex(&self, outline: &[Point2]) -> bool {
        let &Seam { a, b, at: (i, j) } = self;
        let turns = |i: usize, j: usize, k: usize| orientation(outline[i], outline[j], outline[k]) > 0.0;
        let (before, after) = (a[(i + a.len() - 1) % a.len()], a[(i + 2) % a.len()]);
        turns(before, a[i], b[(j + 2) % b.len()]) && turns(b[(j + b.len() - 1) % b.len()], b[j], after)
    }

    /// The ring round both: all of `a` from the edge's end around to its beginning, then `b`'s vertices between.
    fn ring(&self) -> Vec<usize> {
        let &Seam { a, b, at: (i, j) } = self;
        let first = (1..=a.len()).map(|k| a[(i + k) % a.len()]);
        first.chain((2..b.len()).map(|k| b[(j + k) % b.len()])).collect()
    }
}

#[cfg(test)]
mod tests {
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
                let r =
                    r + 0.9 * angle / std::f64::consts::TAU + if round % 2 == 0 { 0.0 } else { 0.02 * (k % 3) as f64 };
                Point2::new(r * num::cos(angle), r * num::sin(angle))
            };
            let outline: Vec<Point2> =
                (0..n).map(|k| at(k, 1.0)).chain((0..n).rev().map(|k| at(k, 1.0 - wide))).collect();
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
            let radius = |k: usize, s: &mut Stream| size * (if k % 2 == 0 { 2.0 } else { 1.0 } + s.uniform(0.0, 0.05));
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
}
