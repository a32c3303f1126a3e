//! `Motion`, the common interface of planners' edges and simulated ticks, which the certified march and the simulator's
//! holding work on.

use super::linkage::Linkage;
use crate::configuration::Configuration;
use crate::geometry::{CircularArc, Footprint, Segment};

/// Bounds on how the points of one part's core move, per unit of the motion's parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rates {
    /// No point of the core moves faster than this, metres.
    pub speed: f64,
    /// The second derivative of no point of the core is longer than this, metres.
    pub acceleration: f64,
}

/// Where a motion leaves its robot's own limits, which no obstacle sets: a hitch folds only so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaving {
    /// Up to this parameter the configuration lies within the limits. 0 also where the start lies outside.
    pub within_until: f64,
    /// At this parameter it lies outside; 0 where the start does.
    pub outside_at: f64,
    /// The number of the part that the limit holds.
    pub part: usize,
}

/// A continuous motion over the parameter `s` in `[0, 1]`: an edge of a roadmap, a tick of a drive.
pub trait Motion {
    /// The type of its configurations.
    type Configuration: Configuration;

    /// The configuration at `s`; at 0 and 1 the motion's ends, bit for bit.
    fn at(&self, s: f64) -> Self::Configuration;

    /// The footprint at `s`. Every `s` gives the same number of parts, in the same order.
    fn footprint_at(&self, s: f64) -> Footprint;

    /// Bounds that hold for part number `part` over the whole motion.
    fn rates(&self, part: usize) -> Rates;

    /// The arc that the centre of the footprint's only part follows, and the part's radius, where the part is a disc
    /// and the motion such an arc. For these the checker has closed forms.
    fn disc_arc(&self) -> Option<(CircularArc, f64)> {
        None
    }

    /// The line that the centre of the footprint's only part follows at a constant speed, and the part's radius, where
    /// the part is a disc and the motion such a line. For these the checker has closed forms.
    fn disc_line(&self) -> Option<(Segment, f64)> {
        None
    }

    /// The motion as a linkage, where it is one.
    #[doc(hidden)]
    fn linkage(&self) -> Option<Linkage> {
        None
    }

    /// Where the motion first leaves its robot's own limits; `None` where it stays within them throughout, as every
    /// motion of a robot without limits does.
    fn leaves_limits(&self) -> Option<Leaving> {
        None
    }

    /// How far part number `part`, as a set, can move between `s0` and `s1`, metres.
    ///
    /// The radius does not count: turning a capsule's core on the spot moves the set by as much as the core.
    fn bound(&self, part: usize, s0: f64, s1: f64) -> f64 {
        self.rates(part).speed * (s1 - s0).abs()
    }

    /// How far a point of the core can stray from the straight chord between its places at `s0` and `s1`, metres.
    ///
    /// For a curve whose second derivative is at most A, linear interpolation over a span h errs by at most A h^2 / 8.
    /// So all that the part touches between `s0` and `s1` lies within this distance of the convex hull of its two end
    /// footprints: the bound near a grazed wall is of second order.
    fn sagitta(&self, part: usize, s0: f64, s1: f64) -> f64 {
        let h = s1 - s0;
        0.125 * self.rates(part).acceleration * h * h
    }
}

/// The beginning of a motion, up to one of its parameters, as a motion of its own. Its places are the motion's own, bit
/// for bit: `s` here is `s * until` there.
pub struct Beginning<'a, M> {
    /// The motion.
    pub motion: &'a M,
    /// The parameter of the motion at which this one ends.
    pub until: f64,
}

impl<M: Motion> Motion for Beginning<'_, M> {
    type Configuration = M::Configuration;

    fn at(&self, s: f64) -> M::Configuration {
        self.motion.at(s * self.until)
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        self.motion.footprint_at(s * self.until)
    }

    fn rates(&self, part: usize) -> Rates {
        let Rates { speed, acceleration } = self.motion.rates(part);
        Rates { speed: speed * self.until, acceleration: acceleration * self.until * self.until }
    }

    fn bound(&self, part: usize, s0: f64, s1: f64) -> f64 {
        self.motion.bound(part, s0 * self.until, s1 * self.until)
    }

    fn sagitta(&self, part: usize, s0: f64, s1: f64) -> f64 {
        self.motion.sagitta(part, s0 * self.until, s1 * self.until)
    }
}
