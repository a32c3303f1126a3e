//! The scan's inner loops, compiled for several instruction sets that all give the same bits.
//!
//! A segment with the ends p, q as seen from the sensor, p x q > 0, meets the ray of unit direction d at 1/t = (d x (q - p)) / (p x q),
//! which is linear in d. A ray meets it when it lies in the closed wedge between p and q: p x d >= 0 and d x q >= 0. Two segments with a
//! common end use the same rounded p, so a ray is on one side of it or on the other: no corner leaks.
//!
//! Only multiplications, additions, comparisons, divisions and square roots are used, each rounded once on every machine; nothing
//! is fused or reordered.

use multiversion::multiversion;

use crate::collision::{LANES, SegmentLanes};
use crate::geometry::{Point2, orientation};
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
    let (low, high) = if steep { (w, h) } else { (h, w) };
    let t = low / high;
    let t2 = t * t;
    let r = t * (C[0] / TURN + t2 * (C[1] / TURN + t2 * (C[2] / TURN + t2 * (C[3] / TURN + t2 * (C[4] / TURN)))));
    let r = if steep { 0.25 - r } else { r };
    let r = if x < 0.0 { 0.5 - r } else { r };
    if y < 0.0 { 1.0 - r } else { r }
}

/// Eight numbers, each made on its own.
#[inline(always)]
pub(super) fn lanes(f: impl FnMut(usize) -> f64) -> Lanes {
    std::array::from_fn(f)
}

/// Eight segments made ready: the wedge, the two coefficients of the inverse range, and the blocks of eight rays it may meet.
struct Ready {
    px: Lanes,
    py: Lanes,
    qx: Lanes,
    qy: Lanes,
    a: Lanes,
    b: Lanes,
    /// The first and the last block with a ray of the wedge, and how many blocks from ray 0 on it reaches beyond the last of all.
    first: [u32; LANES],
    last: [u32; LANES],
    turned: [u32; LANES],
    /// All rays of the blocks from `inner` until before `outer` are in the wedge.
    inner: [u32; LANES],
    outer: [u32; LANES],
    /// Not 0 where no ray can meet it.
    out_of_reach: Lanes,
    /// Not 0 where p x q is mostly rounding.
    doubt: Lanes,
}

#[inline(always)]
fn ready(s: &SegmentLanes, view: &View) -> Ready {
    let (x, y) = (view.origin.x, view.origin.y);
    let (ax, ay) = (lanes(|k| s.ax[k] - x), lanes(|k| s.ay[k] - y));
    let (bx, by) = (lanes(|k| s.bx[k] - x), lanes(|k| s.by[k] - y));
    let (left, right) = (lanes(|k| ax[k] * by[k]), lanes(|k| ay[k] * bx[k]));
    let turn = lanes(|k| left[k] - right[k]);
    let pick = |a: &Lanes, b: &Lanes| lanes(|k| if turn[k] < 0.0 { b[k] } else { a[k] });
    let (px, py, qx, qy) = (pick(&ax, &bx), pick(&ay, &by), pick(&bx, &ax), pick(&by, &ay));
    let area = lanes(|k| turn[k].abs());
    let (ux, uy) = (lanes(|k| qx[k] - px[k]), lanes(|k| qy[k] - py[k]));
    // the nearest point of the segment is between its ends, or one of them
    let out_of_reach = lanes(|k| {
        let between = (px[k] * ux[k] + py[k] * uy[k] < 0.0) & (qx[k] * ux[k] + qy[k] * uy[k] > 0.0);
        let (p2, q2) = (px[k] * px[k] + py[k] * py[k], qx[k] * qx[k] + qy[k] * qy[k]);
        let u2 = ux[k] * ux[k] + uy[k] * uy[k];
        let end2 = if p2 < q2 { p2 } else { q2 };
        let d2 = if between { area[k] * area[k] } else { end2 };
        let scale = if between { u2 } else { 1.0 };
        // NaN, in an empty place, is out of reach
        if d2 <= view.reach_squared * scale { 0.0 } else { 1.0 }
    });
    let doubt = lanes(|k| if area[k] <= DOUBT * (left[k].abs() + right[k].abs()) + 1e-290 { 1.0 } else { 0.0 });
    let (p, q) = (lanes(|k| turns(px[k], py[k])), lanes(|k| turns(qx[k], qy[k])));
    let begin = lanes(|k| {
        let p = p[k] - view.heading;
        if p < SLACK { p + 1.0 } else { p }
    });
    let end = lanes(|k| {
        let wide = q[k] - p[k];
        begin[k] + if wide < -0.25 { wide + 1.0 } else { wide }
    });
    // rounding x - 1/2 to the nearest is rounding x down, or one less where x is whole, which is as good here
    let blocks = view.rays * (1.0 / LANES as f64);
    let down = |turns: f64| (turns * blocks - 0.5) + ROUND;
    let up = |turns: f64| (turns * blocks + 0.5) + ROUND;
    let whole = |x: Lanes| -> [u32; LANES] { std::array::from_fn(|k| x[k].to_bits() as u32) };
    Ready {
        px,
        py,
        qx,
        qy,
        a: lanes(|k| uy[k] / area[k]),
        b: lanes(|k| ux[k] / area[k]),
        first: whole(lanes(|k| down(begin[k] - SLACK))),
        last: whole(lanes(|k| down(end[k] + SLACK))),
        inner: whole(lanes(|k| up(begin[k] + SLACK))),
        outer: whole(lanes(|k| down(end[k] - SLACK))),
        // the rays of a block that is not full are fewer, so one more is taken for good measure
        turned: whole(lanes(|k| {
            let over = end[k] + SLACK - 1.0;
            if over >= 0.0 { up(over) + 1.0 } else { ROUND }
        })),
        out_of_reach,
        doubt,
    }
}

