//! Motions that leave their robot's own limits: they are judged up to there, and hit the limit.

use crate::collision::{Certificate, EdgeVerdict, HitBy};
use crate::robots::{Beginning, Leaving, Motion};

/// The verdict on a motion that leaves its robot's limits: what `judge` says of its beginning, if that is not free,
/// else that it hits the limit. A certificate proves the beginning.
pub(crate) fn judge_beginning<M: Motion>(
    motion: &M,
    leaving: Leaving,
    mut certificate: Option<&mut Certificate>,
    judge: impl FnOnce(&Beginning<M>, Option<&mut Certificate>) -> EdgeVerdict,
) -> EdgeVerdict {
    let Leaving { within_until: until, outside_at, part } = leaving;
    let held = EdgeVerdict::Hit { free_until: until, contact_at: outside_at, part, by: HitBy::Limit };
    let verdict = if outside_at > 0.0 {
        judge(&Beginning { motion, until }, certificate.as_deref_mut())
    } else {
        held // it starts outside
    };
    if let Some(certificate) = certificate {
        certificate.scale(until);
    }
    match verdict {
        EdgeVerdict::Free { .. } => held,
        EdgeVerdict::Hit { free_until, contact_at, part, by } => {
            EdgeVerdict::Hit { free_until: free_until * until, contact_at: contact_at * until, part, by }
        }
        EdgeVerdict::Unresolved { free_until, gap, reason } => {
            EdgeVerdict::Unresolved { free_until: free_until * until, gap, reason }
        }
    }
}
