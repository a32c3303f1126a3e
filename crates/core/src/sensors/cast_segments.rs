//! Raises the inverse ranges of the rays that meet segments, without unpredictable branches.

use super::rays::{Fan, Rays, each_block, each_ray, raised, some};
use super::view::View;
use super::wedges::{BATCH, PreparedSegments, kind};
use crate::geometry::{Point2, Segment, orientation};
use crate::num::{greater, lesser, sqrt};

/// Largest number of blocks between a segment's first and its last that it adds to the common list; a segment with more
/// has a loop of its own.
const WIDE: usize = 8;

/// Number of bits in a pair for the number of a block: 26 suffice for 500 million rays, and leave 6 for one of 64
/// segments.
const BITS: u32 = 26;

/// The working memory for raising rays, kept from batch to batch.
#[derive(Clone, Debug)]
pub(super) struct RayMemory {
    pub(super) ready: PreparedSegments,
    /// The numbers of the segments that can raise anything.
    able: [u32; BATCH],
    /// Pairs of a segment and a block all of whose rays are in the segment's wedge: the segment's number in the high
    /// bits, the block's in the low [`BITS`]. The array is longer by [`WIDE`], because that many pairs are written at a
    /// time.
    within: [u32; BATCH * WIDE + WIDE],
}

impl Default for RayMemory {
    fn default() -> Self {
        RayMemory { ready: PreparedSegments::default(), able: [0; BATCH], within: [0; BATCH * WIDE + WIDE] }
    }
}

/// Raises the rays that meet the prepared segments.
#[inline(always)]
pub(super) fn raise_ready(desk: &mut RayMemory, [ax, ay, bx, by]: [&[f64]; 4], view: &View, fan: &mut Fan) {
    let RayMemory { ready, able, within } = desk;
    let blocks = &mut fan.blocks[..];
    let (open, nothing) = (fan.open, view.nothing);
    let (mut count, mut pairs) = (0, 0);
    for k in 0..ax.len().min(BATCH) {
        let (kind, first, last) = ready.span(k);
        // with more than 64 blocks all count as open, whatever the shifts give
        let seen = (open >> (first % 64)) << (63 - last.wrapping_sub(first) % 64) != 0;
        able[count] = k as u32;
        count += usize::from((kind != kind::NONE) & (seen | (kind != kind::SURE)));
    }
    for &k in &able[..count] {
        let number = k as usize % BATCH;
        let (kind, first, last) = ready.span(number);
        if kind == kind::DOUBTFUL {
            let ends = [ax[number], ay[number], bx[number], by[number]];
            raise_doubtful(ends, view, blocks);
            continue;
        }
        let wedge = ready.wedge(number);
        if kind == kind::UNSURE {
            each_block(some(blocks, first..last + 1), |block| block.raise_tested(&wedge, nothing));
            each_block(some(blocks, 0..ready.turned(number)), |block| block.raise_tested(&wedge, nothing));
            continue;
        }
        let Some(block) = blocks.get_mut(first) else { continue };
        block.raise_tested(&wedge, nothing);
        let Some(block) = blocks.get_mut(last) else { continue };
        block.raise_tested(&wedge, nothing);
        let between = last.saturating_sub(first + 1);
        if between > WIDE {
            each_block(some(blocks, first + 1..last), |block| block.raise_all(wedge.inverse, nothing));
        } else if let Some(room) = within.get_mut(pairs..pairs + WIDE) {
            let next = k << BITS | (first as u32 + 1);
            for (i, pair) in room.iter_mut().enumerate() {
                *pair = next + i as u32;
            }
            pairs += between;
        }
    }
    for &pair in &within[..pairs] {
        if let Some(block) = blocks.get_mut((pair & ((1 << BITS) - 1)) as usize) {
            block.raise_all(ready.inverse((pair >> BITS) as usize % BATCH), nothing);
        }
    }
}

/// Raises the rays that meet a segment whose line passes so near the origin that p x q is mostly rounding.
#[cold]
#[inline(never)]
fn raise_doubtful([ax, ay, bx, by]: [f64; 4], view: &View, blocks: &mut [Rays]) {
    let segment = Segment::new(Point2::new(ax, ay), Point2::new(bx, by));
    let (mut p, mut q) = (segment.a - view.origin, segment.b - view.origin);
    let area = orientation(segment.a, segment.b, view.origin);
    if area == 0.0 {
        // The origin lies on the segment's line, off the segment: only a ray along the line can hit, at the nearer end.
        let near = if p.norm_squared() <= q.norm_squared() { p } else { q };
        let value = 1.0 / sqrt(near.norm_squared());
        for (dx, dy, inverse) in each_ray(blocks) {
            if near.x * dy - near.y * dx == 0.0 && near.x * dx + near.y * dy > 0.0 {
                *inverse = raised(*inverse, value, view.nothing);
            }
        }
        return;
    }
    if area < 0.0 {
        (p, q) = (q, p);
    }
    let u = (q - p) / area.abs();
    // seen at a small angle, the segment is nowhere nearer than its nearer end, nor farther than its farther end
    let (p1, q1) = (1.0 / sqrt(p.norm_squared()), 1.0 / sqrt(q.norm_squared()));
    let thin = p.dot(&q) > 0.0;
    let (least, most) = match (thin, p1 < q1) {
        (false, _) => (0.0, f64::INFINITY),
        (true, true) => (p1, q1),
        (true, false) => (q1, p1),
    };
    let ahead = |dx: f64, dy: f64| if thin { p.x * dx + p.y * dy > 0.0 } else { dx != 0.0 || dy != 0.0 };
    for (dx, dy, inverse) in each_ray(blocks) {
        if p.x * dy - p.y * dx >= 0.0 && dx * q.y - dy * q.x >= 0.0 && ahead(dx, dy) {
            *inverse = raised(*inverse, greater(lesser(dx * u.y - dy * u.x, most), least), view.nothing);
        }
    }
}
