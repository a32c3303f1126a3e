//! A tick's motion: whether it is free, and how far it keeps its margin.

use super::conservative_advancement::{clearance_of_all, march, march_on};
use super::decide::is_free_or;
use super::place::{Ends, MotionStart};
use super::separation::is_separated;
use crate::collision::{Collision, EdgeVerdict, MarchOptions};
use crate::robots::Motion;

/// Whether a motion is proven free, in any checker, and stays within its robot's own limits.
pub fn is_free_among<M: Motion>(collision: &dyn Collision, motion: &M) -> bool {
    let options = MarchOptions::default();
    motion.leaves_limits().is_none()
        && is_free_or(collision, motion, options.margin, || march(collision, motion, options, None))
}

/// A motion that does not keep its margin everywhere.
#[derive(Clone, Copy, Debug)]
pub struct UnkeptMargin {
    /// The clearance at the start, metres; 0 in contact.
    pub start: f64,
    /// The parameter up to which the motion is proven to keep its margin.
    pub until: f64,
}

/// Whether a motion within its robot's own limits keeps a margin that depends on its clearance at the start, metres; if
/// not, how far it does. `enough` is no less than any margin: a motion that keeps so much needs no query of its start.
pub fn keeps<M: Motion>(
    collision: &dyn Collision,
    motion: &M,
    enough: f64,
    margin: impl FnOnce(f64) -> f64,
) -> Result<(), UnkeptMargin> {
    // two bindings: as a pair both would be copied once more
    let start = motion.footprint_at(0.0);
    let end = motion.footprint_at(1.0);
    if is_separated(collision, motion, enough, Ends { start: &start, end: &end }) {
        return Ok(());
    }
    let all = clearance_of_all(collision, motion, &start);
    if all > enough {
        return Ok(());
    }
    let clearance = collision.distance(&start);
    if clearance <= 0.0 {
        return Err(UnkeptMargin { start: 0.0, until: 0.0 });
    }
    let options = MarchOptions { margin: margin(clearance), ..MarchOptions::default() };
    if all > options.margin {
        return Ok(());
    }
    match march_on(collision, motion, options, None, MotionStart { footprint: start, distance: clearance }) {
        EdgeVerdict::Free { .. } => Ok(()),
        EdgeVerdict::Hit { free_until, .. } | EdgeVerdict::Unresolved { free_until, .. } => {
            Err(UnkeptMargin { start: clearance, until: free_until })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Scene;
    use crate::configuration::HitchCfg;
    use crate::geometry::{Aabb, Point2, Pose2};
    use crate::robots::{HITCH, Robot};

    #[test]
    fn a_motion_beyond_its_robots_limit_is_not_free_however_empty_the_scene() {
        let scene = Scene::empty(Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) });
        let folded = |psi| HitchCfg { body: Pose2::IDENTITY, trailer: Some(psi) };
        let is_free = |limit: Option<f64>, to: f64| {
            let car = limit.map_or(HITCH.with_trailer(), |limit| HITCH.with_trailer().with_jackknife(limit));
            is_free_among(&scene, &car.edge(&folded(0.0), &folded(to)).unwrap())
        };
        assert_eq!([1.0, 1.25, 1.5].map(|to| is_free(Some(1.25), to)), [true, true, false]);
        assert!(is_free(None, 1.5));
    }
}
