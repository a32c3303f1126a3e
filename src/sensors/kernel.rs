//! The scan's inner loops, compiled for several instruction sets that all give the same bits.
//!
//! A segment with the ends p, q as seen from the sensor, p x q > 0, meets the ray of unit direction d at 1/t = (d x (q - p)) / (p x q),
//! which is linear in d. A ray meets it when it lies in the closed wedge between p and q: p x d >= 0 and d x q >= 0. Two segments with a
//! common end use the same rounded p, so a ray is on one side of it or on the other: no corner leaks.
//!
//! Only multiplications, additions, comparisons, divisions and square roots are used, each rounded once on every machine; nothing
//! is fused or reordered.

use multiversion::multiversion;

pub(super) use crate::collision::LANES;
use crate::geometry::{Point2, Segment, orientation};
use crate::num::{greater, lesser, sqrt};

/// Eight numbers side by side.
pub(super) type Lanes = [f64; LANES];

/// Eight rays: their directions in the world and the greatest inverse range along each so far. Places that are no ray have
/// the direction 0, along which every inverse range is 0.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Rays {
    pub(super) dx: Lanes,
    pub(super) dy: Lanes,
    pub(super) inverse: Lanes,
}

/// The rays of a scan under way.
#[derive(Clone, Debug)]
pub(super) struct Fan {
    pub(super) blocks: Vec<Rays>,
    rays: usize,
    /// The blocks with rays that may still be raised, by bits; all, if there are more than 64.
    pub(super) open: u64,
    ready: Box<Ready>,
}

/// From where, and how, a scan looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) origin: Point2,
    /// What lies farther off is left out: a little more than the range, metres, and its square.
    pub(super) reach: f64,
    pub(super) reach_squared: f64,
    /// The bearing of ray 0, in turns, in [0, 1].
    pub(super) heading: f64,
    /// The number of rays.
    pub(super) rays: f64,
}

/// More than the error of [`turns`], in turns.
const SLACK: f64 = 4e-6;

/// Below this share of its two products, p x q is taken from the exact predicate.
const DOUBT: f64 = 1e-8;

/// Adding it rounds a small number to an integer, which is then in the lowest bits.
const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 x 2^52

/// The bearing of a vector in turns, in [0, 1], to within 2e-6: which rays may meet something, not which do.
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

/// How many segments are made ready at once.
pub(super) const BATCH: usize = 64;

type Batch = [f64; BATCH];

/// Segments made ready: the wedge, the two coefficients of the inverse range, and the blocks of eight rays that may meet it.
#[derive(Clone, Debug)]
struct Ready {
    px: Batch,
    py: Batch,
    qx: Batch,
    qy: Batch,
    a: Batch,
    b: Batch,
    /// The first and the last block with a ray of the wedge, and how many blocks from ray 0 on it reaches beyond the last of
    /// all; each with [`ROUND`] added.
    first: Batch,
    last: Batch,
    turned: Batch,
    /// All rays of the blocks from `inner` until before `outer` are in the wedge; with [`ROUND`] added.
    inner: Batch,
    outer: Batch,
    /// 0 where no ray can meet the segment, 2 where p x q is mostly rounding, otherwise 1.
    fate: Batch,
}

/// The integer in a number that had [`ROUND`] added.
#[inline(always)]
fn whole(x: f64) -> usize {
    x.to_bits() as u32 as usize
}

impl Default for Ready {
    fn default() -> Self {
        let [px, py, qx, qy, a, b, first, last, turned, inner, outer, fate] = [[0.0; BATCH]; 12];
        Ready { px, py, qx, qy, a, b, first, last, turned, inner, outer, fate }
    }
}

/// One loop without a branch, so that it works on several segments at a time.
#[inline(always)]
fn make_ready([ax, ay, bx, by]: [&[f64]; 4], view: &View, r: &mut Ready) {
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
        let fate = if doubt { 2.0 } else { 1.0 };
        let p = turns(px, py);
        let wide = turns(qx, qy) - p;
        let wide = if wide < -0.25 { wide + 1.0 } else { wide };
        let begin = p - view.heading;
        let begin = if begin < SLACK { begin + 1.0 } else { begin };
        let end = begin + wide;
        let over = end + SLACK - 1.0;
        r.px[k] = px;
        r.py[k] = py;
        r.qx[k] = qx;
        r.qy[k] = qy;
        r.a[k] = uy / area;
        r.b[k] = ux / area;
        r.first[k] = down(begin - SLACK);
        r.last[k] = down(end + SLACK);
        r.inner[k] = up(begin + SLACK);
        r.outer[k] = down(end - SLACK);
        // the rays of a block that is not full are fewer, so one more is taken for good measure
        r.turned[k] = if over >= 0.0 { up(over) + 1.0 } else { ROUND };
        // NaN, in an empty place, is not in reach
        r.fate[k] = if d2 <= view.reach_squared * scale { fate } else { 0.0 };
    }
}

