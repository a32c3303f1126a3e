//! `PreparedSegments`, a batch of segments prepared for a scan.

use super::view::View;
use crate::collision::LANES;
use crate::num::{greater, lesser};

/// An upper bound on the error of [`turns`], in turns.
const TURNS_ERROR: f64 = 4e-6;

/// Where p x q is below this fraction of its two products, the exact predicate decides.
const DOUBT: f64 = 1e-8;

/// A number whose addition rounds: a number below 2^51 in magnitude becomes the nearest integer, which stands in the
/// lowest bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 x 2^52

/// The bearing of a vector in turns, in [0, 1], to within 2e-6: exact enough to say which rays may meet something, not
/// which do.
///
/// Abramowitz and Stegun 4.4.49, whose error is below 1e-5 radians.
#[inline(always)]
pub(super) fn turns(x: f64, y: f64) -> f64 {
    const C: [f64; 5] = [0.999_866_0, -0.330_299_5, 0.180_141_0, -0.085_133_0, 0.020_835_1];
    const TURN: f64 = std::f64::consts::TAU;
    let (w, h) = (x.abs(), y.abs());
    let steep = h > w;
    let t = lesser(h, w) / greater(h, w);
    let t2 = t * t;
    let r = t * (C[0] / TURN + t2 * (C[1] / TURN + t2 * (C[2] / TURN + t2 * (C[3] / TURN + t2 * (C[4] / TURN)))));
    let r = if steep { 0.25 - r } else { r };
    let r = if x < 0.0 { 0.5 - r } else { r };
    if y < 0.0 { 1.0 - r } else { r }
}

/// Largest number of segments prepared at once.
pub(super) const BATCH: usize = 64;

/// One number for each segment of a batch.
pub(super) type Batch = [f64; BATCH];

/// What is known of a prepared segment: see [`PreparedSegments::span`].
pub(super) mod kind {
    /// No ray can meet it: it is out of reach, or an unused place.
    pub(in super::super) const NONE: u64 = 0;
    /// Every ray of the blocks between its first and its last is in the wedge.
    pub(in super::super) const SURE: u64 = 1;
    /// It reaches past ray 0, or an end is so near the first ray of a block that it may be on either side.
    pub(in super::super) const UNSURE: u64 = 2;
    /// p x q is mostly rounding.
    pub(in super::super) const DOUBTFUL: u64 = 3;
}

/// The inverse range in a wedge: `a dx - b dy`, per metre, along the unit direction `(dx, dy)`.
#[derive(Clone, Copy)]
pub(super) struct Inverse {
    pub(super) a: f64,
    pub(super) b: f64,
}

/// A wedge, and the inverse range in it.
#[derive(Clone, Copy)]
pub(super) struct Wedge {
    pub(super) p: (f64, f64),
    pub(super) q: (f64, f64),
    pub(super) inverse: Inverse,
}

/// Prepared segments: for each the wedge, the two coefficients of the inverse range, and the blocks of eight rays that
/// may meet it.
#[derive(Clone, Debug)]
pub(super) struct PreparedSegments {
    px: Batch,
    py: Batch,
    qx: Batch,
    qy: Batch,
    a: Batch,
    b: Batch,
    /// One of [`kind`], then the last and the first block with a ray of the wedge, [`BITS`] bits each, packed from the
    /// high bits down.
    span: [u64; BATCH],
    /// For a wedge that reaches past ray 0, the number of blocks that it covers from there on; with [`ROUND`] added.
    turned: Batch,
}

impl Default for PreparedSegments {
    fn default() -> Self {
        let [px, py, qx, qy, a, b, turned] = [[0.0; BATCH]; 7];
        PreparedSegments { px, py, qx, qy, a, b, span: [0; BATCH], turned }
    }
}

/// Number of bits in a span for the number of a block.
const BITS: u32 = 31;

/// The integer in a number that had [`ROUND`] added.
#[inline(always)]
fn whole(x: f64) -> u64 {
    x.to_bits() & ((1 << BITS) - 1)
}

impl PreparedSegments {
    /// The wedge of segment number `k`.
    #[inline(always)]
    pub(super) fn wedge(&self, k: usize) -> Wedge {
        Wedge { p: (self.px[k], self.py[k]), q: (self.qx[k], self.qy[k]), inverse: self.inverse(k) }
    }

    /// The inverse range in the wedge of segment number `k`.
    #[inline(always)]
    pub(super) fn inverse(&self, k: usize) -> Inverse {
        Inverse { a: self.a[k], b: self.b[k] }
    }

