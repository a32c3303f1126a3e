//! The scan's loops, compiled for several instruction sets that all give the same bits.
//!
//! A segment with the ends p, q as seen from the sensor, p x q > 0, meets the ray of unit direction d at
//! `1/t = (d x (q - p)) / (p x q)`, which is linear in d. A ray meets it when it lies in the closed wedge between p and
//! q: `p x d >= 0` and `d x q >= 0`. Two segments with a common end use the same rounded p, so a ray is on one side of
//! it or on the other: no corner leaks.
//!
//! Only multiplications, additions, comparisons, divisions and square roots are used, each rounded once on every
//! machine; nothing is fused or reordered.

use multiversion::multiversion;

use super::cast_discs::raise_circle;
use super::cast_segments::{RayMemory, raise_ready};
use super::rays::{Fan, Lanes};
use super::view::View;
use super::wedges::{BATCH, PreparedSegments};
use crate::collision::Circle;
use crate::geometry::SinCos;

/// The loops for one instruction set. They are separate functions, so that each has the registers to itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    /// Turns the directions of the sensor's frame by a heading.
    pub(super) turn: fn(&mut Fan, &[[Lanes; 2]], SinCos),
    pub(super) make: fn(&mut PreparedSegments, [&[f64]; 4], &View),
    /// Raises the rays that meet the prepared segments.
    pub(super) raise: fn(&mut RayMemory, [&[f64]; 4], &View, &mut Fan),
    /// Raises the rays that meet a disc.
    pub(super) circle: fn(&Circle, &View, &mut Fan),
    /// Marks the blocks that have a ray that hits nothing within a box.
    pub(super) open: fn(&Fan, [f64; 4], &mut [u8]),
    pub(super) ranges: fn(&Fan, f64, &mut [f64]),
}

/// Raises every ray's inverse range to that of every segment it hits. The arrays of the ends' coordinates are padded to
/// a multiple of eight.
pub(super) fn raise([ax, ay, bx, by]: [&[f64]; 4], view: &View, kernel: &Kernel, fan: &mut Fan, desk: &mut RayMemory) {
    for from in (0..ax.len()).step_by(BATCH) {
        let to = (from + BATCH).min(ax.len());
        let batch = [&ax[from..to], &ay[from..to], &bx[from..to], &by[from..to]];
        (kernel.make)(&mut desk.ready, batch, view);
        if let Some(blocks) = view.fan_blocks {
            desk.ready.clip(blocks);
        }
        (kernel.raise)(desk, batch, view, fan);
    }
}

/// Defines the same functions for a set of target features; a machine without these runs the baseline.
macro_rules! kernel {
    ($name:ident $(, #[$target:meta])?) => {
        pub(super) mod $name {
            use crate::sensors::kernel::*;

            $(#[$target])?
            fn turn(fan: &mut Fan, units: &[[Lanes; 2]], heading: SinCos) {
                fan.turn(units, heading);
            }

            $(#[$target])?
            fn make(ready: &mut PreparedSegments, segments: [&[f64]; 4], view: &View) {
                ready.make(segments, view);
            }

            $(#[$target])?
            fn raise(desk: &mut RayMemory, segments: [&[f64]; 4], view: &View, fan: &mut Fan) {
                raise_ready(desk, segments, view, fan);
            }

            $(#[$target])?
            fn circle(circle: &Circle, view: &View, fan: &mut Fan) {
                raise_circle(circle, view, fan);
            }

            $(#[$target])?
            fn open(fan: &Fan, sides: [f64; 4], open: &mut [u8]) {
                fan.open(sides, open);
            }

            $(#[$target])?
            fn ranges(fan: &Fan, greatest: f64, ranges: &mut [f64]) {
                fan.ranges(greatest, ranges);
            }

            pub(in super::super) const KERNEL: Kernel = Kernel { turn, make, raise, circle, open, ranges };
        }
    };
}

kernel!(avx512, #[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"))]);
kernel!(avx2, #[multiversion(targets("x86_64+avx2"))]);
// whatever the program was compiled for: SSE2 on x86-64, on WebAssembly simd128 where that is switched on
kernel!(baseline);
