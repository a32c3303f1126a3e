//! Two placed shapes, such as a part of a footprint and a piece of a scene, also where one of them is not valid.

use super::convex::NearestPoints;
use super::distance as narrow;
use super::distance::{nearest, nearest_within};
use crate::geometry::{Footprint, Placed};
use crate::num::lesser;

/// The nearest points of a part and a piece; contact when the piece is not a valid shape.
pub(crate) fn pair(part: &Placed, piece: &Placed) -> NearestPoints {
    if piece.is_valid() { nearest(part, piece) } else { contact_at(part) }
}

/// As [`pair`]; `None` only where the distance is greater than `limit`.
pub(crate) fn pair_within(part: &Placed, piece: &Placed, limit: f64) -> Option<NearestPoints> {
    if piece.is_valid() { nearest_within(part, piece, limit) } else { Some(contact_at(part)) }
}

fn contact_at(part: &Placed) -> NearestPoints {
    let point = part.core()[0];
    NearestPoints { dist: 0.0, on_a: point, on_b: point }
}

/// Whether two placed shapes touch. True when either is not valid.
///
/// As exact as [`Collision::intersects`](crate::collision::Collision::intersects).
pub fn touch(a: &Placed, b: &Placed) -> bool {
    !a.is_valid() || touches(a, b)
}

/// The distance between two placed shapes, metres: 0 exactly where they [`touch`], and where either is not valid.
///
/// As accurate as [`Collision::distance`](crate::collision::Collision::distance).
///
/// ```
/// use motion_lab_core::collision::distance;
/// use motion_lab_core::prelude::*;
/// let disc = |x: f64| Shape::Disc { radius: 0.5 }.place(&Pose2::new(x, 0.0, 0.0));
/// assert_eq!(distance(&disc(0.0), &disc(3.0)), 2.0);
/// assert_eq!(distance(&disc(0.0), &disc(1.0)), 0.0); // they touch
/// ```
pub fn distance(a: &Placed, b: &Placed) -> f64 {
    if a.is_valid() { pair(a, b).dist } else { 0.0 }
}

/// The distance between two footprints, metres: 0 on contact and for one that is not valid, infinity where either has
/// no parts.
pub fn footprint_distance(a: &Footprint, b: &Footprint) -> f64 {
    if !a.is_valid() || !b.is_valid() {
        return 0.0;
    }
    let pairs = a.parts().iter().flat_map(|p| b.parts().iter().map(move |q| distance(p.placed(), q.placed())));
    pairs.fold(f64::INFINITY, |least, d| lesser(d, least))
}

/// Whether a valid part touches a piece; true when the piece is not a valid shape.
pub(crate) fn touches(part: &Placed, piece: &Placed) -> bool {
    !piece.is_valid() || narrow::touch(part, piece)
}