/// Raises the rays that are in the wedge.
#[inline(always)]
fn raise_tested(rays: &mut Rays, (px, py): (f64, f64), (qx, qy): (f64, f64), a: f64, b: f64) {
    let Rays { dx, dy, inverse } = *rays;
    rays.inverse = lanes(|k| {
        let inside = (px * dy[k] - py * dx[k] >= 0.0) & (dx[k] * qy - dy[k] * qx >= 0.0);
        let value = if inside { dx[k] * a - dy[k] * b } else { 0.0 };
        greater(value, inverse[k])
    });
}

/// Raises eight rays that are all in the wedge.
#[inline(always)]
fn raise_all(rays: &mut Rays, a: f64, b: f64) {
    let Rays { dx, dy, inverse } = *rays;
    rays.inverse = lanes(|k| greater(dx[k] * a - dy[k] * b, inverse[k]));
}

#[inline(always)]
fn raise_here(segments: &[SegmentLanes], view: &View, rays: &mut [Rays]) {
    for eight in segments {
        let r = ready(eight, view);
        for k in 0..LANES {
            if r.out_of_reach[k] != 0.0 {
                continue;
            }
            if r.doubt[k] != 0.0 {
                raise_doubtful(eight, k, view, rays);
                continue;
            }
            let (p, q, a, b) = ((r.px[k], r.py[k]), (r.qx[k], r.qy[k]), r.a[k], r.b[k]);
            let (first, last, turned) = (r.first[k] as usize, r.last[k] as usize, r.turned[k] as usize);
            if turned > 0 || r.inner[k] as usize != first + 1 || r.outer[k] as usize != last {
                // past ray 0, or an end so near the first ray of a block that it may be on either side
                for block in rays.iter_mut().take(last + 1).skip(first) {
                    raise_tested(block, p, q, a, b);
                }
                for block in rays.iter_mut().take(turned) {
                    raise_tested(block, p, q, a, b);
                }
                continue;
            }
            let Some(span) = rays.get_mut(first..=last) else { continue };
            let [block, rest @ ..] = span else { continue };
            raise_tested(block, p, q, a, b);
            let [within @ .., block] = rest else { continue };
            for block in within {
                raise_all(block, a, b);
            }
            raise_tested(block, p, q, a, b);
        }
    }
}

