//! A sweep from below over edges that do not cross: each vertex with the edges that end, begin and pass beside it.

use std::cmp::Ordering;

use motion_lab_core::geometry::{Point2, orientation};

/// An edge from its lower to its higher vertex. Of two vertices at one height, the left one is lower.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct UpEdge {
    pub low: usize,
    pub high: usize,
}

/// A vertex that the sweep has reached. Edges are named by their index, from left to right.
pub(super) struct SweepEvent<'a> {
    pub vertex: usize,
    /// The nearest edge to the left that passes the vertex.
    pub left: Option<usize>,
    /// The edges that end at the vertex.
    pub ending: &'a [usize],
    /// The edges that begin there.
    pub beginning: &'a [usize],
}

/// Whether the first point is lower than the second, or at its height and left of it.
pub(super) fn is_lower(a: Point2, b: Point2) -> bool {
    (a.y, a.x) < (b.y, b.x)
}

/// Visits the vertices of `edges` from below. No two edges may cross, and none may pass through a vertex.
pub(super) fn sweep(points: &[Point2], edges: &[UpEdge], mut visit: impl FnMut(&SweepEvent)) {
    let mut beginning: Vec<Vec<usize>> = vec![Vec::new(); points.len()];
    let mut used = vec![false; points.len()];
    for (e, edge) in edges.iter().enumerate() {
        beginning[edge.low].push(e);
        (used[edge.low], used[edge.high]) = (true, true);
    }
    let mut order: Vec<usize> = (0..points.len()).filter(|&v| used[v]).collect();
    let key = |v: &usize| (points[*v].y, points[*v].x);
    order.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal));
    // the edges that cross the height of the sweep, from left to right
    let mut status: Vec<usize> = Vec::new();
    for vertex in order {
        let turn = |e: &usize| orientation(points[edges[*e].low], points[edges[*e].high], points[vertex]);
        let from = status.partition_point(|e| turn(e) < 0.0);
        let to = from + status[from..].partition_point(|e| edges[*e].high == vertex);
        let fan = &mut beginning[vertex];
        let to_right = |a: usize, b: usize| orientation(points[vertex], points[edges[a].high], points[edges[b].high]);
        fan.sort_by(|&a, &b| to_right(a, b).partial_cmp(&0.0).unwrap_or(Ordering::Equal));
        let left = from.checked_sub(1).map(|i| status[i]);
        visit(&SweepEvent { vertex, left, ending: &status[from..to], beginning: fan });
        status.splice(from..to, fan.iter().copied());
    }
}
