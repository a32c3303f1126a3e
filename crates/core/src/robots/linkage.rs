//! `Linkage`, a motion in which every part turns at a constant rate, about a point of the part before it.

use crate::geometry::{Aabb, Point2, Vector2};
use crate::short_list::ShortList;

/// A motion over the parameter `s` in `[0, 1]` in which the first part's frame moves at a constant velocity, each
/// further frame has its origin on the x axis of the frame before, and every frame turns at a constant rate. An arm's
/// edge is one, and so is a car's: the trailer's frame has the origin of the car's.
///
/// It says the same of an edge as the footprints along it, but for their rounding, in the few numbers from which many
/// places are worked out at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The origin of the first part's frame at 0, metres.
    pub origin: Point2,
    /// How far that origin moves up to 1, metres.
    pub travel: Vector2,
    /// The parts, in the footprint's order.
    pub parts: ShortList<TurningPart, 3>,
}

/// A part of a [`Linkage`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningPart {
    /// Where the frame's origin lies on the x axis of the frame before, metres; for the first part 0.
    pub hinge: f64,
    /// The heading of the frame at 0, radians.
    pub heading: f64,
    /// How far the frame turns up to 1, radians.
    pub turn: f64,
    /// The core, a rectangle or a segment along the frame's axes, in the frame.
    pub core: Aabb,
    /// The radius around the core, metres.
    pub radius: f64,
}