/// A segment whose line passes so near the origin that p x q is mostly rounding.
#[cold]
#[inline(never)]
fn raise_doubtful(eight: &SegmentLanes, k: usize, view: &View, rays: &mut [Rays]) {
    let segment = eight.segment(k);
    let (mut p, mut q) = (segment.a - view.origin, segment.b - view.origin);
    let area = orientation(segment.a, segment.b, view.origin);
    if area == 0.0 {
        // The origin lies on the segment's line, off the segment: only a ray along the line can hit, at the nearer end.
        let near = if p.norm_squared() <= q.norm_squared() { p } else { q };
        let value = 1.0 / sqrt(near.norm_squared());
        for block in rays {
            for l in 0..LANES {
                let (dx, dy) = (block.dx[l], block.dy[l]);
                if near.x * dy - near.y * dx == 0.0 && near.x * dx + near.y * dy > 0.0 && value > block.inverse[l] {
                    block.inverse[l] = value;
                }
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
    for block in rays {
        for l in 0..LANES {
            let (dx, dy) = (block.dx[l], block.dy[l]);
            if p.x * dy - p.y * dx >= 0.0 && dx * q.y - dy * q.x >= 0.0 && ahead(dx, dy) {
                let value = greater(lesser(dx * u.y - dy * u.x, most), least);
                if value > block.inverse[l] {
                    block.inverse[l] = value;
                }
            }
        }
    }
}

/// Turns the directions `units` of the sensor's frame by the heading with this cosine and sine, and forgets all ranges.
#[inline(always)]
fn turn_here(units: &[[Lanes; 2]], (c, s): (f64, f64), rays: &mut [Rays]) {
    for ([x, y], rays) in units.iter().zip(rays) {
        *rays = Rays {
            dx: lanes(|k| c * x[k] - s * y[k]),
            dy: lanes(|k| s * x[k] + c * y[k]),
            inverse: [0.0; LANES],
        };
    }
}

/// The ranges, from the inverse ranges: infinity below the least one.
#[inline(always)]
fn ranges_here(rays: &[Rays], least: f64, ranges: &mut [f64]) {
    for (rays, ranges) in rays.iter().zip(ranges.chunks_mut(LANES)) {
        let inverse = rays.inverse;
        let all = lanes(|k| if inverse[k] >= least { 1.0 / inverse[k] } else { f64::INFINITY });
        match <&mut Lanes>::try_from(&mut *ranges) {
            Ok(ranges) => *ranges = all,
            Err(_) => ranges.copy_from_slice(&all[..ranges.len()]),
        }
    }
}

/// The loops for one instruction set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    /// Raises the inverse range of every ray to that of every segment it hits.
    pub(super) raise: fn(&[SegmentLanes], &View, &mut [Rays]),
    /// Turns the directions of the sensor's frame by a heading.
    pub(super) turn: fn(&[[Lanes; 2]], (f64, f64), &mut [Rays]),
    /// Writes the ranges.
    pub(super) ranges: fn(&[Rays], f64, &mut [f64]),
}

/// The same three functions under every set of features; on another machine they are the plain ones.
macro_rules! kernel {
    ($name:ident, $target:literal) => {
        pub(super) mod $name {
            use super::*;

            #[multiversion(targets($target))]
            fn raise(segments: &[SegmentLanes], view: &View, rays: &mut [Rays]) {
                raise_here(segments, view, rays);
            }

            #[multiversion(targets($target))]
            fn turn(units: &[[Lanes; 2]], heading: (f64, f64), rays: &mut [Rays]) {
                turn_here(units, heading, rays);
            }

            #[multiversion(targets($target))]
            fn ranges(rays: &[Rays], least: f64, ranges: &mut [f64]) {
                ranges_here(rays, least, ranges);
            }

            pub(in super::super) const KERNEL: Kernel = Kernel { raise, turn, ranges };
        }
    };
}

kernel!(avx512, "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl");
kernel!(avx2, "x86_64+avx2");

/// The loops for whatever the program was compiled for: SSE2 on x86-64, on WebAssembly simd128 where that is switched on.
pub(super) const BASELINE: Kernel = Kernel { raise: raise_here, turn: turn_here, ranges: ranges_here };
