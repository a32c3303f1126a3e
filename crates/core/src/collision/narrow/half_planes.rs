//! `Sides`, half-planes that hold a shape's core, for a lower bound on the distance to a piece.

use super::convex::edges;
use crate::geometry::{Placed, Point2, Segment, Vector2};
use crate::num::{greater, sqrt};

/// Largest number of half-planes about a shape.
const SIDES: usize = 8;

/// Half-planes that hold a shape's core: their outward unit normals, and their offsets along them, metres.
pub(crate) struct Sides {
    count: usize,
    nx: [f64; SIDES],
    ny: [f64; SIDES],
    out: [f64; SIDES],
}

impl Sides {
    /// The half-planes along the sides of a shape's core, at most `SIDES` of them. For a segment also those across its
    /// ends; for a point none.
    pub(crate) fn of(shape: &Placed) -> Self {
        let core = shape.core();
        let mut sides = Sides { count: 0, nx: [0.0; SIDES], ny: [0.0; SIDES], out: [0.0; SIDES] };
        if core.len() < 2 {
            return sides;
        }
        for Segment { a, b } in edges(core).take(SIDES) {
            let u = b - a;
            let inverse = 1.0 / sqrt(u.norm_squared());
            let (ux, uy) = (u.x * inverse, u.y * inverse);
            if core.len() > 2 {
                sides.push(core, Vector2::new(uy, -ux));
            } else {
                // for a segment both sides and both ends
                for (nx, ny) in [(uy, -ux), (-uy, ux), (ux, uy), (-ux, -uy)] {
                    sides.push(core, Vector2::new(nx, ny));
                }
            }
        }
        sides
    }

    /// Adds the smallest half-plane with this outward normal that holds the core.
    fn push(&mut self, core: &[Point2], normal: Vector2) {
        let (nx, ny) = (normal.x, normal.y);
        let out = core.iter().fold(f64::NEG_INFINITY, |out, v| greater(nx * v.x + ny * v.y, out));
        (self.nx[self.count], self.ny[self.count], self.out[self.count]) = (nx, ny, out);
        self.count += 1;
    }

    /// A lower bound on the distance of the two cores, metres; rounded. It is how far the piece's core lies outside the
    /// half-plane that it is farthest outside of, negative infinity without half-planes.
    pub(crate) fn gap(&self, piece: &Placed) -> f64 {
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
