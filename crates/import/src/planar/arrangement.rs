//! `Arrangement`, closed lines cut where they cross.

use std::collections::{BTreeMap, BTreeSet};

use super::faces::faces;
use super::sweep::{UpEdge, is_lower, sweep};
use super::vertices::VertexPool;
use motion_lab_core::geometry::{Point2, Segment, orientation};
use motion_lab_core::num::{greater, lesser};

/// A closed line in a layer. Lines of one layer share their winding numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ring {
    pub layer: usize,
    pub points: Vec<Point2>,
}

/// The lines cross too often to be cut within bounded time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooComplex;

/// Vertices this close to an edge lie on it, metres. Coordinates are rounded to half of it.
const ON_EDGE: f64 = 2e-6;

/// Largest number of rounds in which crossings are looked for: moving one to a rounded place may make others.
const MAX_ROUNDS: usize = 30;

/// Largest number of edges.
const MAX_EDGES: usize = 200_000;

/// How many comparisons cost as much as sorting an edge in.
const COST_OF_EDGE: usize = 50;

/// How many comparisons cost as much as one cut.
const COST_OF_CUT: usize = 500;

/// How often an edge is passed, for each layer: upward less downward.
type Passes = Vec<i32>;

/// Closed lines cut where they cross: edges that meet in their vertices only, with how often each layer passes them.
/// Vertices are at least the smallest feature of a world apart, so a vertex may lie up to that far from where the lines
/// have it.
pub(crate) struct Arrangement {
    points: Vec<Point2>,
    edges: Vec<UpEdge>,
    passes: Vec<Passes>,
    layers: usize,
}

impl Arrangement {
    /// Cuts the rings. `allowance` counts the pairs of edges that may still be compared.
    ///
    /// # Errors
    /// [`TooComplex`] if the allowance does not suffice, or there are too many edges.
    pub fn try_new(rings: &[Ring], allowance: &mut usize) -> Result<Self, TooComplex> {
        let layers = rings.iter().map(|ring| ring.layer + 1).max().unwrap_or(0);
        let mut pool = VertexPool::default();
        let mut all = EdgeTable { passes: BTreeMap::new(), layers };
        for ring in rings {
            let corners: Vec<usize> = ring.points.iter().map(|p| pool.vertex(*p)).collect();
            for (i, &from) in corners.iter().enumerate() {
                all.pass(&pool.points, from, corners[(i + 1) % corners.len()], ring.layer, 1);
            }
        }
        for _ in 0..MAX_ROUNDS {
            if all.passes.len() > MAX_EDGES {
                return Err(TooComplex);
            }
            *allowance = allowance.checked_sub(COST_OF_EDGE * all.passes.len()).ok_or(TooComplex)?;
            let edges: Vec<UpEdge> = all.passes.keys().map(|&(low, high)| UpEdge { low, high }).collect();
            let cuts = cuts(&edges, &mut pool, allowance)?;
            if cuts.is_empty() {
                let passes = all.passes.into_values().collect();
                return Ok(Arrangement { points: pool.points, edges, passes, layers });
            }
            all = all.cut(&pool.points, &cuts);
        }
        Err(TooComplex)
    }

    /// Returns the simple polygons that together cover what is inside: where `is_inside` holds for the winding numbers,
    /// one for each layer. They overlap in their borders only.
    pub fn inside(&self, is_inside: impl Fn(&[i32]) -> bool) -> Vec<Vec<Point2>> {
        let mut right: Vec<Passes> = vec![vec![0; self.layers]; self.edges.len()];
        let mut sides = vec![[false; 2]; self.edges.len()];
        sweep(&self.points, &self.edges, |event| {
            let mut winding = event.left.map_or_else(|| vec![0; self.layers], |e| right[e].clone());
            for &e in event.beginning {
                let left_inside = is_inside(&winding);
                winding.iter_mut().zip(&self.passes[e]).for_each(|(w, pass)| *w -= pass);
                sides[e] = [left_inside, is_inside(&winding)];
                right[e].clone_from(&winding);
            }
        });
        let borders = (0..self.edges.len()).filter(|&e| sides[e][0] != sides[e][1]);
        let (edges, right_inside): (Vec<UpEdge>, Vec<bool>) = borders.map(|e| (self.edges[e], sides[e][1])).unzip();
        faces(&self.points, &edges, &right_inside)
    }
}

/// The edges by their lower and higher vertex.
struct EdgeTable {
    passes: BTreeMap<(usize, usize), Passes>,
    layers: usize,
}