/// The greater of the inverse range so far and a new one. The sum, which changes nothing, keeps the compiler from leaving out the
/// stores that would: a store under a condition is slow.
#[inline(always)]
pub(super) fn raised(so_far: f64, value: f64) -> f64 {
    greater(value, so_far + 0.0)
}

/// A wedge, and the two coefficients of the inverse range in it.
#[derive(Clone, Copy)]
struct Wedge {
    p: (f64, f64),
    q: (f64, f64),
    a: f64,
    b: f64,
}

impl Rays {
    /// Raises those of the eight that are in the wedge.
    #[inline(always)]
    fn raise_tested(&mut self, w: &Wedge) {
        for ((dx, dy), inverse) in self.dx.iter().zip(&self.dy).zip(&mut self.inverse) {
            let inside = (w.p.0 * dy - w.p.1 * dx >= 0.0) & (dx * w.q.1 - dy * w.q.0 >= 0.0);
            let value = if inside { dx * w.a - dy * w.b } else { 0.0 };
            *inverse = raised(*inverse, value);
        }
    }

    /// Raises all eight, which are in the wedge.
    #[inline(always)]
    fn raise_all(&mut self, w: &Wedge) {
        for ((dx, dy), inverse) in self.dx.iter().zip(&self.dy).zip(&mut self.inverse) {
            *inverse = raised(*inverse, dx * w.a - dy * w.b);
        }
    }
}

/// Does something to each of some blocks.
#[inline(always)]
fn each_block(blocks: &mut [Rays], mut raise: impl FnMut(&mut Rays)) {
    for block in blocks {
        // Never so; it keeps the compiler from working on several blocks at once, lane by lane, with gathers.
        if block.dx[0] > 2.0 {
            break;
        }
        raise(block);
    }
}

impl Fan {
    /// So many rays without a direction.
    pub(super) fn new(rays: usize) -> Self {
        let zero = [0.0; LANES];
        let blocks = vec![Rays { dx: zero, dy: zero, inverse: zero }; rays.div_ceil(LANES)];
        Fan { blocks, rays, open: u64::MAX, ready: Box::default() }
    }

    /// Each ray: its direction and its inverse range.
    fn each(&mut self) -> impl Iterator<Item = (f64, f64, &mut f64)> {
        self.blocks
            .iter_mut()
            .flat_map(|b| b.dx.iter().zip(&b.dy).zip(&mut b.inverse).map(|((dx, dy), inverse)| (*dx, *dy, inverse)))
    }

    /// The blocks of a range, those there are.
    #[inline(always)]
    pub(super) fn some(&mut self, blocks: std::ops::Range<usize>) -> &mut [Rays] {
        let end = blocks.end.min(self.blocks.len());
        self.blocks.get_mut(blocks.start..end).unwrap_or_default()
    }
}

#[inline(always)]
fn raise_here([ax, ay, bx, by]: [&[f64]; 4], view: &View, fan: &mut Fan) {
    let mut from = 0;
    while from < ax.len() {
        let to = (from + BATCH).min(ax.len());
        let batch = [&ax[from..to], &ay[from..to], &bx[from..to], &by[from..to]];
        make_ready(batch, view, &mut fan.ready);
        for k in 0..to - from {
            let [ax, ay, bx, by] = batch;
            let segment = || Segment::new(Point2::new(ax[k], ay[k]), Point2::new(bx[k], by[k]));
            raise_one(k, segment, view, fan);
        }
        from = to;
    }
}

/// Raises the rays that meet segment number `k` of those made ready.
#[inline(always)]
fn raise_one(k: usize, segment: impl Fn() -> Segment, view: &View, fan: &mut Fan) {
    let r = &fan.ready;
    if r.fate[k] != 1.0 {
        if r.fate[k] != 0.0 {
            raise_doubtful(segment(), view, fan);
        }
        return;
    }
    let w = Wedge { p: (r.px[k], r.py[k]), q: (r.qx[k], r.qy[k]), a: r.a[k], b: r.b[k] };
    let (first, last, turned) = (whole(r.first[k]), whole(r.last[k]), whole(r.turned[k]));
    if (fan.open >> first.min(63)) & (u64::MAX >> (63 - (last - first).min(63))) == 0 && turned == 0 {
        return;
    }
    if turned > 0 || whole(r.inner[k]) != first + 1 || whole(r.outer[k]) != last {
        // past ray 0, or an end so near the first ray of a block that it may be on either side
        each_block(fan.some(first..last + 1), |block| block.raise_tested(&w));
        each_block(fan.some(0..turned), |block| block.raise_tested(&w));
        return;
    }
    let [block, rest @ ..] = fan.some(first..last + 1) else { return };
    block.raise_tested(&w);
    let [within @ .., block] = rest else { return };
    each_block(within, |block| block.raise_all(&w));
    block.raise_tested(&w);
}

