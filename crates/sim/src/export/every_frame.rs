//! The frames of a run, one after another.

use crate::run::{Frame, Log};

/// A log's frames from tick 0 on.
pub(super) fn every_frame(log: &Log) -> impl Iterator<Item = &Frame> {
    log.initial().into_iter().chain(log.frames())
}
