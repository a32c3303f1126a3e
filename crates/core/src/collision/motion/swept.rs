//! The swept query: every part's frame origin moves in a straight line while the part turns the short way.

use smallvec::SmallVec;

use super::decide::is_free_or;
use crate::collision::{Collision, EdgeVerdict, MarchOptions};
use crate::configuration::R2;
use crate::geometry::{Footprint, Part, Pose2};
use crate::num::{hypot, wrap};
use crate::robots::{Motion, Rates};

/// The march's options for a sweep. A sweep that is undecided after the budget of proof attempts counts as a hit. The
/// budget is enough to resolve a clearance of 1e-6 m along a metre of travel and a full half turn of a part ten metres
/// long.
pub(crate) const SWEEP: MarchOptions = MarchOptions { margin: 0.0, budget: 1 << 18 };

/// The rigid motion of every part from its pose in one footprint to its pose in another.
pub(crate) struct PartsMotion<'a> {
    from: &'a Footprint,
    to: &'a Footprint,
    turns: SmallVec<[f64; 3]>,
    rates: SmallVec<[Rates; 3]>,
}

impl Motion for PartsMotion<'_> {
    type Configuration = R2;

    /// The position of the first part's frame, as a stand-in; the sweep itself is in the footprints.
    fn at(&self, s: f64) -> R2 {
        self.footprint_at(s).parts().first().map_or(R2::new(0.0, 0.0), |p| R2(p.pose().position()))
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        if s <= 0.0 {
            return self.from.clone();
        }
        if s >= 1.0 {
            return self.to.clone();
        }
        let parts = self.from.parts().iter().zip(self.to.parts()).zip(&self.turns);
        Footprint::new(parts.map(|((a, b), turn)| {
            let (p, q) = (a.pose(), b.pose());
            let pose = Pose2::new(p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.theta + s * turn);
            Part::new(pose, a.shape().clone())
        }))
    }

    fn rates(&self, part: usize) -> Rates {
        self.rates[part]
    }
}

/// Whether the sweep from `a` to `b` hits; true also where `judge` cannot prove it free.
pub(crate) fn hits(
    collision: &dyn Collision,
    a: &Footprint,
    b: &Footprint,
    judge: impl FnOnce(&PartsMotion<'_>) -> EdgeVerdict,
) -> bool {
    let same_parts =
        a.parts().len() == b.parts().len() && a.parts().iter().zip(b.parts()).all(|(p, q)| p.shape() == q.shape());
    if !same_parts || !a.is_valid() || !b.is_valid() {
        return true;
    }
    if a == b {
        return collision.intersects(a);
    }
    let turns: SmallVec<[f64; 3]> =
        a.parts().iter().zip(b.parts()).map(|(p, q)| wrap(q.pose().theta - p.pose().theta)).collect();
    let rates = a.parts().iter().zip(b.parts()).zip(&turns).map(|((p, q), turn)| {
        let travel = hypot(q.pose().x - p.pose().x, q.pose().y - p.pose().y);
        let reach = p.shape().core_reach();
        Rates { speed: travel + reach * turn.abs(), acceleration: reach * turn * turn }
    });
    let rates = rates.collect();
    let motion = PartsMotion { from: a, to: b, turns, rates };
    !is_free_or(collision, &motion, 0.0, || judge(&motion))
}
