//! Sweeps, the sets that motions cover, and whether two of them come near one another.

use motion_lab_core::collision::distance;
use motion_lab_core::geometry::{Placed, Vertices};
use motion_lab_core::robots::Motion;

/// Number of halvings of two motions, to pieces of 1/64; pieces still undecided then count as meeting.
const LEVELS: u32 = 6;

/// The set that a robot's cut motion covers, its type forgotten.
pub trait CoveredSet: Send + Sync {
    /// The number of the footprint's parts.
    fn parts(&self) -> usize;

    /// Whether the robot stands still.
    fn is_still(&self) -> bool;

    /// A convex shape that contains everything that part number `part` covers between the fractions `from` and `to` of
    /// the cut motion.
    fn cover(&self, part: usize, from: f64, to: f64) -> Placed;
}

/// A motion cut at a parameter.
#[derive(Debug)]
pub struct CutMotion<'a, M> {
    /// The motion.
    pub motion: &'a M,
    /// The parameter at which it ends.
    pub until: f64,
}

impl<M: Motion + Send + Sync> CoveredSet for CutMotion<'_, M> {
    fn parts(&self) -> usize {
        self.motion.footprint_at(0.0).parts().len()
    }

    fn is_still(&self) -> bool {
        self.until == 0.0 || (0..self.parts()).all(|k| self.motion.rates(k).speed == 0.0)
    }

    fn cover(&self, part: usize, from: f64, to: f64) -> Placed {
        let (s0, s1) = (from * self.until, to * self.until);
        let (a, b) = (self.motion.footprint_at(s0), self.motion.footprint_at(s1));
        let hull = a.parts()[part].placed().hull_with(b.parts()[part].placed());
        Placed::new(Vertices::from_slice(hull.core()), hull.radius() + self.motion.sagitta(part, s0, s1))
    }
}

/// Whether two sweeps come within `margin` metres of one another. Conservative: never `false` for sweeps that do.
///
/// The whole of one sweep is compared with the whole of the other, regardless of when the robots are where.
pub fn sweeps_meet(a: &dyn CoveredSet, b: &dyn CoveredSet, margin: f64) -> bool {
    (0..a.parts()).any(|i| (0..b.parts()).any(|j| pieces_meet((a, i, 0.0, 1.0), (b, j, 0.0, 1.0), margin, LEVELS)))
}

/// One part of a sweep between two fractions of its motion.
type SweptPiece<'a> = (&'a dyn CoveredSet, usize, f64, f64);

fn pieces_meet(a: SweptPiece, b: SweptPiece, margin: f64, levels: u32) -> bool {
    if distance(&a.0.cover(a.1, a.2, a.3), &b.0.cover(b.1, b.2, b.3)) > margin {
        return false;
    }
    if levels == 0 {
        return true;
    }
    let ([a0, a1], [b0, b1]) = (halves(a), halves(b));
    [(a0, b0), (a0, b1), (a1, b0), (a1, b1)].into_iter().any(|(a, b)| pieces_meet(a, b, margin, levels - 1))
}

fn halves((sweep, part, from, to): SweptPiece) -> [SweptPiece; 2] {
    let middle = 0.5 * (from + to);
    [(sweep, part, from, middle), (sweep, part, middle, to)]
}
