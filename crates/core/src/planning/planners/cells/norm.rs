//! `CellNorm`, a norm that is nowhere longer than a path, and by which edges and diagonals of cells are shortest ways.

use crate::num::{atan2, cos, greater, sin, sqrt};

/// How the length of a path is measured.
#[derive(Clone, Copy, Debug)]
pub(super) enum LengthMeasure {
    /// By the root of the sum of the squares of all coordinates, as an arm's joints turn; radians.
    Joints,
    /// By what the rear axle of a car drives, whose heading turns by at most a radian for each of these metres.
    Driven(f64),
}

/// Lengths of the edges and diagonals of cells that together make a norm, nowhere longer than the measure of a path.
///
/// In a plane of two coordinates the unit vectors `u` and `v`, one on either side of a cell's diagonal and as far from
/// it, make a norm: the greater of the products of either with a vector, all signs positive. It is at most the
/// vector's Euclidean length, and as long in the directions of the two. Where `u` would lie beyond the longer side, a
/// vector along that side takes its place, shorter than one, so that its product with the diagonal is that of `v`.
/// With a third coordinate the norm is a share of that and a share of what the third changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellNorm {
    /// The two coordinates of the plane, and of an edge along each the length.
    plane: [(usize, f64); 2],
    /// The length of a cell's diagonal in the plane.
    diagonal: f64,
    /// The third coordinate, and the length of an edge along it.
    third: Option<(usize, f64)>,
}

impl CellNorm {
    /// The norm by which a path is longest that changes by `along` in each coordinate, in cells of these sides.
    pub(super) fn for_path<const N: usize>(
        measure: LengthMeasure,
        plane: [usize; 2],
        steps: [f64; N],
        along: [f64; N],
    ) -> Self {
        // of the greatest change, so that no square vanishes
        let most = along.into_iter().fold(0.0, greater);
        let along = along.map(|change| if most > 0.0 { change / most } else { 1.0 });
        // the first side is the longer, so that the diagonal is nearer to it
        let [i, j] = if steps[plane[0]] >= steps[plane[1]] { plane } else { [plane[1], plane[0]] };
        let (diagonal, way) = (atan2(steps[j], steps[i]), atan2(along[j], along[i]));
        let (first, second) = if way <= diagonal { (way, 2.0 * diagonal - way) } else { (2.0 * diagonal - way, way) };
        let across = cos(second) * steps[i] + sin(second) * steps[j];
        // steeper than there is a mirror image for: then the first side counts as the diagonal does
        let side = if first < 0.0 { across } else { cos(first) * steps[i] };
        let third = (0..N).find(|k| !plane.contains(k));
        let flat = sqrt(along[i] * along[i] + along[j] * along[j]);
        let (share, rise) = match (third, measure) {
            (None, _) => (1.0, 0.0),
            (Some(k), LengthMeasure::Joints) => {
                let whole = sqrt(flat * flat + along[k] * along[k]);
                (flat / whole, along[k] / whole)
            }
            // the longer of both is at least any mixture of the two
            (Some(k), LengthMeasure::Driven(radius)) => {
                let turned = radius * along[k];
                let whole = flat * flat + turned * turned;
                (flat * flat / whole, turned * turned / whole * radius)
            }
        };
        CellNorm {
            plane: [(i, share * side), (j, share * sin(second) * steps[j])],
            diagonal: share * across,
            third: third.map(|k| (k, rise * steps[k])),
        }
    }

    /// The norm of a step, given in cells along each coordinate.
    pub(super) fn length<const N: usize>(&self, cells: [f64; N]) -> f64 {
        let [(i, first), (j, second)] = self.plane;
        let (x, y) = (cells[i].abs(), cells[j].abs());
        let flat = if x > y { y * self.diagonal + (x - y) * first } else { x * self.diagonal + (y - x) * second };
        flat + self.third.map_or(0.0, |(k, length)| length * cells[k].abs())
    }

    /// The corners of a cell that a step leads to from one of them.
    pub(super) fn next(&self, own: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let [(i, first), (j, second)] = self.plane;
        let flat = [(own ^ (1 << i), first), (own ^ (1 << j), second), (own ^ (1 << i) ^ (1 << j), self.diagonal)];
        flat.into_iter().chain(self.third.map(|(k, length)| (own ^ (1 << k), length)))
    }
}