    /// What is known of segment number `k`, and the first and the last block with a ray of its wedge.
    #[inline(always)]
    pub(super) fn span(&self, k: usize) -> (u64, usize, usize) {
        let (span, block) = (self.span[k], |bits: u64| (bits & ((1 << BITS) - 1)) as usize);
        (span >> (2 * BITS), block(span), block(span >> BITS))
    }

    /// The number of blocks that the wedge of segment number `k` covers from ray 0 on, if it reaches past that ray.
    #[inline(always)]
    pub(super) fn turned(&self, k: usize) -> usize {
        whole(self.turned[k]) as usize
    }

    /// Leaves out the blocks beyond those of a fan of less than a full turn, of which there are `blocks`. The wedges
    /// are known for a whole turn of rays; the fan has only the first of them.
    pub(super) fn clip(&mut self, blocks: usize) {
        let end = blocks as u64;
        for span in &mut self.span {
            let block = |bits: u64| bits & ((1 << BITS) - 1);
            let (kind, last, first) = (*span >> (2 * BITS), block(*span >> BITS), block(*span));
            // any other kind is tested ray by ray, as far as there are blocks
            if kind == kind::SURE && last >= end {
                // the last block is tested, whichever it is, and those before it lie within the wedge as before
                *span = if first < end { kind::SURE << (2 * BITS) | (end - 1) << BITS | first } else { kind::NONE };
            }
        }
    }

    /// Prepares the first `BATCH` segments, given the coordinates of their ends. It is one loop without a branch, so
    /// that it works on several at a time.
    #[inline(always)]
    pub(super) fn make(&mut self, [ax, ay, bx, by]: [&[f64]; 4], view: &View) {
        let blocks = view.rays * (1.0 / LANES as f64);
        // rounding x - 1/2 to the nearest is rounding x down, or one less where x is whole, which is as good here
        let down = |turns: f64| (turns * blocks - 0.5) + ROUND;
        let up = |turns: f64| (turns * blocks + 0.5) + ROUND;
        for k in 0..ax.len().min(ay.len()).min(bx.len()).min(by.len()).min(BATCH) {
            let (ax, ay) = (ax[k] - view.origin.x, ay[k] - view.origin.y);
            let (bx, by) = (bx[k] - view.origin.x, by[k] - view.origin.y);
            let (left, right) = (ax * by, ay * bx);
            let turn = left - right;
            let (px, qx) = (if turn < 0.0 { bx } else { ax }, if turn < 0.0 { ax } else { bx });
            let (py, qy) = (if turn < 0.0 { by } else { ay }, if turn < 0.0 { ay } else { by });
            let area = turn.abs();
            let (ux, uy) = (qx - px, qy - py);
            // the nearest point of the segment is between its ends, or one of them
            let between = (px * ux + py * uy < 0.0) & (qx * ux + qy * uy > 0.0);
            let (p2, q2, u2) = (px * px + py * py, qx * qx + qy * qy, ux * ux + uy * uy);
            let end2 = if p2 < q2 { p2 } else { q2 };
            let d2 = if between { area * area } else { end2 };
            let scale = if between { u2 } else { 1.0 };
            let doubt = area <= DOUBT * (left.abs() + right.abs()) + 1e-290;
            let p = turns(px, py);
            let wide = turns(qx, qy) - p;
            let wide = if wide < -0.25 { wide + 1.0 } else { wide };
            let begin = p - view.heading;
            let begin = if begin < TURNS_ERROR { begin + 1.0 } else { begin };
            let end = begin + wide;
            let over = end + TURNS_ERROR - 1.0;
            let (first, last) = (down(begin - TURNS_ERROR), down(end + TURNS_ERROR));
            // all rays of the blocks after this one and before that one are in the wedge
            let (inner, outer) = (up(begin + TURNS_ERROR), down(end - TURNS_ERROR));
            let sure = (inner == first + 1.0) & (outer == last) & (over < 0.0);
            let kind = if sure { kind::SURE } else { kind::UNSURE };
            let kind = if doubt { kind::DOUBTFUL } else { kind };
            self.px[k] = px;
            self.py[k] = py;
            self.qx[k] = qx;
            self.qy[k] = qy;
            self.a[k] = uy / area;
            self.b[k] = ux / area;
            // a block that is not full has fewer rays, so one block more is taken to be safe
            self.turned[k] = if over >= 0.0 { up(over) + 1.0 } else { ROUND };
            // NaN, in an empty place, is not in reach
            let kind = if d2 <= view.reach_squared * scale { kind } else { kind::NONE };
            self.span[k] = kind << (2 * BITS) | whole(last) << BITS | whole(first);
        }
    }
}
