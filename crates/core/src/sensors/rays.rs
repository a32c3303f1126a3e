//! `Fan`, the rays of a scan under way, in blocks of eight.

use super::wedges::{Inverse, Wedge};
use crate::collision::LANES;
use crate::geometry::SinCos;
use crate::num::{greater, lesser};

/// Eight numbers side by side.
pub(super) type Lanes = [f64; LANES];

/// Eight rays: their directions in the world and the greatest inverse range along each so far. Unused places have the
/// direction 0, along which every inverse range is 0.
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
    /// The blocks with rays that may still be raised, a bit each; all bits are set if there are more than 64 blocks.
    pub(super) open: u64,
}

/// The greater of the inverse range so far and a new one. `nothing` is 0, which the compiler does not know. Adding it
/// keeps the compiler from leaving out the stores that would change nothing: a store under a condition is slow.
#[inline(always)]
pub(super) fn raised(so_far: f64, value: f64, nothing: f64) -> f64 {
    greater(value, so_far + nothing)
}

impl Rays {
    /// Raises those of the eight that are in the wedge.
    #[inline(always)]
    pub(super) fn raise_tested(&mut self, w: &Wedge, nothing: f64) {
        for ((dx, dy), inverse) in self.dx.iter().zip(&self.dy).zip(&mut self.inverse) {
            let inside = (w.p.0 * dy - w.p.1 * dx >= 0.0) & (dx * w.q.1 - dy * w.q.0 >= 0.0);
            let value = if inside { dx * w.inverse.a - dy * w.inverse.b } else { 0.0 };
            *inverse = raised(*inverse, value, nothing);
        }
    }

    /// Raises all eight rays, which are in the wedge with this inverse range.
    #[inline(always)]
    pub(super) fn raise_all(&mut self, in_wedge: Inverse, nothing: f64) {
        let Inverse { a, b } = in_wedge;
        for ((dx, dy), inverse) in self.dx.iter().zip(&self.dy).zip(&mut self.inverse) {
            *inverse = raised(*inverse, dx * a - dy * b, nothing);
        }
    }
}

/// Calls `raise` with each block.
#[inline(always)]
pub(super) fn each_block(blocks: &mut [Rays], mut raise: impl FnMut(&mut Rays)) {
    for block in blocks {
        // Never true. It keeps the compiler from working on several blocks at once, lane by lane, with gathers.
        if block.dx[0] > 2.0 {
            break;
        }
        raise(block);
    }
}

/// Each ray of some blocks: its direction and its inverse range.
pub(super) fn each_ray(blocks: &mut [Rays]) -> impl Iterator<Item = (f64, f64, &mut f64)> {
    blocks
        .iter_mut()
        .flat_map(|b| b.dx.iter().zip(&b.dy).zip(&mut b.inverse).map(|((dx, dy), inverse)| (*dx, *dy, inverse)))
}

/// The blocks in a range, as far as they exist.
#[inline(always)]
pub(super) fn some(blocks: &mut [Rays], range: std::ops::Range<usize>) -> &mut [Rays] {
    let end = range.end.min(blocks.len());
    blocks.get_mut(range.start..end).unwrap_or_default()
}

impl Fan {
    /// This many rays, without a direction yet.
    pub(super) fn new(rays: usize) -> Self {
        let zero = [0.0; LANES];
        let blocks = vec![Rays { dx: zero, dy: zero, inverse: zero }; rays.div_ceil(LANES)];
        Fan { blocks, rays, open: u64::MAX }
    }

    /// Sets the rays' directions to those of the sensor's frame, turned by the heading, and resets their inverse
    /// ranges.
    #[inline(always)]
    pub(super) fn turn(&mut self, units: &[[Lanes; 2]], heading: SinCos) {
        let SinCos { sin: s, cos: c } = heading;
        for ([x, y], block) in units.iter().zip(&mut self.blocks) {
            if x[0] > 2.0 {
                break; // never so: see each_block
            }
            for k in 0..LANES {
                block.dx[k] = c * x[k] - s * y[k];
                block.dy[k] = s * x[k] + c * y[k];
                block.inverse[k] = 0.0;
            }
        }
        // an unused place never waits for a hit
        if let Some(block) = self.blocks.last_mut() {
            let rays = (self.rays + LANES - 1) % LANES + 1;
            block.inverse[rays..].fill(f64::INFINITY);
        }
    }

    /// Writes 1 for each block that has a ray that hits nothing within a box about the sensor, 0 for the others. The
    /// box is given by the inverse distances of its right, left, upper and lower side, those of the left and the lower
    /// one negative.
    #[inline(always)]
    pub(super) fn open(&self, [right, left, upper, lower]: [f64; 4], open: &mut [u8]) {
        for (block, open) in self.blocks.iter().zip(open) {
            if block.dx[0] > 2.0 {
                break; // never so: see each_block
            }
            let mut closed = true;
            for ((dx, dy), inverse) in block.dx.iter().zip(&block.dy).zip(&block.inverse) {
                let (across, along) = (greater(dx * right, dx * left), greater(dy * upper, dy * lower));
                closed &= *inverse >= greater(across, along);
            }
            *open = u8::from(!closed);
        }
    }

    /// Writes the ranges from the inverse ranges: infinity beyond the greatest one. A hit beyond it by no more than
    /// four ulps still counts, because inverses are rounded; it reads the greatest range.
    #[inline(always)]
    pub(super) fn ranges(&self, greatest: f64, ranges: &mut [f64]) {
        let least = (1.0 - 4.0 * f64::EPSILON) / greatest;
        // divided always, then chosen: a division under a condition is done ray by ray
        let range = |inverse: f64| {
            let hit = lesser(1.0 / inverse, greatest);
            if inverse >= least { hit } else { f64::INFINITY }
        };
        let (eights, rest) = ranges.as_chunks_mut::<LANES>();
        for (ranges, block) in eights.iter_mut().zip(&self.blocks) {
            if block.dx[0] > 2.0 {
                break; // never so: see each_block
            }
            for (r, inverse) in ranges.iter_mut().zip(block.inverse) {
                *r = range(inverse);
            }
        }
        if let Some(block) = self.blocks.get(eights.len()) {
            for (r, inverse) in rest.iter_mut().zip(block.inverse) {
                *r = range(inverse);
            }
        }
    }
}
