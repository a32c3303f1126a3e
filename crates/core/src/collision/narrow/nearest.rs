//! `NearestSearch`, the nearest piece to a shape.

use super::convex::{NearestPoints, plainly_overlap};
use super::core_lanes::LaneRoom;
use super::distance::{nearest_across, nearest_measured};
use super::half_planes::Sides;
use super::pair::pair_within;
use super::separating_line::{Parting, SureParting};
use crate::geometry::{Aabb, Placed};

/// A search under way for the piece nearest to a shape, the first in file order among equals.
pub(crate) struct NearestSearch<'a> {
    shape: &'a Placed,
    among: PieceList<'a>,
    within: f64,
    best: Option<(usize, NearestPoints)>,
    sides: Option<Sides>,
}

/// The pieces of a scene.
#[derive(Clone, Copy)]
pub(crate) struct PieceList<'a> {
    pub(crate) pieces: &'a [Placed],
    /// The number of the obstacle that each piece belongs to.
    pub(crate) owners: &'a [u32],
    /// An upper bound on the size of the pieces' coordinates, metres. Infinite where a piece is not valid, so that no
    /// piece is passed over.
    pub(crate) size: f64,
}

impl PieceList<'_> {
    /// Whether a piece is before another in file order.
    fn is_before(&self, piece: usize, other: usize) -> bool {
        (self.owners[piece], piece) < (self.owners[other], other)
    }
}

/// What measuring side by side says of a piece.
enum Across {
    /// It is certainly farther than the nearest so far.
    Farther,
    /// Its distance, as [`take`](NearestSearch::take) takes it.
    Measured(Option<NearestPoints>),
}

impl<'a> NearestSearch<'a> {
    /// A search for a piece nearer than `within`.
    pub(crate) fn new(shape: &'a Placed, among: PieceList<'a>, within: f64) -> Self {
        NearestSearch { shape, among, within, best: None, sides: None }
    }

    /// The box around the shape, which is valid.
    pub(crate) fn extent(&self) -> Aabb {
        self.shape.padded_bounds_of_valid()
    }

    fn least(&self) -> f64 {
        self.best.map_or(self.within, |(_, n)| n.dist)
    }

    /// Measures a piece, unless it is certainly too far, and returns the least distance so far.
    pub(crate) fn look(&mut self, piece: usize) -> f64 {
        let (other, least) = (&self.among.pieces[piece], self.least());
        if least < f64::INFINITY && self.passes_over(other, least) {
            return least;
        }
        self.take(piece, pair_within(self.shape, other, least))
    }

    /// A separation test: whether some half-plane about the shape proves a piece farther than `least`. `false` is
    /// inconclusive.
    fn passes_over(&mut self, piece: &Placed, least: f64) -> bool {
        let sides = self.sides.get_or_insert_with(|| Sides::of(self.shape));
        let reach = self.shape.radius() + piece.radius();
        sides.gap(piece) - reach > least * (1.0 + 1e-12) + 64.0 * f64::EPSILON * (self.among.size + reach)
    }

    /// As [`look`](Self::look), for the hulls and footprints of an edge, which are near the pieces and have many
    /// corners: it tries to part the two first, side by side. Returns 0 at once where piece and shape certainly
    /// overlap; then the search finds no nearest piece.
    pub(crate) fn look_for_distance(&mut self, piece: usize, room: &mut LaneRoom) -> f64 {
        let (other, least) = (&self.among.pieces[piece], self.least());
        match self.across(other, least, room) {
            Some(Across::Farther) => return least,
            Some(Across::Measured(found)) => return self.take(piece, found),
            None => {}
        }
        let found = match self.parting(other) {
            Some(parting) => {
                let gap = parting.line.gap - (self.shape.radius() + other.radius());
                if gap > least * (1.0 + 1e-12) + parting.slack {
                    return least;
                }
                nearest_across(self.shape, other, least, &parting)
            }
            None if plainly_overlap(self.shape.core(), other.core()) => return 0.0,
            None => pair_within(self.shape, other, least),
        };
        self.take(piece, found)
    }

    /// Measures a piece side by side, where a side of the shape certainly separates the two cores. `None` where none
    /// does, or where a core has too many vertices.
    #[inline]
    fn across(&self, other: &Placed, least: f64, room: &mut LaneRoom) -> Option<Across> {
        let core = self.shape.core();
        if !room.is_set() && !room.set(self.shape) {
            return None;
        }
        let reach = self.shape.radius() + other.radius();
        let size = self.among.size + room.size() + reach;
        let slack = 64.0 * f64::EPSILON * size;
        let farther = |gap: f64| gap - reach > least * (1.0 + 1e-12) + slack;
        let gap = room.gap(other.core());
        if farther(gap) {
            return Some(Across::Farther);
        }
        let is_apart = gap > 1e-12 * gap + slack;
        if !is_apart {
            return None;
        }
        let cores = room.measure(core, other.core(), size)?;
        if farther(cores.distance - cores.slack) {
            return Some(Across::Farther);
        }
        Some(Across::Measured(nearest_measured(self.shape, other, least, &cores)))
    }

    /// A line that certainly separates the cores of the shape and of a piece. `None` where there is none, or where
    /// direct measurement is faster.
    fn parting(&self, other: &Placed) -> Option<SureParting> {
        // for a point or a segment, the first piece is measured faster without a line
        if self.shape.core().len() <= 2 && self.least() == f64::INFINITY {
            return None;
        }
        let slack = 64.0 * f64::EPSILON * (self.among.size + self.shape.radius() + other.radius());
        let line = Parting::of(self.shape.core(), other.core())?;
        (line.gap > 1e-12 * line.gap + slack).then_some(SureParting { line, slack })
    }

    /// Keeps a piece if it is the nearest so far, or as near and before it in file order. Returns the least distance so
    /// far.
    fn take(&mut self, piece: usize, found: Option<NearestPoints>) -> f64 {
        if let Some(found) = found
            && (found.dist < self.least()
                || self.best.is_some_and(|(p, n)| found.dist == n.dist && self.among.is_before(piece, p)))
        {
            self.best = Some((piece, found));
        }
        self.least()
    }

    /// The nearest piece and the nearest points; `None` where no piece is nearer than the limit.
    pub(crate) fn found(self) -> Option<(usize, NearestPoints)> {
        self.best
    }
}
