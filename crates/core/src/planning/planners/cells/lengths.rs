//! `CellLengths`, lengths along the edges and diagonals of cells, which no way between two corners undercuts.

use crate::num::{greater, lesser};
use crate::planning::Queue;

use super::norm::CellNorm;
use super::states::CellStates;

/// The shortest ways by a norm over the corners of open cells, along edges, diagonals of the norm's plane, and edges
/// across it.
///
/// No path through open cells from one corner to another is shorter by the norm. Let each corner have the length of the
/// shortest way there as its value, and each point of an edge the value between those of its ends.
///
/// - In a plane, two points of a cell's boundary differ in value by no more than the norm of the step between them. On
///   edges e and f that meet in a corner, at shares s and t from it, t the less, they differ by t times what the ends
///   of e and f differ by, and (s - t) times what the ends of e do: at most t diagonals and s - t edges, which is the
///   norm. On opposite edges, at shares s and t, they differ by t and 1 - s times the ends of edges across, and by
///   s - t times those of a diagonal: again the norm.
/// - So values are had within the cell that rise no faster: at each point the least of a boundary point's value and the
///   norm of the step from there (McShane, 1934). They depend on the cell's own corners alone.
/// - In space let this be so in the two faces across the third coordinate, and let values between the faces be
///   interpolated. Where all corners of a face have values greater than those of the other by at most an edge, all of
///   its points have, as the rule is monotone.
///
/// So there is a function on all open cells that rises nowhere faster than the norm, and along the path it rises from
/// 0 to the value at its end.
pub(super) struct CellLengths<'a, const N: usize> {
    cells: &'a CellStates<N>,
    /// The number of corners along each side.
    sides: [usize; N],
}

impl<'a, const N: usize> CellLengths<'a, N> {
    /// Over these cells, all of them open that are not blocked.
    pub(super) fn new(cells: &'a CellStates<N>) -> Self {
        CellLengths { cells, sides: cells.wraps.map(|wraps| cells.side + usize::from(!wraps)) }
    }

    /// By how much each coordinate changes straight from one point to another.
    pub(super) fn straight(&self, [start, goal]: [[f64; N]; 2]) -> [f64; N] {
        let off = self.off(self.cells.scaled(start), self.cells.scaled(goal));
        std::array::from_fn(|i| off[i].abs() * self.cells.steps[i])
    }

    /// A length that no path undercuts from the start to anywhere that is off the goal by no more than `reach` in each
    /// coordinate, and by how much the shortest way over corners changes in each; `None` where there is no way.
    pub(super) fn bound(
        &self,
        norm: &CellNorm,
        [start, goal]: [[f64; N]; 2],
        reach: [f64; N],
    ) -> Option<(f64, [f64; N])> {
        let (first, last) = (self.cells.scaled(start), self.cells.scaled(goal));
        let ahead = self.off(first, last);
        // behind the start, so that the way from there leads past it
        let behind = (0..N).filter(|i| ahead[*i] < 0.0).fold(0, |bits, i| bits | 1 << i);
        let from = self.corner(self.cells.index(first), behind);
        // an angle is reached whole by half a turn to either side
        let most = |i: usize| if self.cells.wraps[i] { 0.5 * self.cells.side as f64 } else { self.cells.side as f64 };
        let cells_of = |i: usize| lesser(greater(reach[i] / self.cells.steps[i], 0.0), most(i));
        let reach: [f64; N] = std::array::from_fn(cells_of);
        let ends = self.open_cells(last, reach);
        let corners = |cell: [usize; N]| (0..1_usize << N).map(move |bits| self.corner(cell, bits));
        let mut is_end = vec![false; self.sides.iter().product()];
        ends.iter().flat_map(|cell| corners(*cell)).for_each(|corner| is_end[corner] = true);
        let (lengths, before) = self.shortest(norm, from, last, &is_end);
        let spent = norm.length(self.off(self.at(from), first));
        // from the path's end to a corner of its cell: no farther than by way of the goal, nor than across the cell
        let (beside, across) = (norm.length(reach), norm.length([1.0; N]));
        let to_corner = |corner: usize| lesser(norm.length(self.off(self.at(corner), last)) + beside, across);
        let rest = |corner: &usize| lengths[*corner] - to_corner(*corner) - spent;
        let by_rest = |a: &usize, b: &usize| rest(a).total_cmp(&rest(b));
        // whichever of the cells the path ends in, each of its corners bounds it
        let best = ends.into_iter().filter_map(|cell| corners(cell).max_by(by_rest));
        let end = best.min_by(by_rest).filter(|end| lengths[*end].is_finite())?;
        let (mut changes, mut corner) = ([0.0; N], end);
        while corner != from {
            let off = self.off(self.at(before[corner]), self.at(corner));
            changes = std::array::from_fn(|i| changes[i] + off[i].abs() * self.cells.steps[i]);
            corner = before[corner];
        }
        Some((rest(&end), changes))
    }

