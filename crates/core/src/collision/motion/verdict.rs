//! `EdgeVerdict`, what is known of a motion, and the options of the march.

use crate::collision::HitBy;

/// What is known of a motion over its parameter `s` in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeVerdict {
    /// The whole motion is proven free.
    Free {
        /// A proven lower bound of the clearance along it, metres; infinity in an empty scene.
        clearance: f64,
    },
    /// The motion hits.
    Hit {
        /// Everything before this `s` is proven free. 0 when the start is in contact.
        free_until: f64,
        /// At this `s` the footprint is in contact, or the configuration outside the robot's own limits.
        contact_at: f64,
        /// The part in contact there, or held by the limit.
        part: usize,
        /// The obstacle it touches, or the limit.
        by: HitBy,
    },
    /// Neither could be proven.
    Unresolved {
        /// Everything before this `s` is proven free.
        free_until: f64,
        /// How far the footprint can still move after `free_until`, to the motion's end or the first contact known,
        /// metres.
        gap: f64,
        /// Why the march ended.
        reason: UnresolvedReason,
    },
}

/// Why a march ended without a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnresolvedReason {
    /// The clearance fell below what a proof can distinguish from contact, given rounding.
    Tolerance,
    /// The budget of steps was used up.
    Budget,
}

impl UnresolvedReason {
    /// The reason's name, as the command `query` prints it.
    pub const fn name(self) -> &'static str {
        match self {
            UnresolvedReason::Tolerance => "tolerance",
            UnresolvedReason::Budget => "budget",
        }
    }
}

/// The options of a march.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchOptions {
    /// The clearance that the motion must exceed, metres: one that comes as close counts as a hit. With 0 only contact
    /// does, and a margin below 0 counts as 0; above one that is no number nothing is.
    pub margin: f64,
    /// The greatest number of proof attempts.
    pub budget: u32,
}

impl Default for MarchOptions {
    fn default() -> Self {
        MarchOptions { margin: 0.0, budget: 4096 }
    }
}

impl EdgeVerdict {
    /// Whether the whole motion is proven free.
    pub fn is_free(&self) -> bool {
        matches!(self, EdgeVerdict::Free { .. })
    }
}
