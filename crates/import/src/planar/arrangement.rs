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
    /// Whether the lines nowhere meet but in their own corners.
    is_uncut: bool,
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
            let corners: Vec<usize> = ring.points.iter().map(|p| pool.vertex(rounded(*p))).collect();
            for (i, &from) in corners.iter().enumerate() {
                all.pass(&pool.points, from, corners[(i + 1) % corners.len()], ring.layer, 1);
            }
        }
        for round in 0..MAX_ROUNDS {
            if all.passes.len() > MAX_EDGES {
                return Err(TooComplex);
            }
            *allowance = allowance.checked_sub((COST_OF_EDGE + layers) * all.passes.len()).ok_or(TooComplex)?;
            let edges: Vec<UpEdge> = all.passes.keys().map(|&(low, high)| UpEdge { low, high }).collect();
            let cuts = cuts(&edges, &mut pool, allowance)?;
            if cuts.is_empty() {
                let passes = all.passes.into_values().collect();
                let is_uncut = round == 0;
                return Ok(Arrangement { points: pool.points, edges, passes, layers, is_uncut });
            }
            all = all.cut(&pool.points, &cuts);
        }
        Err(TooComplex)
    }

    /// Whether a closed line is the border of a simple polygon, all of whose corners are apart. `allowance` is as for
    /// [`try_new`](Self::try_new); `false` also if it does not suffice.
    pub fn is_simple(ring: &[Point2], allowance: &mut usize) -> bool {
        let rings = [Ring { layer: 0, points: ring.to_vec() }];
        let cut = Arrangement::try_new(&rings, allowance);
        cut.is_ok_and(|cut| cut.is_uncut && cut.points.len() == ring.len() && cut.edges.len() == ring.len())
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

/// Rounds a length in metres to micrometres.
pub(crate) fn micro(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}

/// Rounds a point to micrometres.
pub(crate) fn rounded(p: Point2) -> Point2 {
    Point2::new(micro(p.x), micro(p.y))
}

/// Where two segments cross in their insides, rounded to micrometres.
fn crossing([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Option<Point2> {
    let (c_side, d_side) = (orientation(a, b, c), orientation(a, b, d));
    let (a_side, b_side) = (orientation(c, d, a), orientation(c, d, b));
    if c_side * d_side >= 0.0 || a_side * b_side >= 0.0 {
        return None;
    }
    let p = a + (b - a) * (a_side / (a_side - b_side));
    Some(rounded(p))
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::cross;
    use motion_lab_core::random::{Seed, Stream};
    use motion_lab_core::worlds::convex_pieces;

    /// How often a closed line leads around a point: the sum of the signs of its edges that pass above it. Shares no
    /// code with the sweep.
    fn winding(ring: &[Point2], p: Point2) -> i32 {
        let edge = |i: usize| (ring[i], ring[(i + 1) % ring.len()]);
        let above = |(a, b): (Point2, Point2)| {
            let spans = (a.x > p.x) != (b.x > p.x);
            let y = a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x);
            if spans && y > p.y { if b.x > a.x { -1 } else { 1 } } else { 0 }
        };
        (0..ring.len()).map(edge).map(above).sum()
    }

    fn border_distance(ring: &[Point2], p: Point2) -> f64 {
        let edge = |i: usize| Segment::new(ring[i], ring[(i + 1) % ring.len()]);
        (0..ring.len()).map(|i| (edge(i).closest_point(p) - p).norm()).fold(f64::INFINITY, lesser)
    }

    /// Checks that the faces are simple polygons that cover exactly what a rule says, at random places away from the
    /// lines. Returns how many places were inside.
    fn check(rings: &[Ring], rule: impl Fn(&[i32]) -> bool, s: &mut Stream) -> usize {
        let layers = rings.iter().map(|ring| ring.layer + 1).max().unwrap();
        let faces = Arrangement::try_new(rings, &mut 10_000_000).ok().unwrap().inside(&rule);
        for face in &faces {
            assert!(convex_pieces(face).is_ok(), "{:?}: {face:?} of {rings:?}", convex_pieces(face));
            let area: f64 = (1..face.len() - 1).map(|i| cross(face[i] - face[0], face[i + 1] - face[0])).sum();
            assert!(area > 0.0, "{face:?}");
        }
        let mut inside = 0;
        for _ in 0..60 {
            let p = Point2::new(s.uniform(-1.0, 9.0), s.uniform(-1.0, 9.0));
            // crossings are rounded, and vertices may move by a millimetre
            if rings.iter().any(|ring| border_distance(&ring.points, p) < 3e-3) {
                continue;
            }
            let mut windings = vec![0; layers];
            rings.iter().for_each(|ring| windings[ring.layer] += winding(&ring.points, p));
            let holding = faces.iter().filter(|face| winding(face, p) != 0).count();
            assert_eq!(holding, usize::from(rule(&windings)), "{p:?} {windings:?} in {rings:?}");
            inside += holding;
        }
        inside
    }

    #[test]
    fn random_lines_enclose_what_their_rule_says() {
        let mut s = Stream::new(Seed(1), "rings");
        let mut inside = 0;
        for round in 0..600 {
            // on a lattice many corners, edges and crossings coincide
            let lattice = round % 2 == 0;
            let ring = |s: &mut Stream, layer: usize| {
                let n = 3 + s.below(9) as usize;
                let place = |s: &mut Stream| if lattice { s.below(9) as f64 } else { s.uniform(0.0, 8.0) };
                Ring { layer, points: (0..n).map(|_| Point2::new(place(s), place(s))).collect() }
            };
            let count = 1 + s.below(3) as usize;
            let mut rings: Vec<Ring> = (0..count).map(|_| ring(&mut s, 0)).collect();
            inside += check(&rings, |w| w[0] != 0, &mut s);
            inside += check(&rings, |w| w[0] % 2 != 0, &mut s);
            rings.push(ring(&mut s, 1));
            inside += check(&rings, |w| w[0] != 0 && w[1] % 2 != 0, &mut s);
        }
        assert!(inside > 10_000, "{inside}");
    }

    #[test]
    fn lines_of_tiny_steps_are_cut_too() {
        // steps of about a millimetre: corners join, edges vanish
        let mut s = Stream::new(Seed(2), "tiny");
        for _ in 0..300 {
            let n = 3 + s.below(40) as usize;
            let ring = |s: &mut Stream| Ring {
                layer: 0,
                points: (0..n).map(|_| Point2::new(s.uniform(0.0, 0.01), s.uniform(0.0, 0.01))).collect(),
            };
            let rings = [ring(&mut s), ring(&mut s)];
            let Ok(arrangement) = Arrangement::try_new(&rings, &mut 10_000_000) else { panic!("{rings:?}") };
            for face in arrangement.inside(|w| w[0] != 0) {
                assert!(convex_pieces(&face).is_ok(), "{face:?}");
            }
        }
    }

    #[test]
    fn large_monotone_polygons_are_cut_into_triangles() {
        // a comb of 1,500 teeth, lying on its side so that it is monotone
        let teeth = (0..1_500).flat_map(|k| {
            let y = f64::from(k) * 0.005;
            [Point2::new(1.0, y), Point2::new(2.0 + 0.1 * f64::from(k % 3), y + 0.0025)]
        });
        let points: Vec<Point2> =
            teeth.chain([Point2::new(1.0, 7.5), Point2::new(0.0, 7.4), Point2::new(0.0, 0.1)]).collect();
        let mut s = Stream::new(Seed(3), "comb");
        let rings = [Ring { layer: 0, points }];
        let inside: usize = (0..5).map(|_| check(&rings, |w| w[0] != 0, &mut s)).sum();
        assert!(inside > 5, "{inside}");
        let faces = Arrangement::try_new(&rings, &mut 10_000_000).ok().unwrap().inside(|w| w[0] != 0);
        assert!(faces.len() > 2_000, "{} triangles", faces.len());
    }
}
