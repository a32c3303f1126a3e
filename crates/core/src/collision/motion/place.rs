//! Places along a motion, and what is known there when a march or a search sets out.

use crate::geometry::Footprint;

/// A place of a motion.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    /// The parameter, in `[0, 1]`.
    pub(crate) s: f64,
    pub(crate) footprint: &'a Footprint,
}

impl<'a> At<'a> {
    /// The place at `s`.
    #[inline]
    pub(crate) fn new(s: f64, footprint: &'a Footprint) -> Self {
        At { s, footprint }
    }
}

/// The footprints at the two ends of a motion.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    /// The footprint at 0.
    pub(crate) start: &'a Footprint,
    /// The footprint at 1.
    pub(crate) end: &'a Footprint,
}

pub(crate) struct MotionStart {
    pub(crate) footprint: Footprint,
    /// Its distance from the nearest obstacle, metres; 0 in contact.
    pub(crate) distance: f64,
}

/// What a march sets out on: a motion with a free start.
pub(crate) struct Course<'a> {
    /// The footprint at the start.
    pub(crate) start: Footprint,
    /// By how much the clearance at the start exceeds the margin, metres.
    pub(crate) gap: f64,
    /// The footprint at the end.
    pub(crate) end: &'a Footprint,
}

/// A free place of a motion, with a contact known farther on.
#[derive(Clone, Copy)]
pub(crate) struct ContactAhead<'a> {
    pub(crate) from: At<'a>,
    /// The clearance there, less the margin, metres.
    pub(crate) gap: f64,
    /// The parameter at which there is contact.
    pub(crate) contact: f64,
}
