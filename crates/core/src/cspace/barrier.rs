//! `Barrier`, the blocked cells that part two configurations: a proof that no path joins them.

use super::vertex_cut::vertex_cut;
use super::{Blocking, Cell, CellMap, CellProof, CellState, Slice};
use crate::configuration::{AnyConfiguration, Configuration, Coordinates};
use crate::num::wrap;

/// A coordinate of the space that a barrier parts.
#[derive(Clone, Debug, PartialEq)]
pub struct BarrierAxis {
    /// Its name: `x`, `th1`.
    pub name: String,
    /// Whether it is an angle, whose values a whole turn apart are one. Any other ends at the world's bounds.
    pub wraps: bool,
}

/// A cell of a barrier, and what proves that it is blocked.
#[derive(Clone, Debug, PartialEq)]
pub struct BarrierCell {
    /// The coordinates of its middle.
    pub middle: Coordinates,
    /// Half its sides. Each is longer than the map's by some roundings, so that neighbours overlap in real numbers too.
    pub half: Coordinates,
    /// The part, the obstacle, and how deep the one is in the other.
    pub blocking: Blocking,
}

/// Blocked cells that part a start from a goal: no path joins the two, whoever looks for it.
///
/// A path is a curve of configurations, for a robot with a position within the world's bounds. Every cell is closed,
/// its sides belong to it, and every configuration in it is in contact, so a free path meets no cell. The start and the
/// goal lie in different pieces of what is left when all cells are taken away, and a curve can't go from one piece to
/// another. Nor can it go between two cells that share a corner alone, since the corner belongs to both.
///
/// So the proof rests on these, which another program can compute anew, as `tests/peers/barrier.py` does:
/// - that at the middle of each cell the part is as deep in the obstacle as [`Blocking::depth`] says, and no point of
///   it moves farther within the cell than [`Blocking::bound`];
/// - that the cells, at their exact places, part the two ends. Angles wrap;
/// - that robot, obstacles and bounds are those that were meant.
///
/// It does not rest on the search: not on the other cells, nor on how these were chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Barrier {
    /// The coordinates that vary, in the order in which places are given.
    pub axes: Vec<BarrierAxis>,
    /// Where the paths begin that there are not.
    pub start: Coordinates,
    /// Where they end.
    pub goal: Coordinates,
    /// The cells, coarse before fine.
    pub cells: Vec<BarrierCell>,
}

impl Barrier {
    /// The smallest barrier of a map's cells between two configurations, each cell counting as one; of several the one
    /// nearest to the start. It has at most as many cells as the map. `None` where the cells that are known so far do
    /// not part the two, where either lies in a blocked cell or outside the slice, and where the slice holds
    /// coordinates that matter: then a path may go round through these.
    ///
    /// It is a least cut of the map's leaves, joined where they share a side: ways through a side pass between two
    /// leaves, and a way through a corner touches the leaves beside it too.
    pub fn between<const N: usize>(
        map: &CellMap<N>,
        start: &AnyConfiguration,
        goal: &AnyConfiguration,
    ) -> Option<Barrier> {
        let slice = map.slice();
        let [start, goal] = [start, goal].map(|q| q.in_chart());
        if !slice.held().is_empty() || !slice.holds(&start) || !slice.holds(&goal) {
            return None;
        }
        let ends = [slice.point(&start), slice.point(&goal)];
        let [from, to] = ends.map(|p| leaves_at(map, p));
        if from.is_empty() || to.is_empty() {
            return None;
        }
        let cut = least_cut(map, &from, &to)?;
        let cells: Option<Vec<BarrierCell>> = cut.iter().map(|number| proven(map, map.cell(*number))).collect();
        let [start, goal] = ends.map(Coordinates::from);
        Some(Barrier { axes: axes(slice), start, goal, cells: cells? })
    }
}

