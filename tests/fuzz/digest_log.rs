//! Logs of digests, MCAP; what is asked of them is in `sealed`.

use super::sealed;
use motion_lab::run::LogKind;

/// Records, writes, damages and reads a log of digests.
pub fn check(data: &[u8]) -> bool {
    sealed::check(data, LogKind::Digests)
}
