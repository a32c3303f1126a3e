//! What planners need to know of a robot that is a disc.

use crate::configuration::{Chart, Configuration, Coordinates};
use crate::geometry::{Footprint, Point2, Vector2};

/// The radius of a footprint that is a disc, metres.
pub(super) fn radius_of(footprint: &Footprint) -> Option<f64> {
    match footprint.parts() {
        [part] if part.placed().core().len() == 1 => Some(part.placed().radius()),
        _ => None,
    }
}

/// Where the disc's centre is, metres.
pub(super) fn position<C: Configuration>(q: &C) -> Point2 {
    let c = q.coordinates();
    Point2::new(c[0], c[1])
}

/// The same configuration moved by a vector, its other coordinates kept.
pub(super) fn moved<C: Chart>(q: &C, by: Vector2) -> Option<C> {
    let mut tangent: Coordinates = q.coordinates().iter().map(|_| 0.0).collect();
    (tangent[0], tangent[1]) = (by.x, by.y);
    q.exp(&tangent)
}