/// A segment whose line passes so near the origin that p x q is mostly rounding.
#[cold]
#[inline(never)]
fn raise_doubtful(segment: Segment, view: &View, fan: &mut Fan) {
    let (mut p, mut q) = (segment.a - view.origin, segment.b - view.origin);
    let area = orientation(segment.a, segment.b, view.origin);
    if area == 0.0 {
        // The origin lies on the segment's line, off the segment: only a ray along the line can hit, at the nearer end.
        let near = if p.norm_squared() <= q.norm_squared() { p } else { q };
        let value = 1.0 / sqrt(near.norm_squared());
        for (dx, dy, inverse) in fan.each() {
            if near.x * dy - near.y * dx == 0.0 && near.x * dx + near.y * dy > 0.0 {
                *inverse = raised(*inverse, value);
            }
        }
        return;
    }
    if area < 0.0 {
        (p, q) = (q, p);
    }
    let u = (q - p) / area.abs();
    // seen at a small angle it is nowhere nearer than its nearer end, nor farther than the other
    let (p1, q1) = (1.0 / sqrt(p.norm_squared()), 1.0 / sqrt(q.norm_squared()));
    let thin = p.dot(&q) > 0.0;
    let (least, most) = match (thin, p1 < q1) {
        (false, _) => (0.0, f64::INFINITY),
        (true, true) => (p1, q1),
        (true, false) => (q1, p1),
    };
    let ahead = |dx: f64, dy: f64| if thin { p.x * dx + p.y * dy > 0.0 } else { dx != 0.0 || dy != 0.0 };
    for (dx, dy, inverse) in fan.each() {
        if p.x * dy - p.y * dx >= 0.0 && dx * q.y - dy * q.x >= 0.0 && ahead(dx, dy) {
            *inverse = raised(*inverse, greater(lesser(dx * u.y - dy * u.x, most), least));
        }
    }
}

/// Turns the directions of the sensor's frame by the heading with this cosine and sine, and forgets all ranges.
#[inline(always)]
fn turn_here(units: &[[Lanes; 2]], (c, s): (f64, f64), fan: &mut Fan) {
    for ([x, y], block) in units.iter().zip(&mut fan.blocks) {
        if x[0] > 2.0 {
            break; // never so: see each_block
        }
        for k in 0..LANES {
            block.dx[k] = c * x[k] - s * y[k];
            block.dy[k] = s * x[k] + c * y[k];
            block.inverse[k] = 0.0;
        }
    }
    // what is no ray never waits for a hit
    if let Some(block) = fan.blocks.last_mut() {
        let rays = (fan.rays + LANES - 1) % LANES + 1;
        block.inverse[rays..].fill(f64::INFINITY);
    }
}

/// The ranges, from the inverse ranges: infinity below the least one.
#[inline(always)]
fn ranges_here(fan: &Fan, least: f64, ranges: &mut [f64]) {
    let range = |inverse: f64| if inverse >= least { 1.0 / inverse } else { f64::INFINITY };
    let (eights, rest) = ranges.as_chunks_mut::<LANES>();
    for (ranges, block) in eights.iter_mut().zip(&fan.blocks) {
        if block.dx[0] > 2.0 {
            break; // never so: see each_block
        }
        for (r, inverse) in ranges.iter_mut().zip(block.inverse) {
            *r = range(inverse);
        }
    }
    if let Some(block) = fan.blocks.get(eights.len()) {
        for (r, inverse) in rest.iter_mut().zip(block.inverse) {
            *r = range(inverse);
        }
    }
}

/// The loops for one instruction set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    /// Raises the inverse range of every ray to that of every segment it hits.
    pub(super) raise: fn([&[f64]; 4], &View, &mut Fan),
    /// Turns the directions of the sensor's frame by a heading.
    pub(super) turn: fn(&[[Lanes; 2]], (f64, f64), &mut Fan),
    /// Writes the ranges.
    pub(super) ranges: fn(&Fan, f64, &mut [f64]),
}

/// The same three functions under every set of features; on another machine they are the plain ones.
macro_rules! kernel {
    ($name:ident, $target:literal) => {
        pub(super) mod $name {
            use super::*;

            #[multiversion(targets($target))]
            fn raise(segments: [&[f64]; 4], view: &View, fan: &mut Fan) {
                raise_here(segments, view, fan);
            }

            #[multiversion(targets($target))]
            fn turn(units: &[[Lanes; 2]], heading: (f64, f64), fan: &mut Fan) {
                turn_here(units, heading, fan);
            }

            #[multiversion(targets($target))]
            fn ranges(fan: &Fan, least: f64, ranges: &mut [f64]) {
                ranges_here(fan, least, ranges);
            }

            pub(in super::super) const KERNEL: Kernel = Kernel { raise, turn, ranges };
        }
    };
}

kernel!(avx512, "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl");
kernel!(avx2, "x86_64+avx2");

/// The loops for whatever the program was compiled for: SSE2 on x86-64, on WebAssembly simd128 where that is switched on.
pub(super) const BASELINE: Kernel = Kernel { raise: raise_here, turn: turn_here, ranges: ranges_here };
