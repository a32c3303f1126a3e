//! `SegmentSoup`, the boundary of many shapes as flat arrays of segments and discs: what rays are cast at.

use crate::geometry::{Placed, Point2, Segment};

/// The number of values that the loops handle side by side.
pub(crate) const LANES: usize = 8;

/// Segments in structure-of-arrays order, padded to a multiple of eight with NaN, which no ray hits.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentArrays {
    ax: Vec<f64>,
    ay: Vec<f64>,
    bx: Vec<f64>,
    by: Vec<f64>,
    count: usize,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) centre: Point2,
    pub(crate) radius: f64,
}

/// Segments and discs.
///
/// A polygon gives its edges; a shape with a radius gives a disc at every vertex and both offset sides of every edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentSoup {
    segments: SegmentArrays,
    circles: Vec<Circle>,
}

impl SegmentArrays {
    /// Segment number `i`.
    pub(crate) fn segment(&self, i: usize) -> Segment {
        Segment::new(Point2::new(self.ax[i], self.ay[i]), Point2::new(self.bx[i], self.by[i]))
    }

    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The arrays of the first ends' x and y and of the second ends' x and y, padded to a multiple of eight.
    pub(crate) fn arrays(&self) -> [&[f64]; 4] {
        [&self.ax, &self.ay, &self.bx, &self.by]
    }

    #[inline]
    pub(crate) fn push(&mut self, s: Segment) {
        let i = self.count;
        if i == self.ax.len() {
            for array in [&mut self.ax, &mut self.ay, &mut self.bx, &mut self.by] {
                array.extend([f64::NAN; LANES]);
            }
        }
        (self.ax[i], self.ay[i], self.bx[i], self.by[i]) = (s.a.x, s.a.y, s.b.x, s.b.y);
        self.count += 1;
    }

    /// Makes the first segment with these ends NaN; false where there is none.
    fn forget(&mut self, segment: &Segment) -> bool {
        let Some(i) = (0..self.count).find(|i| self.segment(*i) == *segment) else { return false };
        for array in [&mut self.ax, &mut self.ay, &mut self.bx, &mut self.by] {
            array[i] = f64::NAN;
        }
        true
    }

    /// Removes all segments but keeps the memory.
    pub(crate) fn clear(&mut self) {
        for array in [&mut self.ax, &mut self.ay, &mut self.bx, &mut self.by] {
            array.clear();
        }
        self.count = 0;
    }
}

impl SegmentSoup {
    pub(crate) fn segments(&self) -> &SegmentArrays {
        &self.segments
    }

    pub(crate) fn circles(&self) -> &[Circle] {
        &self.circles
    }

    /// Removes everything but keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.segments.clear();
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
                self.segments.push(Segment::new(a, b));
                continue;
            }
            let u = b - a;
            let length = crate::num::hypot(u.x, u.y);
            if length > 0.0 {
                let normal = nalgebra::Vector2::new(u.y, -u.x) * (r / length);
                self.segments.push(Segment::new(a + normal, b + normal));
                if core.len() == 2 {
                    self.segments.push(Segment::new(a - normal, b - normal));
                }
            }
        }
        if r > 0.0 {
            self.circles.extend(core.iter().map(|&centre| Circle { centre, radius: r }));
        }
    }

    /// Makes a segment with these ends NaN, which no ray hits; false where there is none.
    pub(crate) fn forget_segment(&mut self, segment: &Segment) -> bool {
        self.segments.forget(segment)
    }

    /// Makes one of the discs with these numbers NaN, which no ray hits: the first that is the same as this one. False
    /// where none is.
    pub(crate) fn forget_circle(&mut self, numbers: impl IntoIterator<Item = usize>, circle: &Circle) -> bool {
        let is_same = |own: &Circle| (own.centre, own.radius) == (circle.centre, circle.radius);
        let Some(number) = numbers.into_iter().find(|number| self.circles.get(*number).is_some_and(is_same)) else {
            return false;
        };
        self.circles[number] = Circle { centre: Point2::new(f64::NAN, f64::NAN), radius: f64::NAN };
        true
    }

    #[cfg(test)]
    pub(crate) fn push_segment(&mut self, segment: Segment) {
        self.segments.push(segment);
    }
}
