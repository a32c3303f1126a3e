//! `Search`, the nearest piece to a shape.

use super::answers::pair_within;
use super::core::plainly_overlap;
use super::extent::Extent;
use super::narrow::{Nearest, nearest_across};
use super::parting::Parting;
use crate::geometry::Placed;

/// A search under way for the piece nearest to a shape, the first in file order among equals.
pub(super) struct Search<'a> {
    shape: &'a Placed,
    pieces: &'a [Placed],
    /// No coordinate of a piece is larger; infinite where a piece is not valid, which nothing may pass over.
    size: f64,
    within: f64,
    best: Option<(usize, Nearest)>,
}

impl<'a> Search<'a> {
    /// A search for what is nearer than `within`.
    pub(super) fn new(shape: &'a Placed, pieces: &'a [Placed], size: f64, within: f64) -> Self {
        Search { shape, pieces, size, within, best: None }
    }

    /// The box around the shape.
    pub(super) fn extent(&self) -> Extent {
        Extent::of(self.shape)
    }

    fn least(&self) -> f64 {
        self.best.map_or(self.within, |(_, n)| n.dist)
    }

    /// Looks at a piece and gives the least distance so far.
    pub(super) fn look(&mut self, piece: usize) -> f64 {
        let other = &self.pieces[piece];
        self.take(piece, self.parting(other))
    }

    /// As [`look`](Self::look), but 0 at once where piece and shape plainly overlap: then nothing is found.
    pub(super) fn look_for_distance(&mut self, piece: usize) -> f64 {
        let other = &self.pieces[piece];
        let parting = self.parting(other);
        if parting.is_none() && plainly_overlap(self.shape.core(), other.core()) {
            return 0.0;
        }
        self.take(piece, parting)
    }

    /// A line that plainly parts the cores of the shape and of a piece, and what a height above it may be off by.
    fn parting(&self, other: &Placed) -> Option<(Parting, f64)> {
        // the first piece that a point or a segment is held against is sooner measured without
        if self.shape.core().len() <= 2 && self.least() == f64::INFINITY {
            return None;
        }
        let rounding = 64.0 * f64::EPSILON * (self.size + self.shape.radius() + other.radius());
        let parting = Parting::of(self.shape.core(), other.core())?;
        (parting.gap > 1e-12 * parting.gap + rounding).then_some((parting, rounding))
    }

    fn take(&mut self, piece: usize, parting: Option<(Parting, f64)>) -> f64 {
        let (other, least) = (&self.pieces[piece], self.least());
        let found = match parting {
            Some((line, rounding)) => {
                let gap = line.gap - (self.shape.radius() + other.radius());
                if gap > least * (1.0 + 1e-12) + rounding {
                    return least;
                }
                nearest_across(self.shape, other, least, (&line, rounding))
            }
            None => pair_within(self.shape, other, least),
        };
        let Some(found) = found else { return least };
        if found.dist < least || self.best.is_some_and(|(p, n)| found.dist == n.dist && piece < p) {
            self.best = Some((piece, found));
        }
        self.least()
    }

    /// What was found.
    pub(super) fn found(self) -> Option<(usize, Nearest)> {
        self.best
    }
}
