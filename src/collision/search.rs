//! `Search`, the nearest piece to a shape.

use super::answers::pair_within;
use super::core::edges;
use super::extent::Extent;
use super::narrow::Nearest;
use crate::geometry::{Placed, Point2};
use crate::num::{greater, sqrt};

/// At most so many half-planes about a shape tell what is far from it.
const SIDES: usize = 8;

/// A search under way for the piece nearest to a shape, the first in file order among equals.
pub(super) struct Search<'a> {
    shape: &'a Placed,
    pieces: &'a [Placed],
    /// No coordinate of a piece is larger; infinite where a piece is not valid, which nothing may pass over.
    size: f64,
    within: f64,
    best: Option<(usize, Nearest)>,
    sides: Option<Sides>,
}

/// Half-planes that hold the shape: unit normals, and how far out each lies.
struct Sides {
    count: usize,
    nx: [f64; SIDES],
    ny: [f64; SIDES],
    out: [f64; SIDES],
}

impl<'a> Search<'a> {
    /// A search for what is nearer than `within`.
    pub(super) fn new(shape: &'a Placed, pieces: &'a [Placed], size: f64, within: f64) -> Self {
        Search { shape, pieces, size, within, best: None, sides: None }
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
        let least = self.least();
        let other = &self.pieces[piece];
        if least < f64::INFINITY && self.passes_over(other, least) {
            return least;
        }
        let Some(found) = pair_within(self.shape, other, least) else { return least };
        if found.dist < least || self.best.is_some_and(|(p, n)| found.dist == n.dist && piece < p) {
            self.best = Some((piece, found));
        }
        self.least()
    }

    /// Whether some half-plane about the shape shows that a piece is farther than `least`.
    fn passes_over(&mut self, piece: &Placed, least: f64) -> bool {
        let sides = self.sides.get_or_insert_with(|| Sides::of(self.shape));
        let reach = self.shape.radius() + piece.radius();
        sides.gap(piece) - reach > least * (1.0 + 1e-12) + 64.0 * f64::EPSILON * (self.size + reach)
    }

    /// What was found.
    pub(super) fn found(self) -> Option<(usize, Nearest)> {
        self.best
    }
}

impl Sides {
    fn of(shape: &Placed) -> Self {
        let core = shape.core();
        let mut sides = Sides { count: 0, nx: [0.0; SIDES], ny: [0.0; SIDES], out: [0.0; SIDES] };
        if core.len() < 2 {
            return sides;
        }
        for (a, b) in edges(core).take(SIDES) {
            let u = b - a;
            let inverse = 1.0 / sqrt(u.norm_squared());
            let (ux, uy) = (u.x * inverse, u.y * inverse);
            if core.len() > 2 {
                sides.push(core, (uy, -ux));
            } else {
                // of a segment both sides and both ends
                for normal in [(uy, -ux), (-uy, ux), (ux, uy), (-ux, -uy)] {
                    sides.push(core, normal);
                }
            }
        }
        sides
    }

    /// The half-plane with this outward normal that just holds the core.
    fn push(&mut self, core: &[Point2], (nx, ny): (f64, f64)) {
        let out = core.iter().fold(f64::NEG_INFINITY, |out, v| greater(nx * v.x + ny * v.y, out));
        (self.nx[self.count], self.ny[self.count], self.out[self.count]) = (nx, ny, out);
        self.count += 1;
    }

    /// How far the core of a piece lies outside the half-plane that it is farthest outside of; rounded.
    fn gap(&self, piece: &Placed) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for ((nx, ny), out) in self.nx.iter().zip(&self.ny).zip(&self.out).take(self.count) {
            let nearest = piece.core().iter().fold(f64::INFINITY, |least, v| {
                let along = nx * v.x + ny * v.y;
                if along < least { along } else { least }
            });
            most = greater(nearest - out, most);
        }
        most
    }
}
