//! `Collision`, the four questions.

use super::witness::Witness;
use crate::geometry::{Footprint, Placed};

/// The four questions a planner may ask, and no others. Planners take `&dyn Collision`.
///
/// Sets are closed: touching is contact. The answers agree with one another: [`intersects`](Self::intersects) exactly
/// when [`distance`](Self::distance) is 0. Whatever cannot be decided counts as contact, never as free: a footprint
/// with a number that is not finite intersects, has distance 0, is hit by every sweep, and has no witness.
///
/// Three hooks serve speed alone: [`distance_of_hull`](Self::distance_of_hull),
/// [`distance_of_hull_within`](Self::distance_of_hull_within) and [`clears`](Self::clears). A checker may leave them
/// out. One that passes its queries on to another should pass these on too.
///
/// A placed shape *is* its rounded `f64` vertices and radius. With M the larger of 1 and the largest coordinate
/// involved: `intersects` is exact for segments and convex polygons, and with radii errs, if at all, to contact within
/// 8 ulp(M); `distance` is within 16 ulp(M) of exact, and 0 exactly on contact.
pub trait Collision: Send + Sync {
    /// Whether the footprint touches any obstacle.
    fn intersects(&self, footprint: &Footprint) -> bool;

    /// The distance from the footprint to the nearest obstacle, metres: 0.0 on contact, infinity in an empty scene.
    fn distance(&self, footprint: &Footprint) -> f64;

    /// The distance from a convex hull in world coordinates to the nearest obstacle, metres:
    /// [`distance`](Self::distance) of the footprint that consists of this hull alone. [`march`](super::march) and
    /// [`verify_certificate`](super::verify_certificate) ask it of every part in every step.
    ///
    /// The default builds that footprint, whose one shape is a [`Shape::Hull`](crate::geometry::Shape::Hull), and asks
    /// `distance`. It is always sound. A checker of some shapes only, such as [`DiscChecker`](super::DiscChecker),
    /// refuses the hull: it answers 0, and a march through it proves nothing.
    ///
    /// An override saves building the footprint. It must answer as `distance` does: within 16 ulp(M) of exact, and 0
    /// exactly on contact and for a hull that is not valid. A greater answer would prove motions free that are not.
    fn distance_of_hull(&self, hull: Placed) -> f64 {
        self.distance(&Footprint::of_hull(hull))
    }

    /// The [`distance_of_hull`](Self::distance_of_hull), metres, where it is less than `within`; elsewhere any number
    /// from `within` to that distance. It is asked where a greater distance would prove no more.
    ///
    /// The default is the distance itself. An override may stop looking at what is farther than `within`.
    fn distance_of_hull_within(&self, hull: Placed, _within: f64) -> f64 {
        self.distance_of_hull(hull)
    }

    /// A conservative separation test for a part's swept hull: true only if a part whose vertices move in straight
    /// lines from one placed shape to the other keeps more than `reach` metres from every obstacle. `false` is
    /// inconclusive: the caller falls back to the exact queries.
    ///
    /// The default is `false`, which is always sound and saves nothing.
    ///
    /// An override lets the simulator prove most free motions of a tick without a distance. It may be true only where
    /// the hull of both shapes, with the greater of the two radii, is certainly farther than `reach` from every
    /// obstacle, whatever was rounded. It must be false where a shape or an obstacle is not valid and where `reach` is
    /// NaN.
    fn clears(&self, _from: &Placed, _to: &Placed, _reach: f64) -> bool {
        false
    }

    /// A pair of points that attains the distance; on contact one common point, with `dist` 0. `None` in an empty scene
    /// (and for a footprint that is not finite or has no parts). Ties go to the lowest part, then to the obstacle first
    /// in file order.
    fn witness(&self, footprint: &Footprint) -> Option<Witness>;

    /// Whether the motion from `a` to `b` hits. Each part's frame origin moves in a straight line while the part turns
    /// the short way.
    ///
    /// Sound: it is never false for a motion that touches, and never true where the clearance along the whole motion is
    /// more than 1e-6 m. `swept(a, a)` is `intersects(a)`; part lists that differ answer true. It is not an arm's chart
    /// line: that is an edge.
    fn swept(&self, a: &Footprint, b: &Footprint) -> bool;
}
