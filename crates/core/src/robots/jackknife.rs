//! The jackknife limit along a chart line, in closed form.

use std::f64::consts::PI;

use super::Leaving;
use crate::configuration::{Configuration, HitchCfg};
use crate::num::{greater, lesser, ulp};

/// The number of the part that the limit holds: the trailer.
pub(super) const TRAILER: usize = 1;

/// Where the chart line from `a` to `b` takes the hitch beyond an angle of `limit` radians to either side.
///
/// Along the line the angle changes evenly, and by up to a whole turn each way: both headings go the short way round.
/// So it leaves the limit where the line to its end does, and only there. A line whose end lies within, reached without
/// going round, stays within; its computed places may pass the limit by the rounding of the angles, a few ulps of pi.
pub(super) fn leaves_along_line(limit: f64, a: &HitchCfg, b: &HitchCfg) -> Option<Leaving> {
    let (from, to) = (a.hitch_angle()?, b.hitch_angle()?);
    let within = |angle: f64| angle.abs() <= limit;
    if !within(from) {
        return Some(Leaving { within_until: 0.0, outside_at: 0.0, part: TRAILER });
    }
    let d = a.difference(b).ok()?;
    let sweep = d.get(3)? - d[2];
    let goes_round = limit < PI && (from + sweep).abs() > PI;
    if within(to) && !goes_round {
        return None;
    }
    let s = (limit.copysign(sweep) - from) / sweep;
    // what the headings, their difference and the parameter are rounded by
    let rounding = 16.0 * ulp(PI) / sweep.abs();
    let (within_until, outside_at) = (greater(s - rounding, 0.0), lesser(s + rounding, 1.0));
    Some(Leaving { within_until: lesser(within_until, outside_at), outside_at, part: TRAILER })
}
