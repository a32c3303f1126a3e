//! How far a swept part keeps from a piece in each of eight intervals, and where it surely touches it.

use super::outlines::{PieceAxis, PieceOutline};
use super::swept_part::{Octet, SweptPart, least, ordered};
use crate::collision::LANES;

/// A piece from the point that a part's coordinates count from.
#[derive(Clone, Copy)]
pub(crate) struct LocalPiece<'a> {
    pub(crate) outline: PieceOutline<'a>,
    /// The outline's centre, metres.
    pub(crate) centre: [f32; 2],
}

impl LocalPiece<'_> {
    /// The axes of the piece, with heights from the point that coordinates count from.
    #[inline(always)]
    fn axes(&self) -> impl Iterator<Item = PieceAxis> {
        let [x, y] = self.centre;
        self.outline.axes.iter().map(move |axis| {
            let shift = axis.ahead[0] * x + axis.ahead[1] * y;
            PieceAxis { low: axis.low + shift, high: axis.high + shift, ..*axis }
        })
    }
}

/// How near a part may come to a piece, metres.
#[derive(Clone, Copy)]
pub(crate) struct Reaches {
    /// Farther than this from the piece's core, all that the part sweeps over in an interval is proven clear.
    pub(crate) clear: f32,
    /// The sum of the two radii.
    pub(crate) radius: f32,
    /// Deeper than this is surely contact.
    pub(crate) margin: f32,
}

/// What is known of a part and a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LaneAnswer {
    /// The part keeps clear of the piece in all intervals but these, as bits; clear throughout without any.
    Open(u32),
    /// The part touches the piece in the middle of some interval.
    Contact,
}

/// What is known of a part and a piece.
///
/// An axis separates the two in an interval if their heights along it are apart. The axes tried are those of the part's
/// frame and those of the piece. For two convex cores in contact no axis separates, and these are all that need be
/// tried; the radii count across the part only, where the shapes surely reach that far.
#[cfg_attr(
    not(baseline),
    multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
)]
pub(crate) fn judge(part: &SweptPart, piece: LocalPiece, reaches: Reaches) -> LaneAnswer {
    if part.count == 2 { judged::<2>(part, piece, reaches) } else { judged::<4>(part, piece, reaches) }
}

/// [`judge`] for a part with as many corners.
#[inline(always)]
fn judged<const COUNT: usize>(part: &SweptPart, piece: LocalPiece, reaches: Reaches) -> LaneAnswer {
    let own = own_heights(part, &piece);
    let mut gaps = [f32::NEG_INFINITY; LANES];
    for (own, swept) in own.iter().zip(&part.swept) {
        widen(&mut gaps, own, swept);
    }
    for PieceAxis { ahead: [ahead_x, ahead_y], low, high } in piece.axes() {
        for (i, gap) in gaps.iter_mut().enumerate() {
            let (mut lo, mut hi) = (f32::INFINITY, f32::NEG_INFINITY);
            for c in 0..COUNT {
                let along = ahead_x * part.corners[c][0][i] + ahead_y * part.corners[c][1][i];
                let reach = (ahead_x * part.steps[c][0][i] + ahead_y * part.steps[c][1][i]).abs();
                (lo, hi) = (ordered(lo, along - reach)[0], ordered(hi, along + reach)[1]);
            }
            *gap = ordered(*gap, ordered(low - hi, lo - high)[1])[1];
        }
    }
    if least(gaps) > reaches.clear {
        return LaneAnswer::Open(0);
    }
    if least(depths::<COUNT>(part, &piece, &own, reaches.radius)) < -reaches.margin {
        return LaneAnswer::Contact;
    }
    let mut open = 0;
    for (i, gap) in gaps.iter().enumerate() {
        open |= u32::from(*gap <= reaches.clear) << i;
    }
    LaneAnswer::Open(open)
}

/// The least and the greatest height of the piece's corners along the axes of the part's frame.
#[inline(always)]
fn own_heights(part: &SweptPart, piece: &LocalPiece) -> [[Octet; 2]; 2] {
    let mut heights = [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 2];
    for corner in piece.outline.corners {
        let (x, y) = (corner[0] + piece.centre[0], corner[1] + piece.centre[1]);
        let [[lo_x, hi_x], [lo_y, hi_y]] = &mut heights;
        for i in 0..LANES {
            let (cos, sin) = (part.ahead[0][i], part.ahead[1][i]);
            let (along, across) = (cos * x + sin * y, cos * y - sin * x);
            (lo_x[i], hi_x[i]) = (ordered(lo_x[i], along)[0], ordered(hi_x[i], along)[1]);
            (lo_y[i], hi_y[i]) = (ordered(lo_y[i], across)[0], ordered(hi_y[i], across)[1]);
        }
    }
    heights
}

/// Raises gaps to those between two ranges of heights.
#[inline(always)]
fn widen(gaps: &mut Octet, [low, high]: &[Octet; 2], [lo, hi]: &[Octet; 2]) {
    for i in 0..LANES {
        gaps[i] = ordered(gaps[i], ordered(low[i] - hi[i], lo[i] - high[i])[1])[1];
    }
}

/// The gaps in the middles of the intervals, negative where the two overlap, with a radius across the part.
#[inline(always)]
fn depths<const COUNT: usize>(part: &SweptPart, piece: &LocalPiece, own: &[[Octet; 2]; 2], radius: f32) -> Octet {
    let mut gaps = [f32::NEG_INFINITY; LANES];
    widen(&mut gaps, &own[1], &part.still[1]);
    for gap in &mut gaps {
        *gap -= radius;
    }
    widen(&mut gaps, &own[0], &part.still[0]);
    for PieceAxis { ahead: [ahead_x, ahead_y], low, high } in piece.axes() {
        for (i, gap) in gaps.iter_mut().enumerate() {
            let (mut lo, mut hi) = (f32::INFINITY, f32::NEG_INFINITY);
            for c in 0..COUNT {
                let along = ahead_x * part.corners[c][0][i] + ahead_y * part.corners[c][1][i];
                (lo, hi) = (ordered(lo, along)[0], ordered(hi, along)[1]);
            }
            let across = radius * (ahead_y * part.ahead[0][i] - ahead_x * part.ahead[1][i]).abs();
            *gap = ordered(*gap, ordered(low - hi, lo - high)[1] - across)[1];
        }
    }
    gaps
}