fn axes<const N: usize>(slice: &Slice<N>) -> Vec<BarrierAxis> {
    let axis = |(i, name)| BarrierAxis { name, wraps: slice.wraps_along(i) };
    slice.names().into_iter().enumerate().map(axis).collect()
}

/// A blocked cell with its proof.
fn proven<const N: usize>(map: &CellMap<N>, cell: &Cell<N>) -> Option<BarrierCell> {
    let (middle, half) = map.place(cell);
    match map.slice().prove(middle, half) {
        CellProof::InContact(blocking) => {
            Some(BarrierCell { middle: middle.into(), half: map.slice().grown(half).into(), blocking })
        }
        _ => None,
    }
}

/// The leaves that hold a point: several where it lies on a side.
fn leaves_at<const N: usize>(map: &CellMap<N>, p: [f64; N]) -> Vec<usize> {
    let slice = map.slice();
    let holds = |(_, cell): &(usize, &Cell<N>)| {
        let (middle, half) = map.place(cell);
        let off = |i: usize| if slice.wraps_along(i) { wrap(p[i] - middle[i]) } else { p[i] - middle[i] };
        slice.grown(half).iter().enumerate().all(|(i, half)| off(i).abs() <= *half)
    };
    map.numbered_leaves().filter(holds).map(|(number, _)| number).collect()
}

/// The least cut between some leaves and others, by the numbers of its leaves. What can be reached from either side
/// past all blocked leaves is one vertex of the graph that is cut.
fn least_cut<const N: usize>(map: &CellMap<N>, from: &[usize], to: &[usize]) -> Option<Vec<usize>> {
    const START: usize = 0;
    const GOAL: usize = 1;
    let is_blocked = |number: usize| map.cell(number).state == CellState::Blocked;
    if from.iter().chain(to).any(|end| is_blocked(*end)) {
        return None;
    }
    let mut vertices = vec![None; map.node_count()];
    for (vertex, ends) in [(START, from), (GOAL, to)] {
        let mut open = ends.to_vec();
        while let Some(number) = open.pop() {
            match vertices[number] {
                Some(other) if other != vertex => return None,
                Some(_) => {}
                None => {
                    vertices[number] = Some(vertex);
                    open.extend(beside(map, number).into_iter().filter(|other| !is_blocked(*other)));
                }
            }
        }
    }
    let mut leaves = vec![None; 2];
    for (number, _) in map.numbered_leaves() {
        if vertices[number].is_none() {
            vertices[number] = Some(leaves.len());
            leaves.push(Some(number));
        }
    }
    let mut joined = vec![Vec::new(); leaves.len()];
    for (vertex, leaf) in leaves.iter().enumerate() {
        let Some(number) = leaf else { continue };
        for other in beside(map, *number).into_iter().filter_map(|other| vertices[other]) {
            joined[vertex].push(other);
            if leaves[other].is_none() {
                joined[other].push(vertex);
            }
        }
    }
    let can_cut: Vec<bool> = leaves.iter().map(|leaf| leaf.is_some_and(is_blocked)).collect();
    let cut = vertex_cut(&joined, &can_cut, &[START], &[GOAL])?;
    Some(cut.into_iter().filter_map(|vertex| leaves[vertex]).collect())
}

/// The leaves that share a side with a leaf, by their numbers; over the ends of an angle too.
fn beside<const N: usize>(map: &CellMap<N>, number: usize) -> Vec<usize> {
    let (side, span) = (1_u32 << map.finest(), map.span(map.cell(number)));
    let mut found = Vec::new();
    for i in 0..N {
        let wraps = map.slice().wraps_along(i);
        let [first, end] = span[i];
        // none beyond the last, where that is an edge
        let before = if first > 0 { Some(first - 1) } else { wraps.then_some(side - 1) };
        let after = if end < side { Some(end) } else { wraps.then_some(0) };
        for slab in [before, after].into_iter().flatten() {
            let mut ranges = span;
            ranges[i] = [slab, slab + 1];
            found.extend(map.leaves_within(ranges));
        }
    }
    found
}
