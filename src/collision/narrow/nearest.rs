//! `Search`, the nearest piece to a shape.

use super::convex::plainly_overlap;
use super::distance::{Nearest, nearest_across};
use super::half_planes::Sides;
use super::pair::pair_within;
use super::separating_line::Parting;
use crate::geometry::{Aabb, Placed};

/// A search under way for the piece nearest to a shape, the first in file order among equals.
pub(crate) struct Search<'a> {
    shape: &'a Placed,
    pieces: &'a [Placed],
    /// No coordinate of a piece is larger; infinite where a piece is not valid, which nothing may pass over.
    size: f64,
    within: f64,
    best: Option<(usize, Nearest)>,
    sides: Option<Sides>,
}

impl<'a> Search<'a> {
    /// A search for what is nearer than `within`.
    pub(crate) fn new(shape: &'a Placed, pieces: &'a [Placed], size: f64, within: f64) -> Self {
        Search { shape, pieces, size, within, best: None, sides: None }
    }

    /// The box around the shape, which is valid.
    pub(crate) fn extent(&self) -> Aabb {
        Aabb::of_valid(self.shape)
    }

    fn least(&self) -> f64 {
        self.best.map_or(self.within, |(_, n)| n.dist)
    }

    /// Looks at a piece and gives the least distance so far.
    pub(crate) fn look(&mut self, piece: usize) -> f64 {
        let (other, least) = (&self.pieces[piece], self.least());
        if least < f64::INFINITY && self.passes_over(other, least) {
            return least;
        }
        self.take(piece, pair_within(self.shape, other, least))
    }

    /// Whether some half-plane about the shape shows that a piece is farther than `least`.
    fn passes_over(&mut self, piece: &Placed, least: f64) -> bool {
        let sides = self.sides.get_or_insert_with(|| Sides::of(self.shape));
        let reach = self.shape.radius() + piece.radius();
        sides.gap(piece) - reach > least * (1.0 + 1e-12) + 64.0 * f64::EPSILON * (self.size + reach)
    }

    /// As [`look`](Self::look), but 0 at once where piece and shape plainly overlap: then nothing is found. On the way of an edge, where the
    /// shapes are near one another and have many corners, a line between the two is worth looking for first.
    pub(crate) fn look_for_distance(&mut self, piece: usize) -> f64 {
        let (other, least) = (&self.pieces[piece], self.least());
        let found = match self.parting(other) {
            Some((line, rounding)) => {
                let gap = line.gap - (self.shape.radius() + other.radius());
                if gap > least * (1.0 + 1e-12) + rounding {
                    return least;
                }
                nearest_across(self.shape, other, least, (&line, rounding))
            }
            None if plainly_overlap(self.shape.core(), other.core()) => return 0.0,
            None => pair_within(self.shape, other, least),
        };
        self.take(piece, found)
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

    /// Takes what was found of a piece and gives the least distance so far.
    fn take(&mut self, piece: usize, found: Option<Nearest>) -> f64 {
        if let Some(found) = found
            && (found.dist < self.least() || self.best.is_some_and(|(p, n)| found.dist == n.dist && piece < p))
        {
            self.best = Some((piece, found));
        }
        self.least()
    }

    /// What was found.
    pub(crate) fn found(self) -> Option<(usize, Nearest)> {
        self.best
    }
}