    /// The lengths of the shortest ways from a corner to all ends that can be reached, and for each corner the one
    /// before it. The search goes toward a place (A*), whose distance by the norm no way undercuts.
    fn shortest(&self, norm: &CellNorm, from: usize, toward: [f64; N], is_end: &[bool]) -> (Vec<f64>, Vec<usize>) {
        let mut lengths = vec![f64::INFINITY; is_end.len()];
        let mut before = vec![from; lengths.len()];
        let (mut is_done, mut ends) = (vec![false; lengths.len()], is_end.iter().filter(|is_end| **is_end).count());
        let mut open = Queue::new();
        lengths[from] = 0.0;
        open.push(0.0, from);
        while ends > 0
            && let Some(corner) = open.pop()
        {
            if std::mem::replace(&mut is_done[corner], true) {
                continue;
            }
            ends -= usize::from(is_end[corner]);
            for (cell, own) in self.around(corner) {
                for (bits, step) in norm.next(own) {
                    let (other, length) = (self.corner(cell, bits), lengths[corner] + step);
                    if length < lengths[other] {
                        (lengths[other], before[other]) = (length, corner);
                        open.push(length + norm.length(self.off(self.at(other), toward)), other);
                    }
                }
            }
        }
        (lengths, before)
    }

    /// The open cells that hold places no farther than `reach` from a place along each coordinate.
    fn open_cells(&self, place: [f64; N], reach: [f64; N]) -> Vec<[usize; N]> {
        let side = self.cells.side as isize;
        let along = |i: usize| {
            let [low, high] = [place[i] - reach[i], place[i] + reach[i]].map(|x| x.floor() as isize);
            let wraps = self.cells.wraps[i];
            // a place on the last side is of the last cell
            let end = |x: isize| if wraps { x } else { x.clamp(0, side - 1) };
            (end(low)..=end(high)).map(move |x| x.rem_euclid(side) as usize)
        };
        let mut cells = vec![[0; N]];
        for i in 0..N {
            let with =
                |cell: [usize; N]| along(i).map(move |x| std::array::from_fn(|k| if k == i { x } else { cell[k] }));
            cells = cells.into_iter().flat_map(with).collect();
        }
        cells.retain(|cell| self.cells.is_open(*cell));
        cells
    }

    /// The cells from one place to another, angles the short way.
    fn off(&self, from: [f64; N], to: [f64; N]) -> [f64; N] {
        let turn = self.cells.side as f64;
        std::array::from_fn(|i| {
            let off = to[i] - from[i];
            if self.cells.wraps[i] { off - turn * (off / turn).round_ties_even() } else { off }
        })
    }

    /// The place of a corner.
    fn at(&self, corner: usize) -> [f64; N] {
        self.indices(corner).map(|index| index as f64)
    }

    fn indices(&self, mut corner: usize) -> [usize; N] {
        self.sides.map(|side| {
            let index = corner % side;
            corner /= side;
            index
        })
    }

    /// The number of a cell's corner: bit `i` of `bits` is set for the farther end along coordinate `i`.
    fn corner(&self, cell: [usize; N], bits: usize) -> usize {
        (0..N).rev().fold(0, |number, i| number * self.sides[i] + (cell[i] + (bits >> i & 1)) % self.sides[i])
    }

    /// The open cells at a corner, and which of theirs it is.
    fn around(&self, corner: usize) -> impl Iterator<Item = ([usize; N], usize)> + '_ {
        let (cells, place) = (self.cells, self.indices(corner));
        (0..1_usize << N).filter_map(move |bits| {
            let mut cell = place;
            for i in 0..N {
                if bits >> i & 1 == 1 {
                    let last = if cells.wraps[i] { Some(cells.side - 1) } else { None };
                    cell[i] = place[i].checked_sub(1).or(last)?;
                } else if cell[i] == cells.side {
                    return None;
                }
            }
            cells.is_open(cell).then_some((cell, bits))
        })
    }
}

#[cfg(test)]
mod tests;
