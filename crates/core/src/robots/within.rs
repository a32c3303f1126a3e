//! Whether a motion keeps its robot's position within a box.

use super::{Motion, Robot};
use crate::geometry::{Aabb, Point2, Vector2};
use crate::num::lesser;

/// The length over which an arc may lie beyond a side, metres: what is shorter is rounding.
const ROUNDING: f64 = 1e-9;

/// Whether the robot's [position](Robot::position) stays within the bounds along a whole motion. Their sides belong to
/// them. True for a robot without a position.
pub(crate) fn stays_within<R: Robot, M: Motion<Configuration = R::Configuration>>(
    robot: &R,
    motion: &M,
    bounds: &Aabb,
) -> bool {
    let Some(a) = robot.position(&motion.at(0.0)) else { return true };
    let Some(b) = robot.position(&motion.at(1.0)) else { return true };
    bounds.contains(a) && bounds.contains(b) && Way { robot, motion, bounds }.is_within([0.0, 1.0], [a, b])
}

struct Way<'a, R, M> {
    robot: &'a R,
    motion: &'a M,
    bounds: &'a Aabb,
}

impl<R: Robot, M: Motion<Configuration = R::Configuration>> Way<'_, R, M> {
    /// Whether a piece whose ends lie within the bounds does: it stays within the sagitta of its chord.
    fn is_within(&self, [s0, s1]: [f64; 2], [a, b]: [Point2; 2]) -> bool {
        let sagitta = self.motion.sagitta(0, s0, s1);
        // nothing follows from a bound that is no number
        if sagitta.is_nan() {
            return false;
        }
        if sagitta <= ROUNDING || sagitta <= lesser(to_sides(self.bounds, a), to_sides(self.bounds, b)) {
            return true;
        }
        let middle = 0.5 * (s0 + s1);
        let Some(at) = self.robot.position(&self.motion.at(middle)) else { return true };
        self.bounds.contains(at) && self.is_within([s0, middle], [a, at]) && self.is_within([middle, s1], [at, b])
    }
}

/// The distance from a place within a box to the nearest of its sides.
pub(crate) fn to_sides(bounds: &Aabb, p: Point2) -> f64 {
    nearest_side(bounds, p).0
}

/// The distance from a place within a box to the nearest of its sides, and the unit vector to that; of equally near
/// ones to the left, the right, the lower one.
pub(crate) fn nearest_side(bounds: &Aabb, p: Point2) -> (f64, Vector2) {
    let sides = [
        (p.x - bounds.min.x, -Vector2::x()),
        (bounds.max.x - p.x, Vector2::x()),
        (p.y - bounds.min.y, -Vector2::y()),
        (bounds.max.y - p.y, Vector2::y()),
    ];
    sides.into_iter().fold((f64::INFINITY, Vector2::x()), |least, side| if side.0 < least.0 { side } else { least })
}
