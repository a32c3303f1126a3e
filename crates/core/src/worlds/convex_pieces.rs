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
mod tests;
