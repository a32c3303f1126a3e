//! Cuts what edges enclose into simple polygons, each monotone: no level line crosses one of them more than once.

use std::cmp::Ordering;

use super::sweep::{SweepEvent, UpEdge, is_lower, sweep};
use motion_lab_core::geometry::{Point2, orientation};
use motion_lab_core::worlds::MAX_CONCAVE_VERTICES;

/// Returns polygons, counter-clockwise, that cover what lies inside. Each edge has the inside on one side: on its right
/// where `right_inside` says so. The cuts lead from vertex to vertex (Lee and Preparata, 1977). A polygon has at most
/// [`MAX_CONCAVE_VERTICES`] corners, and no straight ones.
pub(super) fn faces(points: &[Point2], edges: &[UpEdge], right_inside: &[bool]) -> Vec<Vec<Point2>> {
    let mut links: Vec<Vec<usize>> = vec![Vec::new(); points.len()];
    for (edge, right) in edges.iter().zip(right_inside) {
        let (from, to) = if *right { (edge.high, edge.low) } else { (edge.low, edge.high) };
        links[from].push(to);
    }
    for [a, b] in diagonals(points, edges, right_inside) {
        links[a].push(b);
        links[b].push(a);
    }
    let mut polygons = Vec::new();
    for start in 0..links.len() {
        while let Some(next) = links[start].first().copied() {
            let ring = trace(points, &mut links, [start, next]);
            let ring = without_straight_corners(&ring.iter().map(|&v| points[v]).collect::<Vec<_>>());
            if ring.len() > MAX_CONCAVE_VERTICES {
                polygons.extend(triangles(&ring));
            } else if ring.len() > 2 {
                polygons.push(ring);
            }
        }
    }
    polygons
}

/// For an edge with the inside on its right: the last vertex that bounds that part of the inside.
#[derive(Clone, Copy, Default)]
struct ChainEnd {
    vertex: usize,
    /// Whether two parts of the inside join at it, and nothing goes on from it upward.
    joins: bool,
}

/// The cuts that leave monotone polygons only.
fn diagonals(points: &[Point2], edges: &[UpEdge], right_inside: &[bool]) -> Vec<[usize; 2]> {
    let mut ends = vec![ChainEnd::default(); edges.len()];
    let mut cuts = Vec::new();
    sweep(points, edges, |&SweepEvent { vertex, left, ending, beginning }| {
        // the edge on the left, if the vertex bounds the inside there
        let left = left.filter(|&e| right_inside[e]);
        for &e in left.iter().chain(ending).filter(|&&e| right_inside[e]) {
            let splits = ending.is_empty();
            if ends[e].joins || splits {
                cuts.push([ends[e].vertex, vertex]);
            }
        }
        if let Some(e) = left {
            ends[e] = ChainEnd { vertex, joins: beginning.is_empty() };
        }
        for &e in beginning {
            ends[e] = ChainEnd { vertex, joins: false };
        }
    });
    cuts
}

/// Takes the links around one face out, beginning with this one, and returns its vertices. The face lies on the left of
/// its links.
fn trace(points: &[Point2], links: &mut [Vec<usize>], [start, next]: [usize; 2]) -> Vec<usize> {
    let mut ring = vec![start];
    let (mut from, mut to) = (start, next);
    loop {
        links[from].retain(|v| *v != to);
        if to == start {
            return ring;
        }
        ring.push(to);
        let Some(onward) = first_clockwise(points, &links[to], from, to) else { return ring };
        (from, to) = (to, onward);
    }
}

/// The first of these vertices clockwise about `at`, seen from `from`.
fn first_clockwise(points: &[Point2], candidates: &[usize], from: usize, at: usize) -> Option<usize> {
    let (origin, back) = (points[at], points[from]);
    // what lies clockwise of the way back by less than half a turn comes first
    let late = |p: Point2| {
        let turn = orientation(origin, back, p);
        turn > 0.0 || (turn == 0.0 && (p - origin).dot(&(back - origin)) > 0.0)
    };
    candidates.iter().copied().min_by(|&v, &w| {
        let (p, q) = (points[v], points[w]);
        late(p).cmp(&late(q)).then_with(|| orientation(origin, p, q).partial_cmp(&0.0).unwrap_or(Ordering::Equal))
    })
}

/// Leaves out the corners that lie on the line of their neighbours.
fn without_straight_corners(ring: &[Point2]) -> Vec<Point2> {
    let n = ring.len();
    let is_corner = |i: &usize| orientation(ring[(i + n - 1) % n], ring[*i], ring[(i + 1) % n]) != 0.0;
    (0..n).filter(is_corner).map(|i| ring[i]).collect()
}

/// Cuts a monotone polygon, counter-clockwise, into triangles (Garey, Johnson, Preparata and Tarjan, 1978).
fn triangles(ring: &[Point2]) -> Vec<Vec<Point2>> {
    let n = ring.len();
    let lowest = (0..n).reduce(|l, i| if is_lower(ring[i], ring[l]) { i } else { l }).unwrap_or(0);
    // counter-clockwise, the right chain leads up from the lowest vertex
    let on_right = |i: usize| is_lower(ring[(i + n - 1) % n], ring[i]) && i != lowest;
    let mut order: Vec<usize> = (0..n).collect();
    let key = |i: &usize| (ring[*i].y, ring[*i].x);
    order.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal));
    let (mut stack, mut found): (Vec<usize>, Vec<Vec<Point2>>) = (Vec::new(), Vec::new());
    let mut cut = |i: usize, j: usize, k: usize| {
        let [a, b, c] = [ring[i], ring[j], ring[k]];
        let turn = orientation(a, b, c);
        if turn != 0.0 {
            found.push(if turn > 0.0 { vec![a, b, c] } else { vec![a, c, b] });
        }
    };
    for (place, &v) in order.iter().enumerate() {
        let opposite = stack.last().is_some_and(|&top| on_right(top) != on_right(v)) || place == n - 1;
        if opposite && stack.len() > 1 {
            stack.windows(2).for_each(|pair| cut(v, pair[0], pair[1]));
            stack.drain(..stack.len() - 1);
        } else {
            while let [.., below, top] = stack[..] {
                let turn = orientation(ring[below], ring[top], ring[v]);
                if (turn > 0.0) != on_right(v) || turn == 0.0 {
                    break;
                }
                cut(v, below, top);
                stack.pop();
            }
        }
        stack.push(v);
    }
    found
}
