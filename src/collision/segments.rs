//! `SegmentSoup`, the boundary of many shapes as flat arrays of segments and discs: what rays are cast at.

use crate::geometry::{Placed, Point2};

/// Segments and discs in structure-of-arrays order, each with the number of its owner.
///
/// A polygon gives its edges; a shape with a radius gives a disc at every vertex and both offset sides of every edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentSoup {
    pub(crate) ax: Vec<f64>,
    pub(crate) ay: Vec<f64>,
    pub(crate) bx: Vec<f64>,
    pub(crate) by: Vec<f64>,
    pub(crate) segment_owner: Vec<u32>,
    pub(crate) cx: Vec<f64>,
    pub(crate) cy: Vec<f64>,
    pub(crate) radius: Vec<f64>,
    pub(crate) disc_owner: Vec<u32>,
}

impl SegmentSoup {
    /// The boundaries of the valid ones of `pieces`.
    pub(crate) fn of_pieces(pieces: &[Placed], owners: &[u32]) -> Self {
        let mut soup = SegmentSoup::default();
        for (piece, &owner) in pieces.iter().zip(owners) {
            soup.push(piece, owner);
        }
        soup
    }

    /// Adds the boundary of one shape; one that is not valid adds nothing.
    pub(crate) fn push(&mut self, shape: &Placed, owner: u32) {
        if !shape.is_valid() {
            return;
        }
        let (core, r) = (shape.core(), shape.radius());
        let sides = if core.len() <= 2 { core.len() - 1 } else { core.len() };
        for i in 0..sides {
            let (a, b) = (core[i], core[(i + 1) % core.len()]);
            if r == 0.0 {
                self.push_segment(a, b, owner);
                continue;
            }
            let u = b - a;
            let length = crate::num::hypot(u.x, u.y);
            if length > 0.0 {
                let normal = nalgebra::Vector2::new(u.y, -u.x) * (r / length);
                self.push_segment(a + normal, b + normal, owner);
                if core.len() == 2 {
                    self.push_segment(a - normal, b - normal, owner);
                }
            }
        }
        if r > 0.0 {
            for p in core {
                self.cx.push(p.x);
                self.cy.push(p.y);
                self.radius.push(r);
                self.disc_owner.push(owner);
            }
        }
    }

    fn push_segment(&mut self, a: Point2, b: Point2, owner: u32) {
        self.ax.push(a.x);
        self.ay.push(a.y);
        self.bx.push(b.x);
        self.by.push(b.y);
        self.segment_owner.push(owner);
    }
}
