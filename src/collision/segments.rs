//! `SegmentSoup`, the boundary of many shapes as flat arrays of segments and discs: what rays are cast at.

use crate::geometry::{Placed, Point2, Segment};

/// How many segments stand side by side.
pub(crate) const LANES: usize = 8;

/// Eight segments in structure-of-arrays order; empty places hold NaN, which no ray hits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentLanes {
    pub(crate) ax: [f64; LANES],
    pub(crate) ay: [f64; LANES],
    pub(crate) bx: [f64; LANES],
    pub(crate) by: [f64; LANES],
}

/// A disc's boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) centre: Point2,
    pub(crate) radius: f64,
}

/// Segments in eights, and discs.
///
/// A polygon gives its edges; a shape with a radius gives a disc at every vertex and both offset sides of every edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentSoup {
    lanes: Vec<SegmentLanes>,
    segments: usize,
    circles: Vec<Circle>,
}

impl SegmentLanes {
    const NOTHING: SegmentLanes = {
        let nan = [f64::NAN; LANES];
        SegmentLanes { ax: nan, ay: nan, bx: nan, by: nan }
    };

    /// The segment at place `i` of the eight.
    pub(crate) fn segment(&self, i: usize) -> Segment {
        Segment::new(Point2::new(self.ax[i], self.ay[i]), Point2::new(self.bx[i], self.by[i]))
    }
}

impl SegmentSoup {
    /// The boundaries of the valid ones of `pieces`.
    pub(crate) fn of_pieces(pieces: &[Placed]) -> Self {
        let mut soup = SegmentSoup::default();
        for piece in pieces {
            soup.push(piece);
        }
        soup
    }

    /// The segments, in eights.
    pub(crate) fn lanes(&self) -> &[SegmentLanes] {
        &self.lanes
    }

    /// The discs.
    pub(crate) fn circles(&self) -> &[Circle] {
        &self.circles
    }

    /// The number of segments.
    pub(crate) fn len(&self) -> usize {
        self.segments
    }

    /// Each segment on its own.
    pub(crate) fn segments(&self) -> impl Iterator<Item = Segment> {
        (0..self.segments).map(|i| self.lanes[i / LANES].segment(i % LANES))
    }

    /// Forgets everything but keeps the room.
    pub(crate) fn clear(&mut self) {
        self.lanes.clear();
        self.segments = 0;
        self.circles.clear();
    }

    /// Adds the boundary of one shape; one that is not valid adds nothing.
    pub(crate) fn push(&mut self, shape: &Placed) {
        if !shape.is_valid() {
            return;
        }
        let (core, r) = (shape.core(), shape.radius());
        let sides = if core.len() <= 2 { core.len() - 1 } else { core.len() };
        for i in 0..sides {
            let (a, b) = (core[i], core[(i + 1) % core.len()]);
            if r == 0.0 {
                self.push_segment(Segment::new(a, b));
                continue;
            }
            let u = b - a;
            let length = crate::num::hypot(u.x, u.y);
            if length > 0.0 {
                let normal = nalgebra::Vector2::new(u.y, -u.x) * (r / length);
                self.push_segment(Segment::new(a + normal, b + normal));
                if core.len() == 2 {
                    self.push_segment(Segment::new(a - normal, b - normal));
                }
            }
        }
        if r > 0.0 {
            self.circles.extend(core.iter().map(|&centre| Circle { centre, radius: r }));
        }
    }

    /// Adds one segment.
    pub(crate) fn push_segment(&mut self, s: Segment) {
        let i = self.segments % LANES;
        if i == 0 {
            self.lanes.push(SegmentLanes::NOTHING);
        }
        if let Some(lanes) = self.lanes.last_mut() {
            (lanes.ax[i], lanes.ay[i], lanes.bx[i], lanes.by[i]) = (s.a.x, s.a.y, s.b.x, s.b.y);
        }
        self.segments += 1;
    }

    /// Adds one disc.
    pub(crate) fn push_circle(&mut self, circle: Circle) {
        self.circles.push(circle);
    }
}