impl EdgeTable {
    /// Adds passes of an edge from one vertex to another; none if they are the same.
    fn pass(&mut self, points: &[Point2], from: usize, to: usize, layer: usize, times: i32) {
        if from == to {
            return;
        }
        let (key, times) = if is_lower(points[from], points[to]) { ((from, to), times) } else { ((to, from), -times) };
        self.passes.entry(key).or_insert_with(|| vec![0; self.layers])[layer] += times;
    }

    /// The table with the edges of `cuts` led through these vertices. Edges that no layer passes in sum are dropped.
    fn cut(self, points: &[Point2], cuts: &BTreeMap<(usize, usize), BTreeSet<usize>>) -> EdgeTable {
        let mut new = EdgeTable { passes: BTreeMap::new(), layers: self.layers };
        for ((low, high), passes) in self.passes {
            let (a, b) = (points[low], points[high]);
            let along = |v: &usize| (points[*v] - a).dot(&(b - a));
            let mut stops: Vec<usize> = cuts.get(&(low, high)).into_iter().flatten().copied().collect();
            stops.sort_by(|v, w| along(v).partial_cmp(&along(w)).unwrap_or(std::cmp::Ordering::Equal));
            stops.push(high);
            let mut from = low;
            for to in stops {
                for (layer, &times) in passes.iter().enumerate().filter(|(_, times)| **times != 0) {
                    new.pass(points, from, to, layer, times);
                }
                from = to;
            }
        }
        new.passes.retain(|_, passes| passes.iter().any(|times| *times != 0));
        new
    }
}

/// Finds where edges cross, or pass through vertices: for each such edge the vertices in which to cut it.
fn cuts(
    edges: &[UpEdge],
    pool: &mut VertexPool,
    allowance: &mut usize,
) -> Result<BTreeMap<(usize, usize), BTreeSet<usize>>, TooComplex> {
    let mut cuts: BTreeMap<(usize, usize), BTreeSet<usize>> = BTreeMap::new();
    let spans: Vec<[f64; 4]> = edges.iter().map(|e| span(pool.points[e.low], pool.points[e.high])).collect();
    let mut order: Vec<usize> = (0..edges.len()).collect();
    order.sort_by(|&a, &b| spans[a][0].partial_cmp(&spans[b][0]).unwrap_or(std::cmp::Ordering::Equal));
    for (at, &i) in order.iter().enumerate() {
        for &j in &order[at + 1..] {
            if spans[j][0] > spans[i][1] {
                break;
            }
            *allowance = allowance.checked_sub(1).ok_or(TooComplex)?;
            if spans[j][2] > spans[i][3] || spans[i][2] > spans[j][3] {
                continue;
            }
            for (edge, vertex) in meeting(edges[i], edges[j], pool) {
                *allowance = allowance.checked_sub(COST_OF_CUT).ok_or(TooComplex)?;
                cuts.entry((edge.low, edge.high)).or_default().insert(vertex);
            }
        }
    }
    Ok(cuts)
}

/// The box around an edge, with room for what counts as on it: from and to in x, from and to in y.
fn span(a: Point2, b: Point2) -> [f64; 4] {
    let (low, high) = ((lesser(a.x, b.x), lesser(a.y, b.y)), (greater(a.x, b.x), greater(a.y, b.y)));
    [low.0 - ON_EDGE, high.0 + ON_EDGE, low.1 - ON_EDGE, high.1 + ON_EDGE]
}

/// The edges of two that have to be cut, each with the vertex.
fn meeting(e: UpEdge, f: UpEdge, pool: &mut VertexPool) -> Vec<(UpEdge, usize)> {
    let mut found = Vec::new();
    let at = |v: usize| pool.points[v];
    for (edge, other) in [(e, f), (f, e)] {
        for v in [other.low, other.high].into_iter().filter(|&v| v != edge.low && v != edge.high) {
            let nearest = Segment::new(at(edge.low), at(edge.high)).closest_point(at(v));
            // the ends are other vertices, hence farther off
            if (nearest - at(v)).norm() <= ON_EDGE {
                found.push((edge, v));
            }
        }
    }
    if found.is_empty()
        && let Some(crossing) = crossing([at(e.low), at(e.high)], [at(f.low), at(f.high)])
    {
        let v = pool.vertex(crossing);
        found.extend([e, f].into_iter().filter(|edge| v != edge.low && v != edge.high).map(|edge| (edge, v)));
    }
    found
}

/// Where two segments cross in their insides, rounded to micrometres.
fn crossing([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Option<Point2> {
    let (c_side, d_side) = (orientation(a, b, c), orientation(a, b, d));
    let (a_side, b_side) = (orientation(c, d, a), orientation(c, d, b));
    if c_side * d_side >= 0.0 || a_side * b_side >= 0.0 {
        return None;
    }
    let p = a + (b - a) * (a_side / (a_side - b_side));
    let micro = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
    Some(Point2::new(micro(p.x), micro(p.y)))
}
