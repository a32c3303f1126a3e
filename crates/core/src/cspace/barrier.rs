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
    pub fn between(map: &CellMap, start: &AnyConfiguration, goal: &AnyConfiguration) -> Option<Barrier> {
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
        let mut can_cut = vec![false; map.node_count()];
        map.numbered_leaves().for_each(|(number, cell)| can_cut[number] = cell.state == CellState::Blocked);
        let cut = vertex_cut(&neighbours(map), &can_cut, &from, &to)?;
        let cells: Option<Vec<BarrierCell>> = cut.iter().map(|number| proven(map, map.cell(*number))).collect();
        let [start, goal] = ends.map(Coordinates::from);
        Some(Barrier { axes: axes(slice), start, goal, cells: cells? })
    }
}

fn axes(slice: &Slice) -> Vec<BarrierAxis> {
    slice.names().into_iter().map(|name| BarrierAxis { name, wraps: slice.wraps() }).collect()
}

/// A blocked cell with its proof.
fn proven(map: &CellMap, cell: &Cell) -> Option<BarrierCell> {
    let (middle, half) = map.place(cell);
    match map.slice().prove(middle, half) {
        CellProof::InContact(blocking) => {
            Some(BarrierCell { middle: middle.into(), half: map.slice().grown(half).into(), blocking })
        }
        _ => None,
    }
}

/// The leaves that hold a point: several where it lies on a side.
fn leaves_at(map: &CellMap, p: [f64; 2]) -> Vec<usize> {
    let slice = map.slice();
    let holds = |(_, cell): &(usize, &Cell)| {
        let (middle, half) = map.place(cell);
        let off = [0, 1].map(|i| if slice.wraps() { wrap(p[i] - middle[i]) } else { p[i] - middle[i] });
        off.iter().zip(slice.grown(half)).all(|(off, half)| off.abs() <= half)
    };
    map.numbered_leaves().filter(holds).map(|(number, _)| number).collect()
}

/// The leaves that share a side with each leaf, by their numbers; over the edges of a torus too.
fn neighbours(map: &CellMap) -> Vec<Vec<usize>> {
    let side = 1_u32 << map.finest();
    let mut beside = vec![Vec::new(); map.node_count()];
    // the column or the row after a range; none beyond the last, where that is an edge
    let after = |end: u32| if end < side { Some(end) } else { map.slice().wraps().then_some(0) };
    for (number, cell) in map.numbered_leaves() {
        let [columns, rows] = map.span(cell);
        let right = after(columns[1]).map(|column| [[column, column + 1], rows]);
        let upper = after(rows[1]).map(|row| [columns, [row, row + 1]]);
        for ranges in [right, upper].into_iter().flatten() {
            for other in map.leaves_within(ranges) {
                beside[number].push(other);
                beside[other].push(number);
            }
        }
    }
    beside
}
